// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Below this share of the largest, an eigenvalue or pivot is rounding error: eliminating some ten
/// blocks leaves about 1e-14. What a rover knows least lies above 1e-8.
constexpr double kNoInformation = 1e-12;
/// Variance of what nothing is known of, in the units of its block.
constexpr double kUnknown = 1e6;

/// The inverse, with nothing for directions without information.
Eigen::MatrixXd PseudoInverse(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
  const double floor = kNoInformation * std::max(solver.eigenvalues().maxCoeff(), 1e-300);
  Eigen::VectorXd inverse = solver.eigenvalues();
  for (double& value : inverse) value = value > floor ? 1.0 / value : 0.0;
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

/// d (block ⊞ φ) / dφ at φ = 0: what turns a derivative by the seven values of a pose into one by
/// its tangent. The left inverse of it, PoseMinusJacobian, has rows 2 Lᵀ and the identity, so it is
/// ½ L and the identity.
Eigen::Matrix<double, kPoseBlockSize, 6> PosePlusJacobian(const double* block) {
  Eigen::Matrix<double, kPoseBlockSize, 6> jacobian = PoseMinusJacobian(block).transpose();
  jacobian.topLeftCorner<4, 3>() *= 0.25;
  return jacobian;
}

}  // namespace

NormalEquations::NormalEquations(std::vector<LinearisedBlock> blocks) : blocks_(std::move(blocks)) {
  int size = 0;
  for (size_t i = 0; i < blocks_.size(); ++i) {
    columns_.push_back(size);
    index_[blocks_[i].block] = i;
    size += blocks_[i].tangent_size();
  }
  information_ = Eigen::MatrixXd::Zero(size, size);
  gradient_ = Eigen::VectorXd::Zero(size);
}

NormalEquations::Rows NormalEquations::Linearise(const ceres::CostFunction& factor,
                                                 const ceres::LossFunction* loss,
                                                 const std::vector<double*>& parameters) const {
  const auto& sizes = factor.parameter_block_sizes();
  std::vector<const double*> points(parameters.begin(), parameters.end());
  std::vector<RowMajorMatrix> ambient(parameters.size());
  std::vector<double*> pointers(parameters.size(), nullptr);
  std::vector<const LinearisedBlock*> known(parameters.size(), nullptr);
  for (size_t i = 0; i < parameters.size(); ++i) {
    const auto found = index_.find(parameters[i]);
    if (found != index_.end()) {
      known[i] = &blocks_[found->second];
      points[i] = known[i]->point.data();
    } else if (parameters[i] != landmark_) {
      continue;
    }
    ambient[i].resize(factor.num_residuals(), sizes[i]);
    pointers[i] = ambient[i].data();
  }
  Rows rows;
  rows.residual.resize(factor.num_residuals());
  factor.Evaluate(points.data(), rows.residual.data(), pointers.data());
  // The residual belongs to the current values, its derivatives to the points.
  Eigen::VectorXd current(factor.num_residuals());
  factor.Evaluate(parameters.data(), current.data(), nullptr);
  double weight = 1.0;
  if (loss != nullptr) {
    double rho[3];
    loss->Evaluate(current.squaredNorm(), rho);
    weight = std::sqrt(rho[1]);
  }
  rows.residual = weight * current;
  rows.by_landmark = Eigen::VectorXd::Zero(factor.num_residuals());
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (known[i] == nullptr) {
      if (pointers[i] != nullptr) rows.by_landmark = weight * ambient[i].col(0);
      continue;
    }
    Eigen::MatrixXd by_tangent = weight * ambient[i];
    if (known[i]->size() == kPoseBlockSize) by_tangent *= PosePlusJacobian(points[i]);
    // r(x) ≈ current + J (x - x̂) = (current - J (x̂ - x₀)) + J (x - x₀).
    rows.residual -= by_tangent * known[i]->Minus(parameters[i]);
    rows.columns.push_back(columns_[index_.at(parameters[i])]);
    rows.by_block.push_back(std::move(by_tangent));
  }
  return rows;
}

void NormalEquations::Accumulate(const Rows& rows) {
  for (size_t i = 0; i < rows.by_block.size(); ++i) {
    const Eigen::MatrixXd& first = rows.by_block[i];
    gradient_.segment(rows.columns[i], first.cols()) += first.transpose() * rows.residual;
    for (size_t j = 0; j < rows.by_block.size(); ++j) {
      information_.block(rows.columns[i], rows.columns[j], first.cols(), rows.by_block[j].cols()) +=
          first.transpose() * rows.by_block[j];
    }
  }
}

void NormalEquations::Add(const ceres::CostFunction& factor, const ceres::LossFunction* loss,
                          const std::vector<double*>& parameters) {
  Rows rows = Linearise(factor, loss, parameters);
  Accumulate(rows);
  if (landmark_ != nullptr) landmark_rows_.push_back(std::move(rows));
}

void NormalEquations::EndLandmark() {
  double information = 0.0;
  double gradient = 0.0;
  std::unordered_map<int, Eigen::VectorXd> coupling;
  std::vector<int> order;
  for (const Rows& rows : landmark_rows_) {
    information += rows.by_landmark.squaredNorm();
    gradient += rows.by_landmark.dot(rows.residual);
    for (size_t i = 0; i < rows.by_block.size(); ++i) {
      const Eigen::VectorXd value = rows.by_block[i].transpose() * rows.by_landmark;
      const auto inserted = coupling.try_emplace(rows.columns[i], value);
      if (inserted.second) {
        order.push_back(rows.columns[i]);
      } else {
        inserted.first->second += value;
      }
    }
  }
  landmark_rows_.clear();
  landmark_ = nullptr;
  if (information <= 1e-12) return;
  for (const int row : order) {
    const Eigen::VectorXd scaled = coupling[row] / information;
    gradient_.segment(row, scaled.size()) -= scaled * gradient;
    for (const int column : order) {
      const Eigen::VectorXd& other = coupling[column];
      information_.block(row, column, scaled.size(), other.size()) -= scaled * other.transpose();
    }
  }
}

LinearPrior NormalEquations::Marginalise(size_t eliminated_blocks) const {
  const Eigen::Index eliminated =
      eliminated_blocks < blocks_.size() ? columns_[eliminated_blocks] : information_.rows();
  const Eigen::Index kept = information_.rows() - eliminated;
  const Eigen::MatrixXd inverse = PseudoInverse(information_.topLeftCorner(eliminated, eliminated));
  const Eigen::MatrixXd gain = information_.bottomLeftCorner(kept, eliminated) * inverse;
  Eigen::MatrixXd schur = information_.bottomRightCorner(kept, kept) -
                          gain * information_.topRightCorner(eliminated, kept);
  schur = 0.5 * (schur + schur.transpose()).eval();
  const Eigen::VectorXd gradient = gradient_.tail(kept) - gain * gradient_.head(eliminated);

  LinearPrior prior;
  prior.blocks.assign(blocks_.begin() + static_cast<std::ptrdiff_t>(eliminated_blocks),
                      blocks_.end());
  // H = Pᵀ L D Lᵀ P, so J = √D Lᵀ P and Jᵀ e = b.
  const Eigen::LDLT<Eigen::MatrixXd> factorisation(schur);
  const Eigen::VectorXd pivots = factorisation.vectorD();
  const double floor = kNoInformation * std::max(pivots.maxCoeff(), 1e-300);
  Eigen::VectorXd root = pivots.cwiseMax(0.0).cwiseSqrt();
  Eigen::VectorXd residual =
      factorisation.matrixL().solve(factorisation.transpositionsP() * gradient);
  Eigen::Index rows = 0;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd(factorisation.matrixU());
  for (Eigen::Index i = 0; i < kept; ++i) {
    if (pivots[i] <= floor) continue;
    jacobian.row(rows) = root[i] * jacobian.row(i).eval();
    residual[rows] = residual[i] / root[i];
    ++rows;
  }
  prior.jacobian = jacobian.topRows(rows) * Eigen::MatrixXd(factorisation.transpositionsP() *
                                                            Eigen::MatrixXd::Identity(kept, kept));
  prior.residual = residual.head(rows);
  return prior;
}

Eigen::MatrixXd NormalEquations::Covariance(size_t first) const {
  const Eigen::Index size = information_.rows();
  const Eigen::Index start = columns_[first];
  Eigen::MatrixXd regular = information_;
  regular.diagonal().array() += 1.0 / kUnknown;
  const Eigen::MatrixXd columns = Eigen::MatrixXd::Identity(size, size).rightCols(size - start);
  return Eigen::LDLT<Eigen::MatrixXd>(regular).solve(columns).bottomRows(size - start);
}

std::vector<LinearisedBlock> WithPriorPoints(const std::vector<std::pair<double*, int>>& blocks,
                                             const LinearPrior& prior) {
  std::vector<LinearisedBlock> result;
  for (const auto& [block, size] : blocks) {
    const auto found = std::find_if(
        prior.blocks.begin(), prior.blocks.end(),
        [block = block](const LinearisedBlock& other) { return other.block == block; });
    result.push_back(found != prior.blocks.end()
                         ? *found
                         : LinearisedBlock{block, Eigen::Map<const Eigen::VectorXd>(block, size)});
  }
  return result;
}

}  // namespace regolith

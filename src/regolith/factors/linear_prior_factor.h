// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/check.h"
#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"

namespace regolith {

/// A parameter block and the value at which something was linearised there. Blocks of seven values
/// are poses (PoseManifold), all others are vectors.
struct LinearisedBlock {
  double* block = nullptr;
  Eigen::VectorXd point;

  int size() const { return static_cast<int>(point.size()); }
  int tangent_size() const { return TangentSize(size()); }
  static int TangentSize(int size) { return size == kPoseBlockSize ? kPoseBlockSize - 1 : size; }

  /// How far `value` lies from the point, in its tangent space.
  Eigen::VectorXd Minus(const double* value) const {
    if (size() == kPoseBlockSize) {
      return regolith::Minus(FromPoseBlock(value), FromPoseBlock(point.data()));
    }
    return Eigen::Map<const Eigen::VectorXd>(value, size()) - point;
  }
};

/// What is known of some blocks by a linear equation: residuals e + J (x - x₀), with x₀ for ever
/// the points at which J was made.
struct LinearPrior {
  std::vector<LinearisedBlock> blocks;
  Eigen::MatrixXd jacobian;  ///< J, rows × sum of the tangent sizes
  Eigen::VectorXd residual;  ///< e

  bool empty() const { return blocks.empty(); }
};

/// A linear prior as residuals, such as marginalisation leaves (Leutenegger et al. 2015, section
/// 3.4).
class LinearPriorFactor final : public ceres::CostFunction {
 public:
  explicit LinearPriorFactor(LinearPrior prior) : prior_(std::move(prior)) {
    set_num_residuals(static_cast<int>(prior_.residual.size()));
    int columns = 0;
    for (const LinearisedBlock& block : prior_.blocks) {
      mutable_parameter_block_sizes()->push_back(block.size());
      columns += block.tangent_size();
    }
    REGOLITH_CHECK(prior_.jacobian.cols() == columns, prior_.jacobian.cols(), " columns for ",
                   columns, " values");
    REGOLITH_CHECK(prior_.jacobian.rows() == prior_.residual.size(), "rows ",
                   prior_.jacobian.rows());
  }

  bool Evaluate(const double* const* values, double* residuals, double** jacobians) const override {
    Eigen::VectorXd offset(prior_.jacobian.cols());
    int column = 0;
    for (size_t i = 0; i < prior_.blocks.size(); ++i) {
      const int size = prior_.blocks[i].tangent_size();
      offset.segment(column, size) = prior_.blocks[i].Minus(values[i]);
      if (jacobians != nullptr && jacobians[i] != nullptr) {
        WriteJacobian(i, column, offset.segment(column, size), values[i], jacobians[i]);
      }
      column += size;
    }
    Eigen::Map<Eigen::VectorXd>(residuals, prior_.residual.size()) =
        prior_.residual + prior_.jacobian * offset;
    return true;
  }

 private:
  using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  void WriteJacobian(size_t index, int column, const Eigen::VectorXd& offset, const double* value,
                     double* jacobian) const {
    const LinearisedBlock& block = prior_.blocks[index];
    Eigen::Map<RowMajorMatrix> written(jacobian, prior_.jacobian.rows(), block.size());
    if (block.size() != kPoseBlockSize) {
      written = prior_.jacobian.middleCols(column, block.size());
      return;
    }
    // Log(R₀ᵀ R Exp(φ)) ≈ Log(R₀ᵀ R) + J_r⁻¹ φ.
    Matrix6d by_tangent = Matrix6d::Identity();
    by_tangent.topLeftCorner<3, 3>() = RightJacobianInverseSo3(offset.head<3>());
    written = prior_.jacobian.middleCols<6>(column) * (by_tangent * PoseMinusJacobian(value));
  }

  LinearPrior prior_;
};

}  // namespace regolith

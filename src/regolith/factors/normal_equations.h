// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "regolith/factors/linear_prior_factor.h"

namespace regolith {

/// The Gauss–Newton equations H δ = -b of a part of a problem, for what a solver does not tell:
/// priors from states that are given up, and covariances. Landmarks (blocks of one value) are
/// eliminated one by one.
class NormalEquations {
 public:
  /// `blocks`: what the equations are in, in this order; `point` is where residuals are linearised
  /// (the current value, or the one at which an earlier prior was: all Jacobians of a block at one
  /// point, so that what cannot be observed stays so; Huang et al. 2010). Others that a residual
  /// depends on count as known.
  explicit NormalEquations(std::vector<LinearisedBlock> blocks);

  void Add(const ceres::CostFunction& factor, const ceres::LossFunction* loss,
           const std::vector<double*>& parameters);

  /// From here to EndLandmark, residuals depend on this landmark too.
  void BeginLandmark(double* inverse_distance) { landmark_ = inverse_distance; }
  void EndLandmark();

  /// What is left of the first blocks when they are given up: a prior of the others, at their
  /// points.
  LinearPrior Marginalise(size_t eliminated_blocks) const;

  /// Covariance of the blocks from `first` on, all others unknown too. Directions without any
  /// information get a large one.
  Eigen::MatrixXd Covariance(size_t first) const;

  const Eigen::MatrixXd& information() const { return information_; }

 private:
  /// A residual's derivative by the landmark and its derivatives by the blocks.
  struct Rows {
    Eigen::VectorXd residual;
    Eigen::VectorXd by_landmark;
    std::vector<int> columns;  ///< where each of `by_block` starts
    std::vector<Eigen::MatrixXd> by_block;
  };

  Rows Linearise(const ceres::CostFunction& factor, const ceres::LossFunction* loss,
                 const std::vector<double*>& parameters) const;
  void Accumulate(const Rows& rows);

  std::vector<LinearisedBlock> blocks_;
  std::vector<int> columns_;
  std::unordered_map<const double*, size_t> index_;
  Eigen::MatrixXd information_;  ///< H
  Eigen::VectorXd gradient_;     ///< b
  double* landmark_ = nullptr;
  std::vector<Rows> landmark_rows_;
};

/// The blocks with their current values as points, except where `prior` has one.
std::vector<LinearisedBlock> WithPriorPoints(const std::vector<std::pair<double*, int>>& blocks,
                                             const LinearPrior& prior);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/window_solver.h"

#include <ceres/ceres.h>

namespace regolith {
namespace {

/// Puts a window's residuals into a Ceres problem. The window keeps all of them.
class ProblemBuilder {
 public:
  explicit ProblemBuilder(SlidingWindow* window)
      : problem_(Options()), ordering_(new ceres::ParameterBlockOrdering) {
    for (const auto& frame : window->frames()) {
      problem_.AddParameterBlock(frame->pose.data(), kPoseBlockSize, &pose_manifold_);
      problem_.AddParameterBlock(frame->motion.data(), kMotionBlockSize);
      if (window->uses_slip()) problem_.AddParameterBlock(&frame->slip, 1);
    }
    for (const auto& [block, size] : window->SharedBlocks()) AddBlock(block, size);
    for (const auto& [block, size] : window->FixedBlocks()) {
      AddBlock(block, size);
      problem_.SetParameterBlockConstant(block);
    }
    if (const auto prior = window->PriorResidual()) Add(*prior);
    for (const auto& frame : window->frames()) {
      for (const WindowResidual& residual : frame->residuals) Add(residual);
    }
  }

  void AddLandmark(Landmark* landmark) {
    problem_.AddParameterBlock(&landmark->inverse_distance, 1);
    ordering_->AddElementToGroup(&landmark->inverse_distance, 0);
    for (const LandmarkSighting& sighting : landmark->sightings) {
      for (const WindowResidual& residual : sighting.residuals) Add(residual);
    }
  }

  ceres::Problem& problem() { return problem_; }
  std::shared_ptr<ceres::ParameterBlockOrdering> Ordering() {
    std::vector<double*> blocks;
    problem_.GetParameterBlocks(&blocks);
    for (double* block : blocks) {
      if (!ordering_->IsMember(block)) ordering_->AddElementToGroup(block, 1);
    }
    return ordering_;
  }

 private:
  static ceres::Problem::Options Options() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  void AddBlock(double* block, int size) {
    problem_.AddParameterBlock(block, size, size == kPoseBlockSize ? &pose_manifold_ : nullptr);
  }

  /// Ceres takes what it evaluates as not const, and does not change it.
  void Add(const WindowResidual& residual) {
    problem_.AddResidualBlock(const_cast<ceres::CostFunction*>(residual.factor.get()),
                              const_cast<ceres::LossFunction*>(residual.loss.get()),
                              residual.blocks);
  }

  PoseManifold pose_manifold_;
  ceres::Problem problem_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
};

}  // namespace

WindowSolution SolveWindow(SlidingWindow* window, int max_iterations) {
  window->PrepareLandmarks();
  WindowSolution solution;
  ProblemBuilder builder(window);
  for (auto& [id, landmark] : window->landmarks()) {
    if (!landmark.in_use || landmark.sightings.size() < 2) continue;
    builder.AddLandmark(&landmark);
    ++solution.landmarks;
    solution.sightings += static_cast<int>(landmark.sightings.size()) - 1;
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering = builder.Ordering();
  options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  options.max_num_iterations = max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-4;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &builder.problem(), &summary);
  solution.is_usable = summary.IsSolutionUsable();
  solution.iterations = static_cast<int>(summary.iterations.size());
  solution.visual_cost = solution.sightings > 0 ? summary.final_cost / solution.sightings : 0.0;
  return solution;
}

}  // namespace regolith

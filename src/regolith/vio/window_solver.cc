// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/window_solver.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "regolith/factors/gravity_tilt.h"

namespace regolith {
namespace {

/// Puts a window's residuals into a Ceres problem. The window keeps all of them. The values are
/// copied to one array, in an order that is the window's: Ceres eliminates blocks in the order of
/// their addresses, and sums must not depend on where memory happened to lie.
class ProblemBuilder {
 public:
  explicit ProblemBuilder(SlidingWindow* window)
      : problem_(Options()), ordering_(new ceres::ParameterBlockOrdering) {
    values_.reserve(RoomFor(*window));
    for (auto& [id, landmark] : window->landmarks()) {
      if (landmark.IsSolvedFor()) AddBlock(&landmark.inverse_distance, 1, 0);
    }
    for (const auto& frame : window->frames()) {
      AddBlock(frame->pose.data(), kPoseBlockSize, 1);
      AddBlock(frame->motion.data(), kMotionBlockSize, 1);
      if (window->uses_slip()) AddBlock(&frame->slip, 1, 1);
    }
    for (const auto& [block, size] : window->SharedBlocks()) AddBlock(block, size, 1);
    for (const auto& [block, size] : window->FixedBlocks()) {
      AddBlock(block, size, 1);
      problem_.SetParameterBlockConstant(places_.at(block));
    }
    if (const auto prior = window->PriorResidual()) Add(*prior);
    for (const auto& frame : window->frames()) {
      for (const WindowResidual& residual : frame->residuals) Add(residual);
    }
    for (auto& [id, landmark] : window->landmarks()) {
      if (landmark.IsSolvedFor()) AddLandmark(landmark);
    }
  }

  ceres::Problem& problem() { return problem_; }
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering() const { return ordering_; }
  int landmarks() const { return landmarks_; }
  int sightings() const { return sightings_; }

  /// The values found, to where they came from.
  void CopyBack() const {
    for (const auto& [block, size] : blocks_) {
      std::copy_n(places_.at(block), size, block);
    }
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

  static size_t RoomFor(const SlidingWindow& window) {
    constexpr size_t kShared = 2 * kPoseBlockSize + kTiltBlockSize + 1;
    return window.landmarks().size() +
           window.frames().size() * (kPoseBlockSize + kMotionBlockSize + 1) + kShared;
  }

  void AddBlock(double* block, int size, int group) {
    double* place = values_.data() + values_.size();
    values_.insert(values_.end(), block, block + size);
    places_[block] = place;
    blocks_.emplace_back(block, size);
    problem_.AddParameterBlock(place, size, size == kPoseBlockSize ? &pose_manifold_ : nullptr);
    ordering_->AddElementToGroup(place, group);
  }

  void AddLandmark(const Landmark& landmark) {
    ++landmarks_;
    sightings_ += static_cast<int>(landmark.sightings.size()) - 1;
    for (const LandmarkSighting& sighting : landmark.sightings) {
      for (const WindowResidual& residual : sighting.residuals) Add(residual);
    }
  }

  /// Ceres takes what it evaluates as not const, and does not change it.
  void Add(const WindowResidual& residual) {
    std::vector<double*> places;
    for (double* block : residual.blocks) places.push_back(places_.at(block));
    problem_.AddResidualBlock(const_cast<ceres::CostFunction*>(residual.factor.get()),
                              const_cast<ceres::LossFunction*>(residual.loss.get()), places);
  }

  PoseManifold pose_manifold_;
  ceres::Problem problem_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
  std::vector<double> values_;
  std::unordered_map<const double*, double*> places_;
  std::vector<std::pair<double*, int>> blocks_;
  int landmarks_ = 0;
  int sightings_ = 0;
};

}  // namespace

WindowSolution SolveWindow(SlidingWindow* window, int max_iterations) {
  window->PrepareLandmarks();
  ProblemBuilder builder(window);
  WindowSolution solution;
  solution.landmarks = builder.landmarks();
  solution.sightings = builder.sightings();
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering = builder.ordering();
  options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  options.max_num_iterations = max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-4;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &builder.problem(), &summary);
  solution.is_usable = summary.IsSolutionUsable();
  if (solution.is_usable) builder.CopyBack();
  solution.iterations = static_cast<int>(summary.iterations.size());
  solution.visual_cost = solution.sightings > 0 ? summary.final_cost / solution.sightings : 0.0;
  return solution;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/local_adjustment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "regolith/factors/point_projection_factor.h"
#include "regolith/factors/pose_manifold.h"

namespace regolith {
namespace {

constexpr double kNearest = 0.05;  // m, of a sighting that a solve starts with

class Adjustment {
 public:
  Adjustment(const LocalAdjustmentOptions& options, const SightingNoise& noise, StereoMap* map)
      : options_(options),
        noise_(noise),
        map_(map),
        mono_loss_(std::sqrt(OutlierThreshold(false))),
        stereo_loss_(std::sqrt(OutlierThreshold(true))),
        problem_(Ownership()) {}

  void Run(KeyframeId newest) {
    ChooseKeyframes(newest);
    ChooseLandmarks();
    ChooseFixed();
    CopyValues();
    AddResiduals();
    if (problem_.NumResidualBlocks() == 0) return;
    Solve();
    TakeOver();
    RemoveOutliers();
  }

 private:
  struct Point {
    LandmarkId id = kNoId;
    double* position = nullptr;
  };
  struct Pose {
    double* block = nullptr;
    bool moves = false;
    SE3 before;
  };

  static ceres::Problem::Options Ownership() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void AddPose(KeyframeId keyframe, bool moves) {
    Pose& pose = poses_[keyframe];
    pose.before = map_->keyframe(keyframe).T_world_camera;
    pose.moves = moves;
  }

  void ChooseKeyframes(KeyframeId newest) {
    AddPose(newest, true);
    for (const Covisible& one : map_->CovisibleWith(newest)) {
      if (poses_.size() >= static_cast<size_t>(options_.keyframes)) break;
      AddPose(one.keyframe, true);
    }
  }

  /// Those with two sightings or more; one alone says nothing of a pose.
  void ChooseLandmarks() {
    std::vector<LandmarkId> seen;
    for (const auto& [keyframe, pose] : poses_) {
      for (const LandmarkId id : map_->keyframe(keyframe).landmarks) {
        if (id == kNoId) continue;
        (map_->Find(id)->sightings.size() >= 2 ? seen : lone_).push_back(id);
      }
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    std::stable_sort(seen.begin(), seen.end(), [this](LandmarkId a, LandmarkId b) {
      return map_->Find(a)->sightings.size() > map_->Find(b)->sightings.size();
    });
    if (seen.size() > static_cast<size_t>(options_.max_landmarks)) {
      seen.resize(static_cast<size_t>(options_.max_landmarks));
    }
    for (const LandmarkId id : seen) points_.push_back({id, nullptr});
  }

  /// The other keyframes that see them stay where they are; without any the oldest does.
  void ChooseFixed() {
    std::vector<LandmarkId> ids;
    for (const Point& point : points_) ids.push_back(point.id);
    int fixed = 0;
    for (const Covisible& one : map_->Seeing(ids)) {
      if (fixed >= options_.fixed_keyframes) break;
      if (poses_.count(one.keyframe) > 0) continue;
      AddPose(one.keyframe, false);
      ++fixed;
    }
    const auto oldest = poses_.begin();
    if (fixed == 0 || oldest->first == 0) oldest->second.moves = false;
  }

  /// To one array: Ceres eliminates blocks in the order of their addresses, and sums must not
  /// depend on where memory happened to lie.
  void CopyValues() {
    values_.resize(3 * points_.size() + kPoseBlockSize * poses_.size());
    double* next = values_.data();
    for (Point& point : points_) {
      point.position = next;
      Eigen::Map<Eigen::Vector3d>(point.position, 3) = map_->Find(point.id)->position_world;
      next += 3;
    }
    for (auto& [keyframe, pose] : poses_) {
      pose.block = next;
      Eigen::Map<PoseBlock>(pose.block, kPoseBlockSize) = ToPoseBlock(pose.before);
      next += kPoseBlockSize;
    }
  }

  void AddResiduals() {
    for (Point& point : points_) {
      const StereoLandmark& landmark = *map_->Find(point.id);
      for (const StereoSighting& sighting : landmark.sightings) {
        const auto pose = poses_.find(sighting.keyframe);
        if (pose == poses_.end()) continue;
        const PointSighting seen = map_->SightingOf(landmark, sighting, noise_);
        if ((pose->second.before.Inverse() * seen.point_world).z() < kNearest) continue;
        ceres::CostFunction* cost =
            seen.has_right ? static_cast<ceres::CostFunction*>(new StereoProjectionFactor(
                                 map_->camera(), seen.seen, seen.sigma, seen.disparity_sigma))
                           : new MonoProjectionFactor(map_->camera(), seen.seen, seen.sigma,
                                                      seen.disparity_sigma);
        problem_.AddResidualBlock(cost, seen.has_right ? &stereo_loss_ : &mono_loss_,
                                  pose->second.block, point.position);
      }
    }
    for (auto& [keyframe, pose] : poses_) {
      if (!problem_.HasParameterBlock(pose.block)) continue;
      problem_.SetManifold(pose.block, &manifold_);
      if (!pose.moves) problem_.SetParameterBlockConstant(pose.block);
    }
  }

  void Solve() {
    auto* ordering = new ceres::ParameterBlockOrdering;
    for (Point& point : points_) {
      if (problem_.HasParameterBlock(point.position)) {
        ordering->AddElementToGroup(point.position, 0);
      }
    }
    for (auto& [keyframe, pose] : poses_) {
      if (problem_.HasParameterBlock(pose.block)) {
        ordering->AddElementToGroup(pose.block, 1);
      }
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering.reset(ordering);
    options.num_threads = 1;
    options.max_num_iterations = options_.iterations;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
  }

  void TakeOver() {
    for (const Point& point : points_) {
      map_->Find(point.id)->position_world = Eigen::Map<const Eigen::Vector3d>(point.position);
    }
    for (const auto& [keyframe, pose] : poses_) {
      if (pose.moves) map_->keyframe(keyframe).T_world_camera = FromPoseBlock(pose.block);
    }
    // What a single keyframe sees moves with it.
    for (const LandmarkId id : lone_) {
      StereoLandmark& landmark = *map_->Find(id);
      const KeyframeId keyframe = landmark.sightings.front().keyframe;
      const Pose& pose = poses_.at(keyframe);
      if (!pose.moves) continue;
      landmark.position_world = map_->keyframe(keyframe).T_world_camera *
                                (pose.before.Inverse() * landmark.position_world);
    }
  }

  void RemoveOutliers() {
    for (const Point& point : points_) {
      const std::vector<StereoSighting> sightings = map_->Find(point.id)->sightings;
      for (const StereoSighting& sighting : sightings) {
        const StereoLandmark* landmark = map_->Find(point.id);
        if (landmark == nullptr) break;
        const PointSighting seen = map_->SightingOf(*landmark, sighting, noise_);
        const SE3 T_camera_world = map_->keyframe(sighting.keyframe).T_world_camera.Inverse();
        if (SquaredError(map_->camera(), T_camera_world, seen) <=
            OutlierThreshold(seen.has_right)) {
          continue;
        }
        map_->RemoveSighting(point.id, sighting.keyframe);
      }
      if (map_->Find(point.id) != nullptr) map_->Refresh(point.id);
    }
  }

  LocalAdjustmentOptions options_;
  SightingNoise noise_;
  StereoMap* map_;
  PoseManifold manifold_;
  ceres::HuberLoss mono_loss_;
  ceres::HuberLoss stereo_loss_;
  std::map<KeyframeId, Pose> poses_;
  std::vector<Point> points_;
  std::vector<double> values_;
  std::vector<LandmarkId> lone_;  ///< landmarks with one sighting
  ceres::Problem problem_;
};

}  // namespace

void AdjustAround(KeyframeId newest, const LocalAdjustmentOptions& options,
                  const SightingNoise& noise, StereoMap* map) {
  Adjustment(options, noise, map).Run(newest);
}

}  // namespace regolith

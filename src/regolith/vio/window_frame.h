// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/factors/motion_block.h"
#include "regolith/factors/ray_transfer.h"
#include "regolith/imu/preintegration.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/vio/lidar_depth.h"
#include "regolith/vio/wheel_way.h"

namespace ceres {
class CostFunction;
class LossFunction;
}  // namespace ceres

namespace regolith {

/// A residual and the parameter blocks that it is of.
struct WindowResidual {
  std::shared_ptr<const ceres::CostFunction> factor;
  std::shared_ptr<const ceres::LossFunction> loss;  ///< null: none
  std::vector<double*> blocks;
};

/// What was measured between a frame and the one before it.
struct FrameMotion {
  std::vector<ImuSample> samples;  ///< from the frame before to this one
  bool is_doubtful = false;        ///< a gap or saturation among them
  std::optional<WheelWay> way;
  bool at_rest = false;  ///< all the time

  /// This motion after an earlier one. The wheels' way is put together again by its caller.
  void Prepend(const FrameMotion& earlier);
  /// Forgets samples that lie further back than these seconds.
  void KeepLast(double seconds);
};

/// The state at one image. Its values are parameter blocks: it does not move in memory.
struct WindowFrame {
  size_t record = 0;         ///< its number in the history
  TimeNs stamp = 0;          ///< of the image
  TimeNs time = 0;           ///< stamp and time offset, as known when the frame came
  double time_offset = 0.0;  ///< s, that one
  PoseBlock pose;            ///< T_world_imu
  MotionBlock motion;
  double slip = 0.0;
  bool is_keyframe = false;
  bool at_rest = false;

  FrameMotion since;  ///< the frame before
  std::optional<ImuPreintegration> inertial;
  std::vector<WindowResidual> residuals;  ///< of `since`, and of this frame alone

  NavState State() const {
    NavState state = FromBlocks(pose.data(), motion.data());
    state.time = time;
    return state;
  }
  void SetState(const NavState& state) {
    pose = ToPoseBlock(state.T_world_imu);
    motion = ToMotionBlock(state);
  }
};

/// A landmark in one frame of the window.
struct LandmarkSighting {
  WindowFrame* frame = nullptr;
  FeatureSighting seen;
  std::optional<Eigen::Vector3d> right_bearing;  ///< unit, right camera, at the same time
  std::optional<MeasuredDistance> measured;      ///< along the bearing, by a lidar
  std::vector<WindowResidual> residuals;
};

/// A track of the frontend as a landmark: the first of its sightings in the window is the one along
/// which its distance is a state.
struct Landmark {
  std::vector<LandmarkSighting> sightings;  ///< in order of their frames
  double inverse_distance = 0.0;            ///< 1/m, a parameter block: landmarks do not move
  bool is_placed = false;                   ///< its distance comes from parallax or measurement
  bool in_use = false;                      ///< the window is solved with it

  bool IsSolvedFor() const { return in_use && sightings.size() >= 2; }
  bool IsSeenIn(const WindowFrame* frame) const {
    return !sightings.empty() && sightings.back().frame == frame;
  }
};

}  // namespace regolith

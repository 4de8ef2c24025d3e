// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Drives over generated ground, for tests of the back end.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "regolith/backend/backend.h"
#include "regolith/backend/keyframe_selector.h"
#include "regolith/backend/test_ground_internal.h"
#include "regolith/core/thread_pool.h"

namespace regolith {

/// One scan of a drive: where the rover is, and on which ground.
struct Moment {
  SE3 T_world_body;
  const TestGround* ground = nullptr;
};

/// What an odometry makes of a drive.
struct Odometry {
  double yaw_drift = 0.0;        ///< rad a keyframe
  double scale = 1.0;            ///< of each step's length
  double rotation_sigma = 1e-3;  ///< rad a keyframe, as the odometry states it
  double position_sigma = 0.01;  ///< m a keyframe, likewise
  /// What it adds to the first step, and how far that may be off, as it states: 1 σ, rad and m.
  SE3 jump;
  double jump_rotation_sigma = 0.0;
  double jump_position_sigma = 0.0;
};

inline std::vector<Moment> Laps(const TestGround& ground, int laps) {
  std::vector<Moment> drive;
  for (int lap = 0; lap < laps; ++lap) {
    for (const SE3& pose : OvalLap(ground, 0.6 * lap, lap % 2 == 1)) {
      drive.push_back({pose, &ground});
    }
  }
  return drive;
}

/// Runs a back end over a drive with an odometry that drifts as told.
class Driver {
 public:
  explicit Driver(const BackendOptions& options = BackendOptions())
      : threads_(2), selector_(options.keyframes), backend_(options, &threads_) {}

  /// `look`, where given, is called after each keyframe.
  void Drive(const std::vector<Moment>& drive, const Odometry& odometry,
             const std::function<void(const Moment&)>& look = {}) {
    const auto variances_of = [](double rotation_sigma, double position_sigma) {
      Vector6d variances;
      variances << Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma),
          Eigen::Vector3d::Constant(position_sigma * position_sigma);
      return variances;
    };
    SE3 jump = odometry.jump;
    Vector6d step_variances = variances_of(odometry.jump_rotation_sigma + odometry.rotation_sigma,
                                           odometry.jump_position_sigma + odometry.position_sigma);
    for (const Moment& moment : drive) {
      if (!truth_.empty()) {
        SE3 step = truth_.back().Inverse() * moment.T_world_body * std::exchange(jump, SE3());
        step.rotation = step.rotation * ExpSo3({0.0, 0.0, odometry.yaw_drift});
        step.translation *= odometry.scale;
        const Matrix6d adjoint = AdjointSe3(step.Inverse());
        covariance_ = adjoint * covariance_ * adjoint.transpose();
        covariance_.diagonal() += step_variances;
        T_odom_body_ = T_odom_body_ * step;
      } else {
        T_odom_body_ = moment.T_world_body;
      }
      truth_.push_back(moment.T_world_body);
      KeyframeInput input;
      input.time = FromSeconds(3.0 * static_cast<double>(truth_.size()));
      input.T_odom_body = T_odom_body_;
      input.covariance = ExpToPlusCovariance(covariance_, T_odom_body_);
      input.is_level = true;
      input.points_body = moment.ground->Scan(moment.T_world_body, truth_.size());
      odometry_.Append({input.time, T_odom_body_});
      EXPECT_TRUE(selector_.Select(input.time, input.T_odom_body));
      backend_.Add(input);
      if (look) look(moment);
      step_variances = variances_of(odometry.rotation_sigma, odometry.position_sigma);
    }
  }

  /// Largest distance (m) of a keyframe from where it was.
  double Error(const Trajectory& trajectory) const {
    double error = 0.0;
    for (size_t i = 0; i < truth_.size(); ++i) {
      const SE3& pose = trajectory.poses()[i].T_world_body;
      error = std::max(error, (pose.translation - truth_[i].translation).norm());
    }
    return error;
  }

  Backend& backend() { return backend_; }
  const Trajectory& odometry() const { return odometry_; }
  Trajectory corrected() const { return backend_.Corrected(odometry_); }
  const std::vector<SE3>& truth() const { return truth_; }

 private:
  ThreadPool threads_;
  KeyframeSelector selector_;
  Backend backend_;
  std::vector<SE3> truth_;
  Trajectory odometry_;
  SE3 T_odom_body_;
  Matrix6d covariance_ = Matrix6d::Zero();
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "regolith/backend/uncertain_pose.h"

namespace regolith {

/// The keyframes as odometry alone has them, and what it may be off by between any two of them.
class OdometryChain {
 public:
  /// `step_covariance`: of the motion from the last one, as UncertainPose has it; not used for the
  /// first.
  void Append(const SE3& T_odom_body, const Matrix6d& step_covariance);

  size_t size() const { return links_.size(); }
  const SE3& T_odom_body(size_t index) const { return links_[index].T_odom_body; }

  /// The motion from one to another, in either order.
  UncertainPose Between(size_t from, size_t to) const;

 private:
  struct Link {
    SE3 T_odom_body;
    /// Sum of the steps' covariances, each moved into the odometry's frame: differences of two sums
    /// are what lies between.
    Matrix6d sum_odom = Matrix6d::Zero();
  };
  std::vector<Link> links_;
};

/// What the motion between two poses of an odometry may be off by, from the covariances (as Plus()
/// perturbs the poses) that it states for both: what the later has and the earlier has not. At
/// least the floors (1 σ).
Matrix6d StepCovariance(const SE3& T_odom_from, const Matrix6d& covariance_from,
                        const SE3& T_odom_to, const Matrix6d& covariance_to,
                        double floor_rotation_sigma, double floor_position_sigma);

}  // namespace regolith

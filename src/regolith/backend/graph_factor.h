// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"
#include "regolith/imu/preintegration.h"

namespace ceres {
class CostFunction;
class LossFunction;
}  // namespace ceres

namespace regolith {

/// Index of a keyframe's state in a FactorGraph.
using NodeId = size_t;

/// What a node's state consists of, each a block of the optimisation.
enum class BlockKind {
  kPose,    ///< T_world_body, 7 values (factors/pose_manifold.h)
  kMotion,  ///< velocity (world, m/s), gyro bias (rad/s), accelerometer bias (m/s²), 9 values
  /// Tilt of gravity (factors/gravity_tilt.h), 2 values, the same for all nodes and held at zero:
  /// the world's z axis is up.
  kGravityTilt,
};

struct BlockId {
  NodeId node = 0;
  BlockKind kind = BlockKind::kPose;
};

/// One term of the graph's cost. New kinds (heights of an elevation model, a saved map's frame) are
/// new classes beside the code that has the measurement; the graph stays as it is.
class GraphFactor {
 public:
  virtual ~GraphFactor() = default;

  /// The blocks that the cost depends on, in its own order.
  virtual std::vector<BlockId> blocks() const = 0;
  /// The residuals, in standard deviations; the caller owns what it gets.
  virtual ceres::CostFunction* NewCost() const = 0;
  /// What bounds the pull of a measurement that may be wrong; null: least squares.
  virtual ceres::LossFunction* NewLoss() const { return nullptr; }
  /// Whether the factor may go with its node when that is merged into another. A node that holds
  /// other factors is not merged.
  virtual bool GoesWithItsNode() const { return false; }
};

/// An absolute pose with its information (as Plus() perturbs it; zeros where nothing is known): of
/// a saved map's frame, or of the ground's height alone.
std::unique_ptr<GraphFactor> MakePosePrior(NodeId node, const SE3& T_world_body,
                                           const Matrix6d& information);

/// What inertial measurements say between two nodes with motion states; their body is the IMU.
/// `gravity`: magnitude, m/s².
std::unique_ptr<GraphFactor> MakeImuFactor(NodeId from, NodeId to, const ImuPreintegration& motion,
                                           double gravity);

/// `up` (unit, body frame) as the accelerometer sees it at rest, or an odometry that knows gravity.
/// `sigma`: rad. Goes with its node.
std::unique_ptr<GraphFactor> MakeGravityFactor(NodeId node, const Eigen::Vector3d& up_body,
                                               double sigma);

}  // namespace regolith

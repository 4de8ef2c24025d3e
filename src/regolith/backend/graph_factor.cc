// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/graph_factor.h"

#include "regolith/backend/uncertain_pose.h"
#include "regolith/core/check.h"
#include "regolith/factors/direction_factor.h"
#include "regolith/factors/imu_factor.h"
#include "regolith/factors/pose_prior_factor.h"

namespace regolith {
namespace {

class PosePrior final : public GraphFactor {
 public:
  PosePrior(NodeId node, const SE3& T_world_body, const Matrix6d& information)
      : node_(node), T_world_body_(T_world_body), root_(SquareRootOf(information)) {}

  std::vector<BlockId> blocks() const override { return {{node_, BlockKind::kPose}}; }
  ceres::CostFunction* NewCost() const override {
    return new PosePriorFactor(T_world_body_, root_);
  }

 private:
  NodeId node_;
  SE3 T_world_body_;
  Matrix6d root_;
};

class ImuMotion final : public GraphFactor {
 public:
  ImuMotion(NodeId from, NodeId to, const ImuPreintegration& motion, double gravity)
      : from_(from), to_(to), motion_(motion), gravity_(gravity) {}

  std::vector<BlockId> blocks() const override {
    return {{from_, BlockKind::kPose},
            {from_, BlockKind::kMotion},
            {to_, BlockKind::kPose},
            {to_, BlockKind::kMotion},
            {from_, BlockKind::kGravityTilt}};
  }
  ceres::CostFunction* NewCost() const override { return new ImuFactor(motion_, gravity_); }

 private:
  NodeId from_;
  NodeId to_;
  ImuPreintegration motion_;
  double gravity_;
};

class GravityFactor final : public GraphFactor {
 public:
  GravityFactor(NodeId node, const Eigen::Vector3d& up_body, double sigma)
      : node_(node), up_body_(up_body), sigma_(sigma) {
    REGOLITH_CHECK(sigma > 0.0, "sigma=", sigma);
  }

  std::vector<BlockId> blocks() const override { return {{node_, BlockKind::kPose}}; }
  ceres::CostFunction* NewCost() const override {
    return new DirectionFactor(Eigen::Vector3d::UnitZ(), up_body_, sigma_);
  }
  bool GoesWithItsNode() const override { return true; }

 private:
  NodeId node_;
  Eigen::Vector3d up_body_;
  double sigma_;
};

}  // namespace

std::unique_ptr<GraphFactor> MakePosePrior(NodeId node, const SE3& T_world_body,
                                           const Matrix6d& information) {
  return std::make_unique<PosePrior>(node, T_world_body, information);
}

std::unique_ptr<GraphFactor> MakeImuFactor(NodeId from, NodeId to, const ImuPreintegration& motion,
                                           double gravity) {
  return std::make_unique<ImuMotion>(from, to, motion, gravity);
}

std::unique_ptr<GraphFactor> MakeGravityFactor(NodeId node, const Eigen::Vector3d& up_body,
                                               double sigma) {
  return std::make_unique<GravityFactor>(node, up_body.normalized(), sigma);
}

}  // namespace regolith

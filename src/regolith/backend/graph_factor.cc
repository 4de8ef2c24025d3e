// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/graph_factor.h"

#include "regolith/backend/uncertain_pose.h"
#include "regolith/core/check.h"
#include "regolith/factors/direction_factor.h"
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

std::unique_ptr<GraphFactor> MakeGravityFactor(NodeId node, const Eigen::Vector3d& up_body,
                                               double sigma) {
  return std::make_unique<GravityFactor>(node, up_body.normalized(), sigma);
}

}  // namespace regolith

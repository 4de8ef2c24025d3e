// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/backend/backend_options.h"
#include "regolith/backend/factor_graph.h"
#include "regolith/backend/odometry_chain.h"
#include "regolith/backend/polar_descriptor.h"
#include "regolith/core/span.h"
#include "regolith/core/time.h"

namespace regolith {

/// A moment of the drive that stands for those around it. Its index is that of its node in the
/// graph and of its link in the odometry chain.
struct BackendKeyframe {
  TimeNs time = 0;
  double way = 0.0;                          ///< m driven before it
  std::vector<Eigen::Vector3f> points_body;  ///< m; none once it is merged
  PolarDescriptor descriptor;
};

/// The keyframes of a drive in their order, with the ground that each of them saw.
class KeyframeStore {
 public:
  KeyframeStore(const KeyframeOptions& options, const ReliefMatchOptions& relief)
      : options_(options), relief_(relief) {}

  size_t size() const { return keyframes_.size(); }
  const BackendKeyframe& operator[](size_t index) const { return keyframes_[index]; }

  /// `points_body`: m, the whole scan; what the options keep of it is kept.
  void Append(TimeNs time, double way, Span<const Eigen::Vector3d> points_body);
  /// Describes the newest by the ground around it.
  void DescribeNewest(const FactorGraph& graph, const OdometryChain& odometry);
  void ForgetPoints(size_t index);

  /// The ground around a keyframe, in its body frame: points of those within the submap's length
  /// along the drive, from `first` to `last` (exclusive), placed by the graph. It ends where
  /// odometry went blind for a while: what lies beyond would be doubled ground.
  std::vector<Eigen::Vector3d> Submap(size_t index, size_t first, size_t last,
                                      const FactorGraph& graph,
                                      const OdometryChain& odometry) const;

 private:
  KeyframeOptions options_;
  ReliefMatchOptions relief_;
  std::vector<BackendKeyframe> keyframes_;
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/terrain/surface.h"

namespace regolith {

/// A surface seen from another origin: frame `world` lies at `origin` (m) of the surface's frame,
/// axes parallel.
class Ground {
 public:
  Ground(const Surface& surface, const Eigen::Vector3d& origin)
      : surface_(&surface), origin_(origin) {}

  /// Height (m) at x, y (m, world), as Surface::Height.
  double Height(double x, double y, double spacing) const {
    return surface_->Height(x + origin_.x(), y + origin_.y(), spacing) - origin_.z();
  }
  double Albedo(double x, double y, double spacing) const {
    return surface_->Albedo(x + origin_.x(), y + origin_.y(), spacing);
  }
  /// As Surface::Sample, with the block in world.
  void Sample(PostBlock block, std::vector<double>* heights, std::vector<float>* albedo) const {
    block.x += origin_.x();
    block.y += origin_.y();
    surface_->Sample(block, heights, albedo);
    for (double& height : *heights) height -= origin_.z();
  }

  const Surface& surface() const { return *surface_; }
  const Eigen::Vector3d& origin() const { return origin_; }

 private:
  const Surface* surface_;
  Eigen::Vector3d origin_;
};

}  // namespace regolith

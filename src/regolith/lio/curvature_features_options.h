// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct CurvatureFeatureOptions {
  int neighbours = 5;  ///< on either side along the ring, that a point's curvature is taken from
  int sectors = 6;  ///< of a turn; features are shared out among them so that they lie all around
  int sharp_edges = 2;   ///< a ring and sector, the most curved
  int edges = 20;        ///< the same, with the sharp ones
  int flat_planars = 4;  ///< a ring and sector, the least curved
  /// Curvature |Σ (r_j - r_i)| / (2 neighbours · r_i): above it a point may be an edge …
  double edge_curvature = 0.01;
  double planar_curvature = 0.005;  ///< … below this one planar
  /// Of a step in range between neighbours, m and share of the range; beyond the larger of them the
  /// farther side is behind something, and what bounds it is no edge of its own.
  double occlusion_step = 0.3;
  double occlusion_share = 0.03;
  /// Share of its range by which both neighbours differ where a beam grazes the surface.
  double grazing_share = 0.02;

  /// Throws CheckError on values that make no features.
  void Check() const;
};

}  // namespace regolith

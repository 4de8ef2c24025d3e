// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"
#include "regolith/registration/scan_matcher_options.h"

namespace regolith {

/// How the shapes of the ground around two places are compared.
struct ReliefMatchOptions {
  double cell_size = 0.5;    ///< m, of the grid and of the steps of the search
  double radius = 16.0;      ///< m around the keyframe
  double yaw_step = 0.04;    ///< rad
  double min_overlap = 0.4;  ///< share of the cells of one that the other has seen too
  int min_cells = 200;       ///< in common

  void Check() const {
    REGOLITH_CHECK(cell_size > 0.0, "cell_size=", cell_size);
    REGOLITH_CHECK(radius > 4.0 * cell_size, "radius=", radius);
    REGOLITH_CHECK(yaw_step > 0.0, "yaw_step=", yaw_step);
    REGOLITH_CHECK(min_overlap > 0.0 && min_overlap <= 1.0, "min_overlap=", min_overlap);
    REGOLITH_CHECK(min_cells >= 10, "min_cells=", min_cells);
  }
};

struct LoopVerifierOptions {
  ReliefMatchOptions relief;
  /// Of the best offset on the grid, so that registration is tried at all: 1 where both places have
  /// the same shape, 0 for unrelated ones.
  double try_agreement = 0.5;
  double min_agreement = 0.9;  ///< where registration has placed it
  /// Disagreement (1 - agreement) there over that at the next best offset elsewhere: more is
  /// ambiguous.
  double max_ambiguity = 0.5;
  double separation = 2.0;      ///< m, what is "elsewhere" …
  double yaw_separation = 0.2;  ///< … or rad
  ScanMatcherOptions matcher;
  double voxel_size = 0.5;      ///< m, of the finer of the two maps that is matched against
  double point_spacing = 0.35;  ///< m, of the points that are matched
  int max_points = 4000;
  double min_matches = 0.4;            ///< share of the points that have to find a plane
  double max_scale = 0.05;             ///< m, robust standard deviation of their distances
  double max_correction = 1.0;         ///< m, that registration may move the best offset …
  double max_turn = 0.12;              ///< … and rad that it may turn it
  double floor_rotation_sigma = 8e-4;  ///< rad, least 1 σ of a loop (docs/backend.md)
  double floor_position_sigma = 0.01;  ///< m, least 1 σ of a loop

  void Check() const {
    relief.Check();
    matcher.Check();
    REGOLITH_CHECK(try_agreement > 0.0 && try_agreement <= min_agreement,
                   "try_agreement=", try_agreement);
    REGOLITH_CHECK(min_agreement > 0.0 && min_agreement < 1.0, "min_agreement=", min_agreement);
    REGOLITH_CHECK(max_ambiguity > 0.0 && max_ambiguity < 1.0, "max_ambiguity=", max_ambiguity);
    REGOLITH_CHECK(separation > relief.cell_size, "separation=", separation);
    REGOLITH_CHECK(yaw_separation > relief.yaw_step, "yaw_separation=", yaw_separation);
    REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
    REGOLITH_CHECK(point_spacing > 0.0, "point_spacing=", point_spacing);
    REGOLITH_CHECK(max_points >= 100, "max_points=", max_points);
    REGOLITH_CHECK(min_matches > 0.0 && min_matches < 1.0, "min_matches=", min_matches);
    for (const double limit :
         {max_scale, max_correction, max_turn, floor_rotation_sigma, floor_position_sigma}) {
      REGOLITH_CHECK(limit > 0.0, "limit=", limit);
    }
  }
};

}  // namespace regolith

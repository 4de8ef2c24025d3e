// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/backend/factor_graph_options.h"
#include "regolith/backend/loop_consistency_options.h"
#include "regolith/backend/loop_verifier_options.h"
#include "regolith/core/check.h"

namespace regolith {

/// Which poses become keyframes, and what of them is kept.
struct KeyframeOptions {
  double distance = 1.0;        ///< m from one keyframe to the next …
  double angle = 0.35;          ///< … or rad …
  double seconds = 20.0;        ///< … or s
  double point_spacing = 0.25;  ///< m, of the points kept …
  double radius = 20.0;         ///< … within this many m
  double submap_length = 4.0;   ///< m of the drive on either side, that loops are matched with
  double submap_sigma = 0.5;  ///< m, 1 σ: ground that odometry lost more on the way to is left out
  /// Of an odometry step, least 1 σ.
  double floor_rotation_sigma = 1e-4;  ///< rad
  double floor_position_sigma = 1e-3;  ///< m
  double gravity_sigma = 3e-3;         ///< rad, of an inertial odometry's up

  void Check() const {
    for (const double value :
         {distance, angle, seconds, point_spacing, radius, submap_length, submap_sigma,
          floor_rotation_sigma, floor_position_sigma, gravity_sigma}) {
      REGOLITH_CHECK(value > 0.0, "value=", value);
    }
  }
};

/// Where loops are looked for.
struct LoopSearchOptions {
  double min_age = 30.0;          ///< s; younger keyframes make no loop
  double min_way = 10.0;          ///< m driven in between
  double max_distance = 4.0;      ///< m between the two places, as far as they are known
  double sigmas = 3.0;            ///< of what both may be off by, are searched too …
  double max_doubt = 6.0;         ///< … up to this many m
  double least_doubt = 1.5;       ///< m
  double least_yaw_doubt = 0.08;  ///< rad
  double max_yaw_doubt = 0.3;     ///< rad
  int max_candidates = 2;         ///< verified a keyframe

  void Check() const {
    REGOLITH_CHECK(min_age >= 0.0, "min_age=", min_age);
    REGOLITH_CHECK(min_way >= 0.0, "min_way=", min_way);
    REGOLITH_CHECK(max_distance > 0.0, "max_distance=", max_distance);
    REGOLITH_CHECK(sigmas > 0.0, "sigmas=", sigmas);
    REGOLITH_CHECK(least_doubt > 0.0 && least_doubt <= max_doubt, "least_doubt=", least_doubt);
    REGOLITH_CHECK(least_yaw_doubt > 0.0 && least_yaw_doubt <= max_yaw_doubt,
                   "least_yaw_doubt=", least_yaw_doubt);
    REGOLITH_CHECK(max_candidates >= 1, "max_candidates=", max_candidates);
  }
};

/// Keyframes on explored ground are merged into the old ones (FactorGraph::Merge).
struct MergeOptions {
  bool enabled = true;
  double max_distance = 2.0;  ///< m from the old keyframe
  int delay = 15;             ///< keyframes that have to come first, so that loops are settled

  void Check() const {
    REGOLITH_CHECK(max_distance > 0.0, "max_distance=", max_distance);
    REGOLITH_CHECK(delay >= 1, "delay=", delay);
  }
};

struct BackendOptions {
  bool enabled = true;
  bool close_loops = true;
  KeyframeOptions keyframes;
  LoopSearchOptions search;
  LoopVerifierOptions verifier;
  LoopConsistencyOptions consistency;
  MergeOptions merge;
  FactorGraphOptions graph;

  /// Throws CheckError on values that make no back end.
  void Check() const {
    keyframes.Check();
    search.Check();
    verifier.Check();
    consistency.Check();
    merge.Check();
    graph.Check();
  }
};

}  // namespace regolith

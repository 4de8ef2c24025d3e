// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

/// How an estimate is laid over its reference before their difference is measured.
enum class AlignmentMode {
  kSe3,     ///< rotation and translation
  kSim3,    ///< rotation, translation and scale
  kYaw,     ///< rotation about z and translation: what gravity leaves unknown
  kOrigin,  ///< the first associated poses are laid together
  kNone,
};

struct EvaluationOptions {
  AlignmentMode alignment = AlignmentMode::kSe3;
  double max_difference = 0.02;    ///< s between the stamps of associated poses
  double segment_length = 10.0;    ///< m along the path, of the pairs that measure drift
  double segment_tolerance = 0.1;  ///< share of segment_length; evo's default

  void Check() const {
    REGOLITH_CHECK(max_difference >= 0.0, "max_difference ", max_difference);
    REGOLITH_CHECK(segment_length > 0.0, "segment_length ", segment_length);
    REGOLITH_CHECK(segment_tolerance >= 0.0, "segment_tolerance ", segment_tolerance);
  }
};

}  // namespace regolith

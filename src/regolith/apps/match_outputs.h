// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/eval/match_score.h"
#include "regolith/features/feature_frontend.h"
#include "regolith/features/feature_options.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// How long things took, milliseconds: one entry a repetition.
struct MatchTimes {
  std::vector<std::vector<StageTime>> stages;
  std::vector<double> total;  ///< both images to matches
  std::vector<double> frame;  ///< extraction of one image, each in turn
};

/// The matches against truth.
struct MatchTruth {
  std::string kind;        ///< homography or correspondences
  double tolerance = 0.0;  ///< pixels
  MatchScore score;
  std::optional<double> repeatability_1px;
  std::optional<double> repeatability_3px;
};

struct MatchImage {
  std::string path;
  Image image;
};

/// All that `regolith match` found out.
struct MatchRecord {
  FeatureOptions options;
  std::optional<ModelManifest> model;
  std::string precision;  ///< of the network's numbers; empty without one
  MatchImage first;
  MatchImage second;
  PairMatches pair;
  MatchTimes times;
  std::optional<MatchTruth> truth;
};

/// Writes the files of `regolith match` into a folder. Times stand in summary.json and match.png
/// alone; the rest is the same bytes for the same images and options. Throws OutputError.
void WriteMatchOutputs(const std::string& folder, const MatchRecord& record);

/// For the terminal: the main figures in aligned lines.
std::string MatchTable(const MatchRecord& record);

}  // namespace regolith

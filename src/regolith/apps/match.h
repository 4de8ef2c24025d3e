// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace regolith {

struct MatchArguments {
  std::string first;   ///< PNG or JPEG
  std::string second;  ///< PNG or JPEG
  std::optional<std::string> features;
  std::optional<int> max_keypoints;
  std::string homography;       ///< truth: text file, image 1 to image 2
  std::string correspondences;  ///< truth: two bands, as `simulate --pairs` writes
  std::string config;           ///< YAML with the key `features:`
  std::vector<std::string> set;
  std::optional<int> threads;  ///< of inference, instead of the options'; 0: one for each core
  std::string out;
  bool overwrite = false;
  bool quiet = false;
};

/// `regolith match`: finds the same points in two images. Writes keypoints_1.csv, keypoints_2.csv,
/// matches.csv, match.png, config.yaml and summary.json and prints a table. Returns the exit code:
/// 0, or 130 where it was interrupted, with nothing written. Throws InputError and OutputError.
int Match(const MatchArguments& arguments);

}  // namespace regolith

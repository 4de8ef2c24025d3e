// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "regolith/apps/reproduce_plan.h"

namespace regolith {

/// One method on one recording.
struct TrackCell {
  std::string folder;   ///< holds metrics.json, summary.json, trajectory.tum, …
  std::string failure;  ///< why there is no result; empty where there is one

  double ape_rmse = 0.0;  ///< m
  double ape_mean = 0.0;  ///< m
  double length = 0.0;    ///< m
  double coverage = 0.0;  ///< share of the recording's stamps that have a pose
  std::optional<double> drift_percent;
  double recording_seconds = 0.0;
  double cpu_seconds = 0.0;
  double real_time_factor = 0.0;
  double memory_mb = 0.0;
  std::optional<double> joules;
  int resets = 0;
  std::string version;
};

/// One method on one image pair.
struct MatchCell {
  std::string failure;
  bool same_sun = true;
  int found = 0;  ///< matches that outlier rejection keeps
  int known = 0;  ///< of them with known truth
  int correct = 0;
  double seconds = 0.0;  ///< from both images to matches
};

/// Makes cells inside a folder; what is there already is read instead. Each is made by a command
/// of this program in a process of its own, and appears under its name when it is complete.
class CellMaker {
 public:
  CellMaker(const ReproduceArguments& arguments, ReproducePlan plan);

  const ReproducePlan& plan() const { return plan_; }
  const std::string& out() const { return arguments_.out; }

  /// All cells of one scene and seed; the recording is simulated where one of them is missing, and
  /// deleted afterwards. Interrupted, it stays for the next call.
  std::vector<TrackCell> MakeTracks(const Scene& scene, uint64_t seed);

  /// By method, the image pairs of one scene and seed.
  std::vector<std::vector<MatchCell>> MakeMatches(const Scene& scene, uint64_t seed);

  /// The folder of one scene and seed: "cells/lunar_1" below `out`.
  std::string SceneFolder(const Scene& scene, uint64_t seed) const;
  std::string MatchFolder(const Scene& scene, uint64_t seed) const;

 private:
  std::string SimulateFailure(const Scene& scene, uint64_t seed);
  bool PairsAreThere(const Scene& scene, uint64_t seed, std::string* failure);
  TrackCell MakeTrack(const TrackMethod& method, const std::string& recording,
                      const std::string& folder);
  std::string RunMethod(const TrackMethod& method, const std::string& recording,
                        const std::string& folder);
  std::string Evaluate(const std::string& reference, const std::string& folder);
  std::string MatchFailure(const MatchMethod& method, const std::string& pair,
                           const std::string& folder);
  std::string OutsideMatchFailure(const MatchMethod& method, const std::string& folder);
  std::vector<MatchCell> MatchPairs(const MatchMethod& method, const std::string& folder);
  std::string ExistingFailure(const TrackMethod& method) const;
  void Say(const std::string& line) const;

  ReproduceArguments arguments_;
  ReproducePlan plan_;
  std::string program_;
};

/// The interpreter that has the outside packages: --python, else REGOLITH_OUTSIDE_PYTHON, else
/// python3.
std::string OutsidePython(const ReproduceArguments& arguments);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "regolith/apps/reproduce.h"

namespace regolith {

/// The paper's figures of a method (Aerospace 2024, 11, 768, table 2), m.
struct PaperErrors {
  double moon_rmse = 0.0;
  double moon_mean = 0.0;
  double mars_rmse = 0.0;
  double mars_mean = 0.0;
};

/// A row of table 2.
struct TrackMethod {
  std::string key;       ///< names its folder
  std::string label;     ///< as the table shows it
  std::string origin;    ///< whose method it is and who wrote it
  std::string pipeline;  ///< empty: an outside program, named by its key
  std::string features;  ///< instead of the pipeline's; empty: those
  std::optional<PaperErrors> paper;
};

/// The paper's figures of a method (table 1).
struct PaperMatches {
  int found = 0;
  int correct = 0;
  double seconds = 0.0;
};

/// A row of table 1.
struct MatchMethod {
  std::string key;
  std::string label;
  std::string features;  ///< of `regolith match`; empty: an outside package
  bool adaptive = true;
  std::optional<PaperMatches> paper_moon;
  std::optional<PaperMatches> paper_mars;
  std::string package = {};  ///< of outside_match.py
  bool second_look = false;
};

struct Scene {
  std::string name;      ///< "Moon" or "Mars", the paper's experiments; else the scenario's
  std::string scenario;  ///< name in config/scenarios

  bool IsMoon() const { return name == "Moon"; }
  bool IsOfThePaper() const { return IsMoon() || name == "Mars"; }
};

/// All that a reproduction makes.
struct ReproducePlan {
  std::string scale;
  std::vector<Scene> scenes;
  std::vector<uint64_t> seeds;
  std::vector<TrackMethod> tracks;
  std::vector<MatchMethod> matches;
  int pairs = 0;
  std::optional<double> duration;
  std::string quality;
  double run_timeout = 0.0;       ///< s for one run
  double simulate_timeout = 0.0;  ///< s for one recording
};

/// Throws InputError for an unknown scale, scenario, method or a number out of range.
ReproducePlan MakePlan(const ReproduceArguments& arguments);

/// What cells of a folder must agree in, as text: an interrupted reproduction goes on only with
/// the same.
std::string PlanText(const ReproducePlan& plan);

}  // namespace regolith

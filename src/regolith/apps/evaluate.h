// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace regolith {

/// The arguments of `regolith evaluate`.
struct EvaluateArguments {
  std::string reference;               ///< TUM file
  std::vector<std::string> estimates;  ///< TUM files
  std::string align = "se3";           ///< se3, sim3, yaw, origin or none
  double max_difference = 0.02;        ///< s between the stamps of associated poses
  std::string out;                     ///< folder; empty: the table is printed and nothing written
  bool overwrite = false;
  bool quiet = false;
};

/// Measures estimates against a reference by evo's definitions, prints a table and writes
/// metrics.json (one estimate: its metrics; several: {"estimates": {name: metrics}}), the same as
/// metrics.csv, its main figures as metrics.tex and metrics.txt, and the figures of DrawEvaluation.
/// Returns the exit code; throws InputError and OutputError.
int Evaluate(const EvaluateArguments& arguments);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace regolith {

/// The arguments of `regolith reproduce`.
struct ReproduceArguments {
  std::string scale = "short";         ///< short or full
  std::optional<int> seeds;            ///< 1 to N; short: 1, full: 3
  std::optional<double> duration;      ///< s of every drive, instead of the scenario's
  std::optional<int> pairs;            ///< image pairs a scenario and seed
  std::vector<std::string> scenarios;  ///< instead of the paper's two experiments
  std::vector<std::string> methods;    ///< of table 2, by their keys; empty: all
  std::string quality = "full";        ///< of `simulate`
  std::string python;                  ///< interpreter with the outside packages
  int threads = 2;
  std::string out;
  bool quiet = false;
};

/// `regolith reproduce`: makes the paper's tables and figures with our data, by calling this
/// program's other commands. What is finished in `out` is kept and not made again. A cell that
/// fails says why and takes no other down. Returns the exit code: 0 even where cells have failed,
/// 130 where it was interrupted. Throws InputError.
int Reproduce(const ReproduceArguments& arguments);

}  // namespace regolith

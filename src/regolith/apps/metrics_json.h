// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/eval/evaluation.h"

namespace regolith {

struct NamedEvaluation {
  std::string name;
  Evaluation evaluation;
};

/// The text of metrics.json (docs: "Files"). What an estimate does not have, such as drift on a
/// path below 10 m, is null.
std::string MetricsJson(const std::vector<NamedEvaluation>& evaluations);

/// The same as comma-separated values, a row an estimate.
std::string MetricsCsv(const std::vector<NamedEvaluation>& evaluations);

/// The main figures as a table for a paper (package booktabs); the best of several in bold.
std::string MetricsLatex(const std::vector<NamedEvaluation>& evaluations);

/// For the terminal: the main figures in aligned columns.
std::string MetricsTable(const std::vector<NamedEvaluation>& evaluations);

}  // namespace regolith

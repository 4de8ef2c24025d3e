// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/metrics_json.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <nlohmann/json.hpp>

namespace regolith {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const ErrorStatistics& statistics) {
  return {{"rmse", statistics.rmse}, {"mean", statistics.mean}, {"median", statistics.median},
          {"std", statistics.std},   {"min", statistics.min},   {"max", statistics.max},
          {"sse", statistics.sse}};
}

template <typename Value>
Json ToJsonOrNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json ToJson(const Evaluation& evaluation) {
  Json json;
  json["matched"] = evaluation.matched;
  json["length_m"] = evaluation.length_m;
  json["ape"] = ToJson(evaluation.ape);
  json["rpe"] = ToJson(evaluation.rpe);
  json["rpe_10m"] = evaluation.rpe_10m ? ToJson(*evaluation.rpe_10m) : Json(nullptr);
  json["percent_of_distance"] = ToJsonOrNull(evaluation.percent_of_distance);
  json["drift_percent"] = ToJsonOrNull(evaluation.drift_percent);
  json["rotation_deg_per_m"] = ToJsonOrNull(evaluation.rotation_deg_per_m);
  json["rotation_deg"] = evaluation.rotation_deg;
  json["scale"] = evaluation.alignment.scale;
  return json;
}

/// "ape.rmse" and its value, for every number of the metrics.
std::vector<std::pair<std::string, std::string>> Flatten(const Json& metrics) {
  constexpr const char* kStatistics[] = {"rmse", "mean", "median", "std", "min", "max", "sse"};
  std::vector<std::pair<std::string, std::string>> cells;
  for (const auto& [key, value] : metrics.items()) {
    const bool is_statistics = key == "ape" || key == "rpe" || key == "rpe_10m";
    if (!is_statistics) {
      cells.emplace_back(key, value.is_null() ? "" : value.dump());
      continue;
    }
    for (const char* name : kStatistics) {
      cells.emplace_back(key + "_" + name, value.is_null() ? "" : value[name].dump());
    }
  }
  return cells;
}

std::string QuoteCsv(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char character : text) {
    quoted += character;
    if (character == '"') quoted += '"';
  }
  return quoted + "\"";
}

std::string Cell(const std::optional<double>& value) {
  if (!value) return "-";
  char text[32];
  std::snprintf(text, sizeof(text), "%.4f", *value);
  return text;
}

std::vector<std::string> TableRow(const NamedEvaluation& named) {
  const Evaluation& evaluation = named.evaluation;
  const auto ten_metres =
      evaluation.rpe_10m ? std::optional<double>(evaluation.rpe_10m->rmse) : std::nullopt;
  return {named.name,
          std::to_string(evaluation.matched),
          Cell(evaluation.length_m),
          Cell(evaluation.ape.rmse),
          Cell(evaluation.ape.mean),
          Cell(evaluation.ape.median),
          Cell(evaluation.ape.max),
          Cell(evaluation.rpe.rmse),
          Cell(ten_metres),
          Cell(evaluation.percent_of_distance),
          Cell(evaluation.drift_percent),
          Cell(evaluation.rotation_deg)};
}

}  // namespace

std::string MetricsJson(const std::vector<NamedEvaluation>& evaluations) {
  if (evaluations.size() == 1) return ToJson(evaluations.front().evaluation).dump(2) + "\n";
  Json json;
  for (const NamedEvaluation& named : evaluations) {
    json["estimates"][named.name] = ToJson(named.evaluation);
  }
  // Names come from the file system and need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string MetricsCsv(const std::vector<NamedEvaluation>& evaluations) {
  std::string header = "estimate";
  std::string rows;
  for (size_t i = 0; i < evaluations.size(); ++i) {
    rows += QuoteCsv(evaluations[i].name);
    for (const auto& [name, value] : Flatten(ToJson(evaluations[i].evaluation))) {
      if (i == 0) header += "," + name;
      rows += "," + value;
    }
    rows += "\n";
  }
  return header + "\n" + rows;
}

std::string MetricsTable(const std::vector<NamedEvaluation>& evaluations) {
  std::vector<std::vector<std::string>> rows = {
      {"", "matched", "length", "APE RMSE", "mean", "median", "max", "RPE", "RPE 10 m",
       "% of length", "drift", "rotation"},
      {"", "", "m", "m", "m", "m", "m", "m", "m", "%", "%", "deg"}};
  for (const NamedEvaluation& named : evaluations) rows.push_back(TableRow(named));
  std::string table;
  std::vector<size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto& row : rows) {
    table += row[0] + std::string(widths[0] - row[0].size(), ' ');
    for (size_t i = 1; i < row.size(); ++i) {
      table += std::string(2 + widths[i] - row[i].size(), ' ') + row[i];
    }
    table += "\n";
  }
  return table;
}

}  // namespace regolith

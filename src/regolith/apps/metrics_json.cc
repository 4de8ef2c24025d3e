// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/metrics_json.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

#include <nlohmann/json.hpp>

namespace regolith {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kAxisKeys[] = {"x_m", "y_m", "z_m"};

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
  json["fitted_scale"] = ToJsonOrNull(evaluation.fitted_scale);
  json["time_coverage"] = evaluation.time_coverage;
  for (size_t axis = 0; axis < 3; ++axis) {
    json[kAxisKeys[axis]] = ToJson(evaluation.axes[axis]);
  }
  json["yaw_deg"] = ToJson(evaluation.yaw);
  return json;
}

/// "ape.rmse" and its value, for every number of the metrics.
std::vector<std::pair<std::string, std::string>> Flatten(const Json& metrics) {
  constexpr const char* kStatistics[] = {"rmse", "mean", "median", "std", "min", "max", "sse"};
  std::vector<std::pair<std::string, std::string>> cells;
  for (const auto& [key, value] : metrics.items()) {
    if (key != "rpe_10m" && !value.is_object()) {
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

/// One column of the tables for people.
struct Column {
  const char* title;
  const char* unit;
  const char* latex;  ///< nullptr: left out of the paper's table
  std::optional<double> (*value)(const Evaluation&);
};

using Value = std::optional<double>;

constexpr Column kColumns[] = {
    {"length", "m", "length (m)", [](const Evaluation& e) -> Value { return e.length_m; }},
    {"APE RMSE", "m", "APE RMSE (m)", [](const Evaluation& e) -> Value { return e.ape.rmse; }},
    {"mean", "m", "mean (m)", [](const Evaluation& e) -> Value { return e.ape.mean; }},
    {"median", "m", nullptr, [](const Evaluation& e) -> Value { return e.ape.median; }},
    {"max", "m", "max (m)", [](const Evaluation& e) -> Value { return e.ape.max; }},
    {"x", "m", nullptr, [](const Evaluation& e) -> Value { return e.axes[0].rmse; }},
    {"y", "m", nullptr, [](const Evaluation& e) -> Value { return e.axes[1].rmse; }},
    {"z", "m", nullptr, [](const Evaluation& e) -> Value { return e.axes[2].rmse; }},
    {"yaw", "deg", "yaw (deg)", [](const Evaluation& e) -> Value { return e.yaw.rmse; }},
    {"RPE", "m", nullptr, [](const Evaluation& e) -> Value { return e.rpe.rmse; }},
    {"RPE 10 m", "m", nullptr,
     [](const Evaluation& e) -> Value {
       return e.rpe_10m ? Value(e.rpe_10m->rmse) : std::nullopt;
     }},
    {"of length", "%", "of length (\\%)",
     [](const Evaluation& e) -> Value { return e.percent_of_distance; }},
    {"drift", "%", "drift (\\%)", [](const Evaluation& e) -> Value { return e.drift_percent; }},
    {"rotation", "deg", nullptr, [](const Evaluation& e) -> Value { return e.rotation_deg; }},
    {"scale", "", nullptr, [](const Evaluation& e) -> Value { return e.fitted_scale; }},
    {"coverage", "%", nullptr,
     [](const Evaluation& e) -> Value { return 100.0 * e.time_coverage; }},
};

std::string EscapeLatex(const std::string& text) {
  std::string escaped;
  for (const char character : text) {
    if (std::strchr("&%$#_{}", character) != nullptr) {
      escaped += '\\';
      escaped += character;
    } else if (character == '\\') {
      escaped += "\\textbackslash{}";
    } else if (character == '~' || character == '^') {
      escaped += std::string("\\") + character + "{}";
    } else {
      escaped += character;
    }
  }
  return escaped;
}

/// The least value of a column, as it is printed; nothing for the length, or for one estimate.
std::string BestCell(const Column& column, const std::vector<NamedEvaluation>& evaluations) {
  Value best;
  if (evaluations.size() < 2 || std::strcmp(column.title, "length") == 0) return "";
  for (const NamedEvaluation& named : evaluations) {
    const Value value = column.value(named.evaluation);
    if (value && (!best || *value < *best)) best = value;
  }
  return best ? Cell(best) : "";
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

std::string MetricsLatex(const std::vector<NamedEvaluation>& evaluations) {
  std::string columns = "l";
  std::string header = "estimate";
  for (const Column& column : kColumns) {
    if (column.latex == nullptr) continue;
    columns += "r";
    header += std::string(" & ") + column.latex;
  }
  std::string rows;
  for (const NamedEvaluation& named : evaluations) {
    rows += EscapeLatex(named.name);
    for (const Column& column : kColumns) {
      if (column.latex == nullptr) continue;
      const std::string cell = Cell(column.value(named.evaluation));
      const bool is_best = cell == BestCell(column, evaluations);
      rows += is_best ? " & \\textbf{" + cell + "}" : " & " + cell;
    }
    rows += " \\\\\n";
  }
  return "% \\usepackage{booktabs}\n\\begin{tabular}{" + columns + "}\n\\toprule\n" + header +
         " \\\\\n\\midrule\n" + rows + "\\bottomrule\n\\end{tabular}\n";
}

std::string MetricsTable(const std::vector<NamedEvaluation>& evaluations) {
  std::vector<std::vector<std::string>> rows = {{"", "matched"}, {"", ""}};
  for (const Column& column : kColumns) {
    rows[0].push_back(column.title);
    rows[1].push_back(column.unit);
  }
  for (const NamedEvaluation& named : evaluations) {
    rows.push_back({named.name, std::to_string(named.evaluation.matched)});
    for (const Column& column : kColumns) {
      rows.back().push_back(Cell(column.value(named.evaluation)));
    }
  }
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

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/reproduce_document.h"

#include <algorithm>
#include <cstdio>
#include <functional>

#include "regolith/apps/number_text.h"
#include "regolith/core/check.h"

namespace regolith {
namespace {

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// "0.123" or, over several seeds, "0.123 (0.1–0.2)"; "–" for nothing.
std::string Spread(const char* format, const std::vector<double>& values) {
  if (values.empty()) return "–";
  const std::string median = Text(format, Median(values));
  if (values.size() == 1) return median;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return median + " (" + Text(format, *least) + "–" + Text(format, *most) + ")";
}

/// The cells of one method in one scene, and the first reason of those that failed.
struct MethodCells {
  std::vector<const TrackCell*> finished;
  size_t count = 0;
  std::string failure;

  std::vector<double> Values(const std::function<double(const TrackCell&)>& value) const {
    std::vector<double> values;
    for (const TrackCell* cell : finished) values.push_back(value(*cell));
    return values;
  }
};

MethodCells CellsOf(const std::vector<SceneResults>& results, const Scene& scene, size_t method) {
  MethodCells cells;
  for (const SceneResults& result : results) {
    if (result.scene.scenario != scene.scenario) continue;
    const TrackCell& cell = result.tracks[method];
    ++cells.count;
    if (cell.failure.empty()) cells.finished.push_back(&cell);
    if (!cell.failure.empty() && cells.failure.empty()) cells.failure = cell.failure;
  }
  return cells;
}

std::vector<DocumentCell> FailedRow(const std::string& label, size_t columns,
                                    const std::string& failure) {
  std::vector<DocumentCell> row = {{label}};
  row.resize(columns, {"–"});
  row.back() = {failure.empty() ? "not made yet" : "failed: " + failure, false, true};
  return row;
}

/// Makes the least number of a column bold; texts begin with their number.
void MarkLeast(size_t column, DocumentTable* table) {
  DocumentCell* best = nullptr;
  double least = 0.0;
  for (std::vector<DocumentCell>& row : table->rows) {
    char* end = nullptr;
    const double value = std::strtod(row[column].text.c_str(), &end);
    if (end == row[column].text.c_str() || (best != nullptr && value >= least)) continue;
    best = &row[column];
    least = value;
  }
  if (best != nullptr) best->is_best = true;
}

struct PaperPair {
  std::string rmse = "–";
  std::string mean = "–";
};

PaperPair PaperOf(const TrackMethod& method, const Scene& scene) {
  if (!method.paper || !scene.IsOfThePaper()) return {};
  const bool is_moon = scene.IsMoon();
  return {Text("%.3f", is_moon ? method.paper->moon_rmse : method.paper->mars_rmse),
          Text("%.3f", is_moon ? method.paper->moon_mean : method.paper->mars_mean)};
}

size_t MethodIndex(const ReproducePlan& plan, const std::string& key) {
  for (size_t i = 0; i < plan.tracks.size(); ++i) {
    if (plan.tracks[i].key == key) return i;
  }
  return plan.tracks.size();
}

std::string QuoteCsv(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return "\"" + text + "\"";
}

}  // namespace

DocumentTable MatchTable(const ReproducePlan& plan, const std::vector<SceneResults>& results,
                         const Scene& scene, bool same_sun) {
  DocumentTable table;
  table.columns = {"method",  "paper: found", "correct", "s",     "found",
                   "correct", "correct rate", "s",       "result"};
  size_t pairs = 0;
  for (size_t m = 0; m < plan.matches.size(); ++m) {
    const MatchMethod& method = plan.matches[m];
    std::vector<double> found;
    std::vector<double> correct;
    std::vector<double> seconds;
    int all_known = 0;
    int all_correct = 0;
    std::string failure;
    for (const SceneResults& result : results) {
      if (result.scene.scenario != scene.scenario) continue;
      for (const MatchCell& cell : result.matches[m]) {
        if (!cell.failure.empty()) failure = cell.failure;
        if (!cell.failure.empty() || cell.same_sun != same_sun) continue;
        found.push_back(cell.found);
        correct.push_back(cell.correct);
        seconds.push_back(cell.seconds);
        all_known += cell.known;
        all_correct += cell.correct;
      }
    }
    if (found.empty()) {
      if (failure.empty()) continue;  // no such pair
      table.rows.push_back(FailedRow(method.label, table.columns.size(), failure));
      continue;
    }
    pairs = std::max(pairs, found.size());
    const auto& paper = scene.IsMoon() ? method.paper_moon : method.paper_mars;
    const bool shown = paper && same_sun && scene.IsOfThePaper();
    table.rows.push_back({{method.label},
                          {shown ? std::to_string(paper->found) : "–"},
                          {shown ? std::to_string(paper->correct) : "–"},
                          {shown ? Text("%.3f", paper->seconds) : "–"},
                          {Text("%.0f", Median(found))},
                          {Text("%.0f", Median(correct))},
                          {all_known > 0 ? Text("%.1f %%", 100.0 * all_correct / all_known) : "–"},
                          {Text("%.3f", Median(seconds))},
                          failure.empty() ? DocumentCell{"done"}
                                          : DocumentCell{"in part: " + failure, false, true}});
  }
  table.caption =
      scene.name + Concatenate(", ", pairs, pairs == 1 ? " image pair" : " image pairs",
                               same_sun ? " under one sun" : ", the sun elsewhere in one");
  return table;
}

DocumentTable ErrorTable(const ReproducePlan& plan, const std::vector<SceneResults>& results,
                         const Scene& scene) {
  DocumentTable table;
  table.columns = {"method",   "paper: RMSE, m", "paper: mean, m", "RMSE, m",   "mean, m",
                   "coverage", "drift, %",       "runs",           "what it is"};
  double length = 0.0;
  for (size_t m = 0; m < plan.tracks.size(); ++m) {
    const TrackMethod& method = plan.tracks[m];
    const MethodCells cells = CellsOf(results, scene, m);
    const PaperPair paper = PaperOf(method, scene);
    if (cells.finished.empty()) {
      table.rows.push_back(FailedRow(method.label, table.columns.size(), cells.failure));
      table.rows.back()[1].text = paper.rmse;
      table.rows.back()[2].text = paper.mean;
      continue;
    }
    std::vector<double> drifts;
    std::vector<double> coverages;
    for (const TrackCell* cell : cells.finished) {
      if (cell->drift_percent) drifts.push_back(*cell->drift_percent);
      if (cell->coverage > 0.0) coverages.push_back(100.0 * cell->coverage);
      length = std::max(length, cell->length);
    }
    table.rows.push_back(
        {{method.label},
         {paper.rmse},
         {paper.mean},
         {Spread("%.3f", cells.Values([](const TrackCell& cell) { return cell.ape_rmse; }))},
         {Spread("%.3f", cells.Values([](const TrackCell& cell) { return cell.ape_mean; }))},
         {coverages.empty() ? "–" : Text("%.2f %%", Median(coverages))},
         {Spread("%.2f", drifts)},
         {Concatenate(cells.finished.size(), " of ", cells.count)},
         {method.origin}});
  }
  MarkLeast(3, &table);
  MarkLeast(4, &table);
  table.caption = scene.name + ": error of the trajectory (APE, aligned by SE(3)), path of " +
                  Text("%.0f m", length);
  table.notes = {
      "Median over the seeds (least–most). Coverage: share of the stamps with a pose; APE is of "
      "those alone. Drift: mean translation error over pairs 10 m apart. The paper's figures are "
      "of "
      "its own terrain and drive, and not of ours: only the order of the methods compares."};
  return table;
}

DocumentTable CostTable(const ReproducePlan& plan, const std::vector<SceneResults>& results,
                        const Scene& scene) {
  DocumentTable table;
  table.caption = scene.name + ": what it costs";
  table.columns = {"method", "processor s / s", "real-time factor", "memory, MB", "J / m"};
  bool has_joules = false;
  for (size_t m = 0; m < plan.tracks.size(); ++m) {
    const MethodCells cells = CellsOf(results, scene, m);
    if (cells.finished.empty()) continue;
    std::vector<double> load;
    std::vector<double> factors;
    std::vector<double> memory;
    std::vector<double> joules;
    for (const TrackCell* cell : cells.finished) {
      if (cell->recording_seconds > 0.0) {
        load.push_back(cell->cpu_seconds / cell->recording_seconds);
        factors.push_back(cell->real_time_factor);
        memory.push_back(cell->memory_mb);
      }
      if (cell->joules && cell->length > 0.0) joules.push_back(*cell->joules / cell->length);
    }
    has_joules = has_joules || !joules.empty();
    table.rows.push_back({{plan.tracks[m].label},
                          {Spread("%.2f", load)},
                          {Spread("%.1f", factors)},
                          {Spread("%.0f", memory)},
                          {Spread("%.0f", joules)}});
  }
  table.notes = {"Processor seconds a second of the recording, start-up and report left out."};
  table.notes.emplace_back(
      has_joules ? "Joules: of the whole processor package while the command ran (RAPL)."
                 : "Joules are missing: this machine shows no RAPL counters.");
  return table;
}

DocumentTable GainTable(const ReproducePlan& plan, const std::vector<SceneResults>& results) {
  struct Comparison {
    const char* title;
    const char* base;
    const char* better;
    bool is_of_the_paper;
  };
  constexpr Comparison kComparisons[] = {
      {"the paper's method over LVI-SAM", "lvi_sam", "paper", true},
      {"ORB-SLAM2, ghost over ORB", "orb_slam2", "orb_slam2_ghost", false}};
  DocumentTable table;
  table.caption = "Gain of learned features (mean APE)";
  table.columns = {"", "paper: m", "paper: %", "ours: m", "ours: %"};
  for (const Comparison& comparison : kComparisons) {
    const size_t base = MethodIndex(plan, comparison.base);
    const size_t better = MethodIndex(plan, comparison.better);
    if (base == plan.tracks.size() || better == plan.tracks.size()) continue;
    for (const Scene& scene : plan.scenes) {
      std::vector<DocumentCell> row = {
          {scene.name + ": " + comparison.title}, {"–"}, {"–"}, {"–"}, {"–"}};
      if (comparison.is_of_the_paper && scene.IsOfThePaper()) {
        row[1].text = scene.IsMoon() ? "0.723" : "0.054";
        row[2].text = scene.IsMoon() ? "20" : "7";
      }
      const auto mean = [](const TrackCell& cell) { return cell.ape_mean; };
      const std::vector<double> before = CellsOf(results, scene, base).Values(mean);
      const std::vector<double> after = CellsOf(results, scene, better).Values(mean);
      if (!before.empty() && !after.empty()) {
        const double gain = Median(before) - Median(after);
        row[3].text = Text("%.3f", gain);
        row[4].text = Text("%.0f", 100.0 * gain / Median(before));
      }
      table.rows.push_back(row);
    }
  }
  return table;
}

DocumentTable FailureTable(const ReproducePlan& plan, const std::vector<SceneResults>& results) {
  DocumentTable table;
  table.caption = "Cells without a result";
  table.columns = {"cell", "scenario", "seed", "reason"};
  for (const SceneResults& result : results) {
    const std::string seed = std::to_string(result.seed);
    for (size_t m = 0; m < plan.tracks.size(); ++m) {
      const std::string& failure = result.tracks[m].failure;
      if (failure.empty()) continue;
      table.rows.push_back(
          {{plan.tracks[m].label}, {result.scene.scenario}, {seed}, {failure, false, true}});
    }
    for (size_t m = 0; m < plan.matches.size(); ++m) {
      const auto failed = std::find_if(result.matches[m].begin(), result.matches[m].end(),
                                       [](const MatchCell& cell) { return !cell.failure.empty(); });
      if (failed == result.matches[m].end()) continue;
      table.rows.push_back({{plan.matches[m].label},
                            {result.scene.scenario + ", pairs"},
                            {seed},
                            {failed->failure, false, true}});
    }
  }
  return table;
}

std::string CellsCsv(const ReproducePlan& plan, const std::vector<SceneResults>& results) {
  std::string text =
      "scenario,seed,method,ape_rmse_m,ape_mean_m,length_m,coverage,drift_percent,recording_"
      "seconds,"
      "cpu_seconds,real_time_factor,peak_rss_mb,joules,resets,version,failure\n";
  for (const SceneResults& result : results) {
    for (size_t m = 0; m < plan.tracks.size(); ++m) {
      const TrackCell& cell = result.tracks[m];
      text += result.scene.scenario + Concatenate(",", result.seed, ",") + plan.tracks[m].key;
      if (!cell.failure.empty()) {
        text += ",,,,,,,,,,,,," + QuoteCsv(cell.failure) + "\n";
        continue;
      }
      for (const double value : {cell.ape_rmse, cell.ape_mean, cell.length, cell.coverage}) {
        text += Text(",%.6g", value);
      }
      text += cell.drift_percent ? Text(",%.6g", *cell.drift_percent) : ",";
      for (const double value :
           {cell.recording_seconds, cell.cpu_seconds, cell.real_time_factor, cell.memory_mb}) {
        text += Text(",%.6g", value);
      }
      text += (cell.joules ? Text(",%.6g", *cell.joules) : ",") + Concatenate(",", cell.resets) +
              "," + QuoteCsv(cell.version) + ",\n";
    }
  }
  return text;
}

}  // namespace regolith

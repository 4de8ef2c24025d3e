// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/reproduce.h"

#include <filesystem>
#include <set>

#include "regolith/apps/machine_info.h"
#include "regolith/apps/output_folder.h"
#include "regolith/apps/reproduce_cells.h"
#include "regolith/apps/reproduce_document.h"
#include "regolith/apps/reproduce_figures.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/join.h"
#include "regolith/core/log.h"
#include "regolith/core/stop.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

constexpr int kInterrupted = 130;

/// A new folder, or one that holds an unfinished reproduction of the same plan.
void PrepareFolder(const std::string& out, const std::string& plan) {
  const std::string file = out + "/plan.yaml";
  if (!std::filesystem::exists(file)) {
    PrepareOutputFolder(out, false);
    WriteFile(file, plan);
    return;
  }
  if (ReadFile(file) == plan) return;
  throw InputError(file,
                   "is of another reproduction (scale, quality, duration or pairs differ); "
                   "expected the same settings, or another folder for --out");
}

std::string Command(const ReproduceArguments& arguments) {
  std::string command = "regolith reproduce --scale " + arguments.scale;
  const auto add = [&](const char* option, const std::string& value) {
    command += std::string(" ") + option + " " + value;
  };
  if (arguments.seeds) add("--seeds", std::to_string(*arguments.seeds));
  if (arguments.duration) add("--duration", Concatenate(*arguments.duration));
  if (arguments.pairs) add("--pairs", std::to_string(*arguments.pairs));
  const auto add_list = [&](const char* option, const std::vector<std::string>& values) {
    if (!values.empty()) add(option, Join(values, ","));
  };
  add_list("--scenarios", arguments.scenarios);
  add_list("--methods", arguments.methods);
  if (arguments.quality != "full") add("--quality", arguments.quality);
  return command + " --threads " + std::to_string(arguments.threads) + " --out " + arguments.out;
}

std::vector<ReportItem> Header(const ReproduceArguments& arguments,
                               const std::vector<SceneResults>& results) {
  std::vector<ReportItem> header = MachineItems();
  header.push_back({"command", Command(arguments)});
  std::set<std::string> versions;
  for (const SceneResults& result : results) {
    for (const TrackCell& cell : result.tracks) {
      if (cell.failure.empty() && !cell.version.empty()) versions.insert(cell.version);
    }
  }
  if (versions.size() > 1) header.push_back({"cells are of several versions", Join(versions)});
  if (StopRequested()) header.push_back({"state", "interrupted; the same command goes on"});
  return header;
}

DocumentSection MatchSection(const ReproducePlan& plan, const std::vector<SceneResults>& results) {
  DocumentSection section;
  section.title = "Table 1: features";
  section.paragraphs = {
      "Found: matches that outlier rejection keeps; correct: of these within 3 pixels of the true "
      "place; medians over the pairs, the rate over all matches of known truth. Seconds: from two "
      "images to matches, median. The paper's figures are of one pair of its own a planet."};
  for (const bool same_sun : {true, false}) {
    for (const Scene& scene : plan.scenes) {
      DocumentTable table = MatchTable(plan, results, scene, same_sun);
      if (!table.rows.empty()) section.tables.push_back(std::move(table));
    }
  }
  return section;
}

DocumentSection TrackSection(const ReproducePlan& plan, const std::vector<SceneResults>& results) {
  DocumentSection section;
  section.title = "Table 2: trajectories";
  for (const Scene& scene : plan.scenes) {
    section.tables.push_back(ErrorTable(plan, results, scene));
  }
  const DocumentTable gain = GainTable(plan, results);
  if (!gain.rows.empty()) section.tables.push_back(gain);
  for (const Scene& scene : plan.scenes) {
    section.tables.push_back(CostTable(plan, results, scene));
  }
  return section;
}

void WriteResults(const ReproduceArguments& arguments, const CellMaker& maker,
                  const std::vector<SceneResults>& results) {
  const ReproducePlan& plan = maker.plan();
  DocumentPage page;
  page.title = "The paper's tables and figures, reproduced";
  page.folder = arguments.out;
  page.header = Header(arguments, results);
  if (plan.pairs > 0) page.sections.push_back(MatchSection(plan, results));
  page.sections.push_back(TrackSection(plan, results));
  for (DocumentSection& section : ReproducedFigures(maker, results)) {
    page.sections.push_back(std::move(section));
  }
  const DocumentTable failures = FailureTable(plan, results);
  if (!failures.rows.empty()) {
    page.sections.push_back({"What failed", {}, {failures}, {}, 1});
  }
  WriteFile(arguments.out + "/report.html", RenderHtml(page));
  WriteFile(arguments.out + "/tables.md", RenderMarkdown(page));
  WriteFile(arguments.out + "/cells.csv", CellsCsv(plan, results));
}

}  // namespace

int Reproduce(const ReproduceArguments& arguments) {
  CellMaker maker(arguments, MakePlan(arguments));
  PrepareFolder(arguments.out, PlanText(maker.plan()));
  std::vector<SceneResults> results;
  for (const uint64_t seed : maker.plan().seeds) {
    for (const Scene& scene : maker.plan().scenes) {
      SceneResults result{scene, seed, maker.MakeTracks(scene, seed), {}};
      result.matches = maker.MakeMatches(scene, seed);
      results.push_back(std::move(result));
      // After each recording, so that there is something to look at while the rest is made.
      WriteResults(arguments, maker, results);
    }
  }
  const size_t failed = FailureTable(maker.plan(), results).rows.size();
  if (StopRequested()) {
    LogWarning("interrupted: the same command goes on where it ended");
    return kInterrupted;
  }
  if (!arguments.quiet) {
    LogInfo(
        "tables and figures are in " + arguments.out + "/report.html and tables.md" +
        (failed > 0 ? "; " + std::to_string(failed) + " cells have no result and say why" : ""));
  }
  return 0;
}

}  // namespace regolith

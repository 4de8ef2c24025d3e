// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/evaluate.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "regolith/apps/metrics_json.h"
#include "regolith/apps/output_folder.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/tum.h"
#include "regolith/report/figures.h"

namespace regolith {
namespace {

EvaluationOptions Options(const EvaluateArguments& arguments) {
  EvaluationOptions options;
  options.max_difference = arguments.max_difference;
  if (!(arguments.max_difference >= 0.0)) {
    throw InputError("--max-difference",
                     Concatenate("is ", arguments.max_difference, "; expected seconds, 0 or more"));
  }
  if (arguments.align == "se3") {
    options.alignment = AlignmentMode::kSe3;
  } else if (arguments.align == "sim3") {
    options.alignment = AlignmentMode::kSim3;
  } else if (arguments.align == "none") {
    options.alignment = AlignmentMode::kNone;
  } else {
    throw InputError("--align", "is '" + arguments.align + "'; expected se3, sim3 or none");
  }
  return options;
}

/// A short name for each file: its stem, its folder and stem where stems repeat, or all of it.
std::vector<std::string> ShortNames(const std::vector<std::string>& files) {
  namespace fs = std::filesystem;
  const auto are_unique = [](std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return std::adjacent_find(names.begin(), names.end()) == names.end();
  };
  std::vector<std::string> stems;
  std::vector<std::string> with_folders;
  for (const std::string& file : files) {
    const fs::path path = fs::path(file).lexically_normal();
    stems.push_back(path.stem());
    with_folders.push_back(path.parent_path().filename() / path.stem());
  }
  if (are_unique(stems)) return stems;
  if (are_unique(with_folders)) return with_folders;
  if (!are_unique(files)) throw InputError("--estimate", "names a file twice; name each one once");
  return files;
}

std::vector<NamedEvaluation> EvaluateAll(const EvaluateArguments& arguments) {
  const EvaluationOptions options = Options(arguments);
  if (arguments.estimates.empty()) throw InputError("--estimate", "is missing; expected TUM files");
  const std::vector<std::string> names = ShortNames(arguments.estimates);
  const std::vector<StampedPose> reference = ReadTum(arguments.reference);
  std::vector<NamedEvaluation> evaluations;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::vector<StampedPose> estimate = ReadTum(arguments.estimates[i]);
    evaluations.push_back(
        {names[i], EvaluateTrajectory({arguments.reference, reference},
                                      {arguments.estimates[i], estimate}, options)});
  }
  return evaluations;
}

void DrawFigures(const std::string& folder, const std::vector<NamedEvaluation>& evaluations) {
  // Estimates may match different stretches of the reference; the longest shows most of it.
  const auto is_shorter = [](const NamedEvaluation& first, const NamedEvaluation& second) {
    return first.evaluation.length_m < second.evaluation.length_m;
  };
  const Evaluation& longest =
      std::max_element(evaluations.begin(), evaluations.end(), is_shorter)->evaluation;
  std::vector<FigureTrajectory> trajectories = {{"reference", longest.reference}};
  std::vector<FigureSeries> errors;
  TimeNs start = longest.reference.front().time;
  for (const NamedEvaluation& named : evaluations) {
    start = std::min(start, named.evaluation.estimate.front().time);
  }
  for (const NamedEvaluation& named : evaluations) {
    trajectories.push_back({named.name, named.evaluation.estimate});
    FigureSeries series{named.name, {}, named.evaluation.ape_m};
    for (const StampedPose& pose : named.evaluation.estimate) {
      series.seconds.push_back(SecondsBetween(start, pose.time));
    }
    errors.push_back(std::move(series));
  }
  DrawTrajectories(folder, "Trajectories from above", trajectories);
  DrawSeries(folder, "ape", "Absolute pose error", "APE, m", errors);
}

}  // namespace

int Evaluate(const EvaluateArguments& arguments) {
  const std::vector<NamedEvaluation> evaluations = EvaluateAll(arguments);
  if (!arguments.out.empty()) {
    PrepareOutputFolder(arguments.out, arguments.overwrite);
    WriteFile(arguments.out + "/metrics.json", MetricsJson(evaluations));
    WriteFile(arguments.out + "/metrics.csv", MetricsCsv(evaluations));
    DrawFigures(arguments.out, evaluations);
    if (!arguments.quiet) LogInfo("metrics and figures are in " + arguments.out);
  }
  if (!arguments.quiet) std::fputs(MetricsTable(evaluations).c_str(), stdout);
  return 0;
}

}  // namespace regolith

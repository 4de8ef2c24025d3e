// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/evaluate.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "regolith/apps/metrics_json.h"
#include "regolith/apps/output_folder.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/tum.h"
#include "regolith/report/evaluation_figures.h"

namespace regolith {
namespace {

AlignmentMode ParseAlignment(const std::string& name) {
  for (const AlignmentMode mode : {AlignmentMode::kSe3, AlignmentMode::kSim3, AlignmentMode::kYaw,
                                   AlignmentMode::kOrigin, AlignmentMode::kNone}) {
    if (name == AlignmentName(mode)) return mode;
  }
  throw InputError("--align", "is '" + name + "'; expected se3, sim3, yaw, origin or none");
}

EvaluationOptions Options(const EvaluateArguments& arguments) {
  EvaluationOptions options;
  options.max_difference = arguments.max_difference;
  if (!(arguments.max_difference >= 0.0)) {
    throw InputError("--max-difference",
                     Concatenate("is ", arguments.max_difference, "; expected seconds, 0 or more"));
  }
  options.alignment = ParseAlignment(arguments.align);
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

/// Milliseconds of each frame of the run that an estimate came from: the sums over timing.csv
/// beside it. Empty where there is none, or it is something else.
std::vector<double> FrameTimes(const std::string& estimate) {
  const std::filesystem::path table = std::filesystem::path(estimate).parent_path() / "timing.csv";
  std::ifstream stream(table);
  std::string line;
  std::vector<double> times;
  std::string last;
  if (!std::getline(stream, line) || line != "time_s,stage,milliseconds") return times;
  while (std::getline(stream, line)) {
    const size_t first = line.find(',');
    const size_t second = line.rfind(',');
    if (first == std::string::npos || second == first) return {};
    const std::string stamp = line.substr(0, first);
    if (times.empty() || stamp != last) times.push_back(0.0);
    times.back() += std::strtod(line.c_str() + second + 1, nullptr);
    last = stamp;
  }
  return times;
}

void DrawFigures(const EvaluateArguments& arguments,
                 const std::vector<NamedEvaluation>& evaluations) {
  std::vector<FigureEstimate> estimates;
  for (size_t i = 0; i < evaluations.size(); ++i) {
    estimates.push_back(
        {evaluations[i].name, &evaluations[i].evaluation, FrameTimes(arguments.estimates[i])});
  }
  DrawEvaluation(arguments.out, estimates);
}

}  // namespace

int Evaluate(const EvaluateArguments& arguments) {
  const std::vector<NamedEvaluation> evaluations = EvaluateAll(arguments);
  if (!arguments.out.empty()) {
    PrepareOutputFolder(arguments.out, arguments.overwrite);
    WriteFile(arguments.out + "/metrics.json", MetricsJson(evaluations));
    WriteFile(arguments.out + "/metrics.csv", MetricsCsv(evaluations));
    WriteFile(arguments.out + "/metrics.tex", MetricsLatex(evaluations));
    WriteFile(arguments.out + "/metrics.txt", MetricsTable(evaluations));
    DrawFigures(arguments, evaluations);
    if (!arguments.quiet) LogInfo("metrics and figures are in " + arguments.out);
  }
  if (!arguments.quiet) std::fputs(MetricsTable(evaluations).c_str(), stdout);
  return 0;
}

}  // namespace regolith

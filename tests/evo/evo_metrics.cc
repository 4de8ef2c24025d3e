// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// regolith_evo_metrics REFERENCE ESTIMATE se3|sim3|origin|none MAX_DIFFERENCE
// prints every metric as "name value", for comparison with evo.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "regolith/eval/evaluation.h"
#include "regolith/io/tum.h"

namespace regolith {
namespace {

void Print(const std::string& name, double value) {
  std::printf("%s %.17g\n", name.c_str(), value);
}

void Print(const std::string& name, const ErrorStatistics& statistics) {
  Print(name + ".rmse", statistics.rmse);
  Print(name + ".mean", statistics.mean);
  Print(name + ".median", statistics.median);
  Print(name + ".std", statistics.std);
  Print(name + ".min", statistics.min);
  Print(name + ".max", statistics.max);
  Print(name + ".sse", statistics.sse);
}

void PrintMetrics(char** arguments) {
  const std::vector<StampedPose> reference = ReadTum(arguments[1]);
  const std::vector<StampedPose> estimate = ReadTum(arguments[2]);
  const std::string mode = arguments[3];
  EvaluationOptions options;
  options.alignment = mode == "se3"      ? AlignmentMode::kSe3
                      : mode == "sim3"   ? AlignmentMode::kSim3
                      : mode == "origin" ? AlignmentMode::kOrigin
                                         : AlignmentMode::kNone;
  options.max_difference = std::atof(arguments[4]);
  const Evaluation evaluation =
      EvaluateTrajectory({arguments[1], reference}, {arguments[2], estimate}, options);
  Print("matched", static_cast<double>(evaluation.matched));
  Print("ape", evaluation.ape);
  Print("rpe", evaluation.rpe);
  if (evaluation.rpe_10m) Print("rpe_10m", *evaluation.rpe_10m);
  if (evaluation.drift_percent) Print("drift_percent", *evaluation.drift_percent);
  if (evaluation.rotation_deg_per_m) Print("rotation_deg_per_m", *evaluation.rotation_deg_per_m);
  Print("rotation_deg", evaluation.rotation_deg);
}

}  // namespace
}  // namespace regolith

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: %s REFERENCE ESTIMATE se3|sim3|origin|none MAX_DIFFERENCE\n",
                 argv[0]);
    return 2;
  }
  try {
    regolith::PrintMetrics(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/simulate.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "regolith/apps/background_writer.h"
#include "regolith/apps/image_pairs.h"
#include "regolith/apps/output_folder.h"
#include "regolith/apps/progress.h"
#include "regolith/config/install_paths.h"
#include "regolith/config/rig_config.h"
#include "regolith/config/scenario_config.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/core/stop.h"
#include "regolith/core/thread_pool.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/bag_writer.h"
#include "regolith/io/image_file.h"
#include "regolith/io/raster.h"
#include "regolith/io/tum.h"
#include "regolith/sim/simulator.h"
#include "regolith/terrain/dem_spikes.h"

namespace regolith {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kInterrupted = 130;
constexpr double kDegreesPerRadian = 57.29577951308232;

ScenarioOptions ResolveScenario(const SimulateArguments& arguments) {
  if (arguments.quality != "full" && arguments.quality != "draft") {
    throw InputError("--quality", "\"" + arguments.quality + "\": expected full or draft");
  }
  YamlDocument document = YamlDocument::FromFile(FindConfig("scenarios", arguments.scenario));
  if (!arguments.config.empty()) document.Overlay(YamlDocument::FromFile(arguments.config));
  for (const std::string& assignment : arguments.set) document.Set(assignment);
  ScenarioOptions options = LoadScenario(document);
  if (arguments.duration) options.duration = *arguments.duration;
  if (arguments.seed) options.seed = *arguments.seed;
  if (arguments.quality == "draft") options.MakeDraft();
  options.Check();
  return options;
}

std::unique_ptr<Simulator> MakeSimulator(const SimulateArguments& arguments,
                                         const ScenarioOptions& options, ThreadPool* pool) {
  const std::string wait = Concatenate("planning a drive of ", options.duration,
                                       " s and lighting the ground around it takes some seconds");
  if (arguments.dem.empty()) {
    LogInfo(wait);
    return Simulator::Create(options, nullptr, pool);
  }
  const HeightGrid dem = ReadHeights(arguments.dem);
  const size_t spikes = FindSpikes(dem).size();
  if (spikes > 0) {
    LogWarning(Concatenate(arguments.dem, ": ", spikes,
                           " spikes stay in the ground; regolith terrain --repair takes them out"));
  }
  LogInfo(wait);
  try {
    return Simulator::Create(options, &dem, pool);
  } catch (const InputError& error) {
    throw InputError(arguments.dem, error.what());
  }
}

// The last pose that lies within what was recorded.
size_t TruthCount(Span<const StampedPose> truth, TimeNs last) {
  return static_cast<size_t>(
      std::upper_bound(truth.begin(), truth.end(), last,
                       [](TimeNs time, const StampedPose& pose) { return time < pose.time; }) -
      truth.begin());
}

struct Recorded {
  bool complete = true;
  TimeNs last = 0;
};

// Truth goes in between by its stamps, so the bag is in order of time.
Recorded Record(Simulator& simulator, Span<const StampedPose> truth, BagWriter* bag, bool quiet) {
  Recorded recorded;
  recorded.last = simulator.start_time();
  BackgroundWriter writer(bag);
  Progress progress("simulate", SecondsBetween(simulator.start_time(), simulator.end_time()),
                    quiet);
  size_t next_truth = 0;
  for (auto event = simulator.Next(); event; event = simulator.Next()) {
    if (StopRequested()) {
      recorded.complete = false;
      break;
    }
    recorded.last = EventTime(*event);
    for (; next_truth < truth.size() && truth[next_truth].time <= recorded.last; ++next_truth) {
      writer.PutTruth(truth[next_truth]);
    }
    writer.Put(std::move(*event));
    progress.Update(SecondsBetween(simulator.start_time(), recorded.last));
  }
  writer.Finish();
  progress.Finish();
  return recorded;
}

void WriteSurroundings(const SimulateArguments& arguments, Simulator& simulator,
                       const ScenarioOptions& options) {
  const std::string& out = arguments.out;
  WriteFile(out + "/rig.yaml", WriteRig(simulator.rig()));
  const std::string skipped =
      arguments.quality == "draft"
          ? "# Draft quality: ground meshed at 4 cm at best, shadows not filled by lit ground.\n"
          : "";
  WriteFile(out + "/scenario.yaml", skipped + WriteScenario(options));
  WriteHeights(out + "/terrain.tif", simulator.TerrainAroundPath());
  WritePng(out + "/preview.png", simulator.Preview());
}

// False where it was interrupted.
bool WriteRecording(const SimulateArguments& arguments, Simulator& simulator) {
  const auto start = Clock::now();
  const Trajectory truth = simulator.Truth();
  const auto bag = BagWriter::Create(arguments.out + "/recording.bag", simulator.rig());
  const Recorded recorded = Record(simulator, truth.poses(), bag.get(), arguments.quiet);
  bag->Close(!recorded.complete);
  const auto poses = truth.poses().Subspan(0, TruthCount(truth.poses(), recorded.last));
  WriteTum(arguments.out + "/ground_truth.tum", poses, !recorded.complete);

  const double wall = std::chrono::duration<double>(Clock::now() - start).count();
  const double seconds = SecondsBetween(simulator.start_time(), recorded.last);
  const Trajectory driven(std::vector<StampedPose>(poses.begin(), poses.end()));
  std::printf(
      "simulated %.1f s, %.2f m, slopes up to %.1f degrees, real-time factor %.2f: "
      "%s/recording%s.bag\n",
      seconds, driven.Length(), simulator.steepest_slope() * kDegreesPerRadian, seconds / wall,
      arguments.out.c_str(), recorded.complete ? "" : ".partial");
  if (!recorded.complete) {
    LogWarning("interrupted: the recording so far is in files named *.partial.*");
  }
  return recorded.complete;
}

}  // namespace

int Simulate(const SimulateArguments& arguments) {
  if (arguments.pairs_only && arguments.pairs == 0) {
    throw InputError("--pairs-only", "writes nothing without --pairs N");
  }
  SetQuiet(arguments.quiet);
  const ScenarioOptions options = ResolveScenario(arguments);
  PrepareOutputFolder(arguments.out, arguments.overwrite);
  ThreadPool threads(arguments.threads);
  const auto simulator = MakeSimulator(arguments, options, &threads);
  if (StopRequested()) return kInterrupted;
  WriteSurroundings(arguments, *simulator, options);

  const bool recorded = arguments.pairs_only || WriteRecording(arguments, *simulator);
  const bool paired =
      arguments.pairs == 0 || (recorded && WritePairs(*simulator, arguments.pairs, arguments.quiet,
                                                      arguments.out + "/pairs"));
  if (arguments.pairs > 0 && paired) {
    std::printf("wrote %d image pairs: %s/pairs/index.csv\n", arguments.pairs,
                arguments.out.c_str());
  }
  return recorded && paired ? 0 : kInterrupted;
}

}  // namespace regolith

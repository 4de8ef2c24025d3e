// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/reproduce_plan.h"

#include <algorithm>
#include <cmath>

#include "regolith/config/install_paths.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/join.h"

namespace regolith {
namespace {

std::vector<TrackMethod> AllTracks() {
  return {{"lego_loam", "LeGO-LOAM", "our implementation after Shan & Englot 2018", "lego_loam", "",
           PaperErrors{18.892, 17.281, 5.274, 4.178}},
          {"orb_slam2", "ORB-SLAM2 (stereo)", "our implementation after Mur-Artal & Tardós 2017",
           "orb_slam2", "", PaperErrors{3.381, 2.953, 2.426, 2.030}},
          {"lvi_sam", "LVI-SAM", "our implementation after Shan et al. 2021", "lvi_sam", "st_lk",
           PaperErrors{3.883, 3.617, 1.003, 0.770}},
          {"paper", "the paper's method",
           "our implementation after Zhang et al. 2024: LVI-SAM with "
           "ghost_paper",
           "lvi_sam", "ghost_paper", PaperErrors{3.164, 2.894, 0.965, 0.716}},
          {"regolith", "regolith", "ours, the default: ghost features and wheels too", "regolith",
           "", std::nullopt},
          {"lio", "lio", "ours, lidar and IMU", "lio", "", std::nullopt},
          {"vio", "vio", "ours, mono camera and IMU", "vio", "", std::nullopt},
          {"wheels", "wheels", "ours, wheels and IMU", "wheels", "", std::nullopt},
          {"orb_slam2_ghost", "ORB-SLAM2 with ghost", "ours: the stereo row with learned features",
           "orb_slam2", "ghost", std::nullopt},
          {"kiss_icp", "KISS-ICP", "the package kiss-icp as it is (Vizzo et al. 2023)", "", "",
           std::nullopt}};
}

std::vector<MatchMethod> AllMatches() {
  return {{"st_lk", "Shi–Tomasi + LK", "st_lk", true, PaperMatches{7, 6, 0.022},
           PaperMatches{14, 8, 0.027}},
          {"superpoint_fixed", "SuperPoint + KNN", "superpoint", false, PaperMatches{4, 4, 0.362},
           PaperMatches{30, 30, 18.978}},
          {"superpoint", "SuperPoint + KNN, adaptive", "superpoint", true, {}, {}},
          {"paper", "the paper's method (ghost_paper, adaptive)", "ghost_paper", true,
           PaperMatches{25, 25, 0.292}, PaperMatches{38, 38, 0.296}},
          {"paper_fixed", "ghost_paper, fixed threshold", "ghost_paper", false, {}, {}},
          {"ghost", "ghost (ours), adaptive", "ghost", true, {}, {}},
          {"ghost_fixed", "ghost (ours), fixed threshold", "ghost", false, {}, {}},
          {"ghost_lk", "ghost + LK", "ghost_lk", true, {}, {}},
          {"orb", "ORB", "orb", true, {}, {}},
          {"xfeat", "XFeat (package)", "", true, {}, {}, "xfeat"},
          {"aliked", "ALIKED-n16 (package)", "", true, {}, {}, "aliked"},
          {"ghost_again", "ghost (ours), second look", "ghost", true, {}, {}, "", true},
          {"orb_again", "ORB, second look", "orb", true, {}, {}, "", true},
          {"xfeat_again", "XFeat (package), second look", "", true, {}, {}, "xfeat", true},
          {"aliked_again", "ALIKED-n16 (package), second look", "", true, {}, {}, "aliked", true}};
}

void CheckRange(const std::string& option, double value, double least, double most) {
  if (std::isfinite(value) && value >= least && value <= most) return;
  throw InputError(option, Concatenate("is ", value, "; expected ", least, " to ", most));
}

void CheckKnown(const std::string& option, const std::string& name,
                const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError(option + " " + name, "is not one of: " + Join(known));
}

/// Scenarios by name; those of `experiments` keep what they are called there.
std::vector<Scene> NamedScenes(const std::vector<std::string>& scenarios,
                               const std::vector<Scene>& experiments) {
  const std::vector<std::string> known = ConfigNames("scenarios");
  std::vector<Scene> scenes;
  for (const std::string& scenario : scenarios) {
    CheckKnown("--scenarios", scenario, known);
    const auto experiment =
        std::find_if(experiments.begin(), experiments.end(),
                     [&](const Scene& one) { return one.scenario == scenario; });
    scenes.push_back(experiment != experiments.end() ? *experiment : Scene{scenario, scenario});
  }
  return scenes;
}

void KeepMethods(const std::vector<std::string>& keys, std::vector<TrackMethod>* methods) {
  std::vector<std::string> known;
  for (const TrackMethod& method : *methods) known.push_back(method.key);
  const auto is_named = [&](const TrackMethod& method) {
    return std::find(keys.begin(), keys.end(), method.key) != keys.end();
  };
  for (const std::string& key : keys) CheckKnown("--methods", key, known);
  methods->erase(std::remove_if(methods->begin(), methods->end(),
                                [&](const TrackMethod& method) { return !is_named(method); }),
                 methods->end());
}

}  // namespace

ReproducePlan MakePlan(const ReproduceArguments& arguments) {
  const bool is_full = arguments.scale == "full";
  if (!is_full && arguments.scale != "short") {
    throw InputError("--scale", "is '" + arguments.scale + "'; expected short or full");
  }
  if (arguments.quality != "full" && arguments.quality != "draft") {
    throw InputError("--quality", "is '" + arguments.quality + "'; expected full or draft");
  }
  ReproducePlan plan;
  plan.scale = arguments.scale;
  plan.scenes = is_full ? std::vector<Scene>{{"Moon", "lunar"}, {"Mars", "mars"}}
                        : std::vector<Scene>{{"Moon", "lunar_short"}, {"Mars", "mars_short"}};
  if (!arguments.scenarios.empty()) plan.scenes = NamedScenes(arguments.scenarios, plan.scenes);
  const int seeds = arguments.seeds.value_or(is_full ? 3 : 1);
  CheckRange("--seeds", seeds, 1, 1000);
  for (int seed = 1; seed <= seeds; ++seed) plan.seeds.push_back(static_cast<uint64_t>(seed));
  plan.tracks = AllTracks();
  if (!arguments.methods.empty()) KeepMethods(arguments.methods, &plan.tracks);
  plan.matches = AllMatches();
  plan.pairs = arguments.pairs.value_or(is_full ? 40 : 4);
  CheckRange("--pairs", plan.pairs, 0, 100000);
  plan.duration = arguments.duration;
  if (plan.duration) CheckRange("--duration", *plan.duration, 1.0, 1e5);
  plan.quality = arguments.quality;
  // A pipeline may be ten times slower than the rover before it counts as hung; rendering at full
  // quality takes about two seconds a second on two cores.
  const double longest = plan.duration.value_or(is_full ? 700.0 : 40.0);
  plan.run_timeout = 60.0 + 10.0 * longest;
  plan.simulate_timeout = 300.0 + 20.0 * longest;
  return plan;
}

std::string PlanText(const ReproducePlan& plan) {
  std::string text = "scale: " + plan.scale + "\nquality: " + plan.quality + "\nduration: " +
                     (plan.duration ? Concatenate(*plan.duration) : "of the scenario") +
                     Concatenate("\npairs: ", plan.pairs, "\n");
  return text;
}

}  // namespace regolith

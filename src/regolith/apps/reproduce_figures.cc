// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/reproduce_figures.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "regolith/core/log.h"
#include "regolith/eval/evaluation.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/image_file.h"
#include "regolith/io/tum.h"
#include "regolith/report/evaluation_figures.h"
#include "regolith/report/match_picture.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;

/// The pair that pictures show: the first one under the same sun.
std::string ShownPair(const fs::path& folder) {
  std::ifstream stream(folder / "pairs" / "index.csv");
  std::string line;
  std::string first;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    const std::string id = line.substr(0, line.find(','));
    if (first.empty()) first = id;
    if (!line.empty() && line.back() == '1') return id;
  }
  return first;
}

/// x and y of the rows of keypoints_1.csv.
std::vector<Eigen::Vector2f> ReadKeypoints(const fs::path& file) {
  std::vector<Eigen::Vector2f> pixels;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    Eigen::Vector2f pixel;
    if (std::sscanf(line.c_str(), "%f,%f", &pixel.x(), &pixel.y()) == 2) pixels.push_back(pixel);
  }
  return pixels;
}

/// Both images of a pair with dots for keypoints, where there are any.
void DrawPair(const fs::path& pair, const std::vector<Eigen::Vector2f>& first_points,
              const std::vector<Eigen::Vector2f>& second_points, const std::string& caption,
              const fs::path& file) {
  const Image first = ReadImage(pair.string() + "_1.png");
  const Image second = ReadImage(pair.string() + "_2.png");
  const std::vector<uint8_t> bytes =
      DrawMatches({first.width, first.height, first.data, first_points},
                  {second.width, second.height, second.data, second_points}, {}, {caption});
  WriteFile(file.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// "Figure 8: ", where the paper has that figure.
std::string Numbered(const Scene& scene, const char* moon, const char* mars) {
  if (!scene.IsOfThePaper()) return "";
  return std::string("Figure ") + (scene.IsMoon() ? moon : mars) + ": ";
}

/// Figures 1, 2, 8 to 11 of one scene; `sections` holds the three sections that they belong to.
void AddMatchFigures(const CellMaker& maker, const SceneResults& result,
                     std::vector<DocumentSection>* sections) {
  const fs::path folder = maker.MatchFolder(result.scene, result.seed);
  const std::string id = ShownPair(folder);
  if (id.empty()) return;
  const fs::path out = maker.out();
  const std::string& scene = result.scene.name;
  const fs::path pair = folder / "pairs" / id;
  fs::create_directories(out / "figures");
  const std::string pair_file = "figures/pair_" + scene + ".png";
  DrawPair(pair, {}, {}, scene, out / pair_file);
  (*sections)[1].figures.push_back(
      {pair_file, Numbered(result.scene, "8", "9") + "image pair, " + scene});
  for (const MatchMethod& method : maker.plan().matches) {
    const fs::path made = folder / method.key / id;
    if (!fs::exists(made / "match.png")) continue;
    const bool is_classic = method.key == "st_lk" || method.key == "orb";
    if (is_classic) {
      const std::string file = "figures/keypoints_" + scene + "_" + method.key + ".png";
      DrawPair(pair, ReadKeypoints(made / "keypoints_1.csv"),
               ReadKeypoints(made / "keypoints_2.csv"), method.features, out / file);
      (*sections)[0].figures.push_back(
          {file, "Figure 1: points found, " + method.label + ", " + scene});
    }
    const std::string file = "figures/matches_" + scene + "_" + method.key + ".png";
    fs::copy_file(made / "match.png", out / file, fs::copy_options::overwrite_existing);
    if (method.key == "orb") {
      (*sections)[0].figures.push_back(
          {file, "Figure 2: matches and errors (red), " + method.label + ", " + scene});
    } else {
      (*sections)[2].figures.push_back(
          {file, Numbered(result.scene, "10", "11") + method.label + ", " + scene});
    }
  }
}

/// Figures 12 and 13 of one scene.
DocumentSection TrackFigures(const CellMaker& maker, const SceneResults& result) {
  DocumentSection section;
  const Scene& scene = result.scene;
  section.title = (scene.IsMoon()         ? "Figures 12 and 13 (b): "
                   : scene.IsOfThePaper() ? "Figures 12 and 13 (a): "
                                          : "Trajectories: ") +
                  scene.name;
  const fs::path folder = maker.SceneFolder(result.scene, result.seed);
  const fs::path truth_file = folder / "ground_truth.tum";
  if (!fs::exists(truth_file)) return section;
  const std::vector<StampedPose> truth = ReadTum(truth_file.string());
  std::vector<Evaluation> evaluations;
  std::vector<std::string> names;
  for (size_t m = 0; m < result.tracks.size(); ++m) {
    if (!result.tracks[m].failure.empty()) continue;
    const std::string file = result.tracks[m].folder + "/trajectory.tum";
    try {
      evaluations.push_back(
          EvaluateTrajectory({truth_file.string(), truth}, {file, ReadTum(file)}, {}));
      names.push_back(maker.plan().tracks[m].label);
    } catch (const std::exception& error) {
      LogWarning(std::string("not drawn: ") + error.what());
    }
  }
  if (evaluations.empty()) return section;
  std::vector<FigureEstimate> estimates;
  for (size_t i = 0; i < names.size(); ++i) estimates.push_back({names[i], &evaluations[i], {}});
  const std::string place = "figures/" + scene.name;
  fs::create_directories(fs::path(maker.out()) / place);
  DrawEvaluation(maker.out() + "/" + place, estimates);
  section.figures = {
      {place + "/trajectory.png", Numbered(scene, "12 (b)", "12 (a)") + "trajectories from above"},
      {place + "/ape.png", Numbered(scene, "13 (b)", "13 (a)") + "error over time"},
      {place + "/ape_box.png", "error, as box plots"},
      {place + "/track_error.png", "tracks, coloured by their error"}};
  return section;
}

}  // namespace

std::vector<DocumentSection> ReproducedFigures(const CellMaker& maker,
                                               const std::vector<SceneResults>& results) {
  std::vector<DocumentSection> sections(3);
  sections[0].title = "Figures 1 and 2: what makes it hard";
  sections[1].title = "Figures 8 and 9: the image pairs";
  sections[2].title = "Figures 10 and 11: matches";
  sections[2].paragraphs = {
      "Green and blue: kept and correct; red: kept and wrong; amber: kept, truth unknown; grey: "
      "rejected. The paper found 7, 4 and 25 matches on its lunar pair (Shi–Tomasi + LK, "
      "SuperPoint, "
      "its own method) and 14, 30 and 38 on its Martian one."};
  const uint64_t seed = maker.plan().seeds.front();
  for (const SceneResults& result : results) {
    if (result.seed == seed) AddMatchFigures(maker, result, &sections);
  }
  for (const SceneResults& result : results) {
    if (result.seed == seed) sections.push_back(TrackFigures(maker, result));
  }
  sections.erase(std::remove_if(sections.begin(), sections.end(),
                                [](const DocumentSection& one) { return one.figures.empty(); }),
                 sections.end());
  return sections;
}

}  // namespace regolith

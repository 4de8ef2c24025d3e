// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/match_outputs.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "regolith/apps/run_report.h"
#include "regolith/config/features_config.h"
#include "regolith/core/check.h"
#include "regolith/core/version.h"
#include "regolith/io/atomic_file.h"
#include "regolith/report/match_picture.h"

namespace regolith {
namespace {

using Json = nlohmann::ordered_json;

double Median(const std::vector<double>& values) { return Quantile(values, 0.5); }

std::string Fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string KeypointTable(const FeatureSet& features) {
  std::string text = "x,y,score\n";
  char line[96];
  for (size_t i = 0; i < features.size(); ++i) {
    const Eigen::Vector2f& pixel = features.pixels[i];
    std::snprintf(line, sizeof line, "%.3f,%.3f,%.6g\n", pixel.x(), pixel.y(), features.scores[i]);
    text += line;
  }
  return text;
}

struct PixelPair {
  Eigen::Vector2f first;
  Eigen::Vector2f second;
};

PixelPair PixelsOf(const PairMatches& pair, size_t match) {
  return {pair.first.pixels[static_cast<size_t>(pair.matches[match].first)],
          pair.second.pixels[static_cast<size_t>(pair.matches[match].second)]};
}

std::string MatchesTable(const PairMatches& pair) {
  std::string text = "x1,y1,x2,y2,score,inlier\n";
  char line[160];
  for (size_t i = 0; i < pair.matches.size(); ++i) {
    const auto [first, second] = PixelsOf(pair, i);
    std::snprintf(line, sizeof line, "%.3f,%.3f,%.3f,%.3f,%.6g,%d\n", first.x(), first.y(),
                  second.x(), second.y(), pair.matches[i].score, pair.inliers[i] != 0 ? 1 : 0);
    text += line;
  }
  return text;
}

int CountInliers(const PairMatches& pair) {
  return static_cast<int>(
      std::count_if(pair.inliers.begin(), pair.inliers.end(), [](uint8_t kept) { return kept; }));
}

MatchStyle StyleOf(const MatchRecord& record, size_t match) {
  if (record.pair.inliers[match] == 0) return MatchStyle::kRejected;
  if (!record.truth) return MatchStyle::kKept;
  switch (record.truth->score.verdicts[match]) {
    case MatchVerdict::kCorrect:
      return MatchStyle::kCorrect;
    case MatchVerdict::kWrong:
      return MatchStyle::kWrong;
    case MatchVerdict::kUnknown:
      break;
  }
  return MatchStyle::kUnknown;
}

std::string Percent(std::optional<double> share) {
  return share ? Fixed(100.0 * *share, 1) + " %" : "none known";
}

std::string Counts(const MatchCounts& counts) {
  return Concatenate(counts.correct, " of ", counts.known, " (", Percent(counts.Precision()), ")");
}

/// Fits below one VGA image, which a line of the caption does up to some ninety letters.
std::vector<std::string> Caption(const MatchRecord& record) {
  const PairMatches& pair = record.pair;
  std::vector<std::string> caption = {
      Concatenate(record.options.frontend, ": ", pair.first.size(), " and ", pair.second.size(),
                  " keypoints, ", pair.matches.size(), " matches found, ", CountInliers(pair),
                  " kept, ", Fixed(Median(record.times.total), 1), " ms")};
  if (record.truth) {
    caption.push_back(Concatenate("correct within ", record.truth->tolerance,
                                  " pixels: ", Counts(record.truth->score.all),
                                  "; of those kept: ", Counts(record.truth->score.inliers)));
  }
  return caption;
}

std::vector<uint8_t> Picture(const MatchRecord& record) {
  const auto panel = [](const Image& image, const FeatureSet& features) {
    return MatchPanel{image.width, image.height, image.data, features.pixels};
  };
  std::vector<MatchLine> lines;
  for (size_t i = 0; i < record.pair.matches.size(); ++i) {
    const auto [first, second] = PixelsOf(record.pair, i);
    lines.push_back({first, second, StyleOf(record, i)});
  }
  return DrawMatches(panel(record.first.image, record.pair.first),
                     panel(record.second.image, record.pair.second), lines, Caption(record));
}

Json ImageJson(const MatchImage& image, const FeatureSet& features,
               const DetectionStatus& detection) {
  Json json = {{"file", image.path},
               {"width", image.image.width},
               {"height", image.image.height},
               {"keypoints", features.size()}};
  // LK looks for no keypoints in the second image.
  if (detection.cells > 0) {
    json["detection"] = {{"cells", detection.cells},
                         {"cells_filled", detection.cells_filled},
                         {"rounds", detection.rounds},
                         {"threshold_min", detection.threshold_min},
                         {"threshold_median", detection.threshold_median},
                         {"threshold_max", detection.threshold_max}};
  }
  return json;
}

Json OrNull(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

void AddTruth(const MatchTruth& truth, Json* summary) {
  const MatchScore& score = truth.score;
  (*summary)["truth"] = truth.kind;
  (*summary)["tolerance_px"] = truth.tolerance;
  (*summary)["known_matches"] = score.all.known;
  (*summary)["correct_matches"] = score.all.correct;
  (*summary)["precision"] = OrNull(score.all.Precision());
  (*summary)["known_inliers"] = score.inliers.known;
  (*summary)["correct_inliers"] = score.inliers.correct;
  (*summary)["precision_inliers"] = OrNull(score.inliers.Precision());
  (*summary)["repeatability_1px"] = OrNull(truth.repeatability_1px);
  (*summary)["repeatability_3px"] = OrNull(truth.repeatability_3px);
}

Json StagesJson(const MatchTimes& times) {
  std::vector<FrameReport> reports;
  for (const std::vector<StageTime>& stages : times.stages) {
    reports.emplace_back().stages = stages;
  }
  Json json = Json::object();
  for (const StageSummary& stage : SummariseStages(reports)) {
    if (stage.name == "total") continue;  // of the stages; total_ms is measured from outside
    json[stage.name] = {{"median_ms", stage.median_ms}, {"p99_ms", stage.p99_ms}};
  }
  return json;
}

Json Summary(const MatchRecord& record) {
  const PairMatches& pair = record.pair;
  Json summary;
  summary["complete"] = true;
  summary["version"] = ProgramVersion();
  summary["features"] = record.options.frontend;
  if (record.model) {
    summary["model"] = {{"name", record.model->name}, {"sha256", record.model->sha256}};
    summary["network_precision"] = record.precision;
    summary["threads"] = record.options.network.threads;
  }
  summary["max_keypoints"] = record.options.max_keypoints;
  summary["images"] = {ImageJson(record.first, pair.first, pair.first_status),
                       ImageJson(record.second, pair.second, pair.second_status)};
  summary["matches"] = pair.matches.size();
  summary["inliers"] = CountInliers(pair);
  summary["rejection_model"] = pair.rejection_model;
  summary["looked_again"] = pair.looked_again;
  if (record.truth) AddTruth(*record.truth, &summary);
  summary["repetitions"] = record.times.total.size();
  summary["total_ms"] = Median(record.times.total);
  summary["frame_ms"] = Median(record.times.frame);
  summary["stages"] = StagesJson(record.times);
  return summary;
}

}  // namespace

void WriteMatchOutputs(const std::string& folder, const MatchRecord& record) {
  WriteFile(folder + "/keypoints_1.csv", KeypointTable(record.pair.first));
  WriteFile(folder + "/keypoints_2.csv", KeypointTable(record.pair.second));
  WriteFile(folder + "/matches.csv", MatchesTable(record.pair));
  const std::vector<uint8_t> picture = Picture(record);
  WriteFile(folder + "/match.png", {reinterpret_cast<const char*>(picture.data()), picture.size()});
  WriteFile(folder + "/config.yaml", WriteFeatures(record.options));
  // Last, so that a summary never stands beside missing files.
  WriteFile(folder + "/summary.json", Summary(record).dump(2) + "\n");
}

std::string MatchTable(const MatchRecord& record) {
  const PairMatches& pair = record.pair;
  std::vector<std::pair<std::string, std::string>> rows = {
      {"features", record.options.frontend},
      {"keypoints", Concatenate(pair.first.size(), " and ", pair.second.size())},
      {"matches", std::to_string(pair.matches.size())},
      {"kept", Concatenate(CountInliers(pair), " (", pair.rejection_model, ")")}};
  if (record.truth) {
    rows.emplace_back("correct", Counts(record.truth->score.all));
    rows.emplace_back("correct kept", Counts(record.truth->score.inliers));
    rows.emplace_back("repeatability", Percent(record.truth->repeatability_1px) + " at 1 px, " +
                                           Percent(record.truth->repeatability_3px) + " at 3 px");
  }
  rows.emplace_back("time", Fixed(Median(record.times.total), 1) + " ms, of it one image " +
                                Fixed(Median(record.times.frame), 1) + " ms");
  std::string table;
  for (const auto& [name, value] : rows) {
    table += name + std::string(16 - name.size(), ' ') + value + "\n";
  }
  return table;
}

}  // namespace regolith

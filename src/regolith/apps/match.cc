// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/match.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "regolith/apps/match_outputs.h"
#include "regolith/apps/output_folder.h"
#include "regolith/apps/progress.h"
#include "regolith/config/feature_setup.h"
#include "regolith/config/features_config.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/stop.h"
#include "regolith/io/homography.h"
#include "regolith/io/image_file.h"
#include "regolith/io/raster.h"

namespace regolith {
namespace {

constexpr int kInterrupted = 130;
/// The first matching warms up caches and the network; its time would say nothing.
constexpr int kRepetitions = 5;
constexpr double kTolerance = 3.0;  // pixels
constexpr int kMaxThreads = 64;

FeatureOptions ResolveFeatures(const MatchArguments& arguments) {
  YamlDocument document = YamlDocument::Empty("--set");
  if (!arguments.config.empty()) document.Overlay(YamlDocument::FromFile(arguments.config));
  for (const std::string& assignment : arguments.set) document.Set(assignment);
  FeatureOptions options = LoadFeatures(document);
  if (arguments.features) options.frontend = *arguments.features;
  if (arguments.max_keypoints) options.max_keypoints = *arguments.max_keypoints;
  if (arguments.threads) {
    const int threads = *arguments.threads > 0
                            ? *arguments.threads
                            : static_cast<int>(std::thread::hardware_concurrency());
    options.network.threads = std::clamp(threads, 1, kMaxThreads);
  }
  const bool known =
      std::any_of(kFrontends.begin(), kFrontends.end(),
                  [&](const FrontendName& frontend) { return options.frontend == frontend.name; });
  if (!known) {
    std::string names;
    for (const FrontendName& frontend : kFrontends) {
      names += std::string(names.empty() ? "" : ", ") + frontend.name;
    }
    throw InputError("--features " + options.frontend, "expected one of " + names);
  }
  if (options.max_keypoints < 1 || options.max_keypoints > kMaxKeypoints) {
    throw InputError("--max-keypoints",
                     Concatenate("is ", options.max_keypoints, "; expected 1 to ", kMaxKeypoints));
  }
  return options;
}

struct NamedTruth {
  std::string kind;
  PixelTruth truth;
};

std::optional<NamedTruth> LoadTruth(const MatchArguments& arguments, const Image& first,
                                    const Image& second) {
  const ImageSize first_size{first.width, first.height};
  const ImageSize second_size{second.width, second.height};
  if (!arguments.homography.empty() && !arguments.correspondences.empty()) {
    throw InputError("--homography and --correspondences", "are two truths; give one of them");
  }
  if (!arguments.homography.empty()) {
    return NamedTruth{"homography", PixelTruth::FromHomography(ReadHomography(arguments.homography),
                                                               first_size, second_size)};
  }
  if (arguments.correspondences.empty()) return std::nullopt;
  TwoBands flow = ReadTwoBands(arguments.correspondences);
  if (flow.width != first.width || flow.height != first.height) {
    throw InputError(arguments.correspondences,
                     Concatenate("is of ", flow.width, " x ", flow.height, " pixels; expected ",
                                 first.width, " x ", first.height, ", those of image 1"));
  }
  return NamedTruth{"correspondences",
                    PixelTruth::FromCorrespondences(std::move(flow.first), std::move(flow.second),
                                                    first_size, second_size)};
}

bool AreEqual(const FeatureSet& first, const FeatureSet& second) {
  return first.pixels == second.pixels && first.scores == second.scores &&
         first.descriptors.values == second.descriptors.values &&
         first.descriptors.bits == second.descriptors.bits;
}

bool AreEqual(const PairMatches& first, const PairMatches& second) {
  const auto same = [](const FeatureMatch& one, const FeatureMatch& other) {
    return one.first == other.first && one.second == other.second && one.score == other.score;
  };
  return AreEqual(first.first, second.first) && AreEqual(first.second, second.second) &&
         first.inliers == second.inliers &&
         std::equal(first.matches.begin(), first.matches.end(), second.matches.begin(),
                    second.matches.end(), same);
}

template <typename Work>
double MillisecondsOf(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

/// False where it was interrupted.
bool MatchAndTime(FeatureFrontend* frontend, bool quiet, MatchRecord* record) {
  const Image& first = record->first.image;
  const Image& second = record->second.image;
  Progress progress("match", kRepetitions + 1, quiet, "times");
  record->pair = frontend->MatchPair(first, second);
  for (int i = 0; i < kRepetitions; ++i) {
    if (StopRequested()) return false;
    progress.Update(i + 1);
    PairMatches again;
    record->times.total.push_back(
        MillisecondsOf([&] { again = frontend->MatchPair(first, second); }));
    record->times.stages.push_back(again.stages);
    REGOLITH_CHECK(AreEqual(record->pair, again), record->options.frontend,
                   " gives other matches when asked again");
  }
  progress.Finish();
  return !StopRequested();
}

struct Keypoints {
  FeatureSet first;
  FeatureSet second;
};

/// Both images apart. LK frontends detect in the first alone, so repeatability needs this as well.
Keypoints ExtractAndTime(MatchRecord* record) {
  const auto extractor = FeatureExtractor::Create(record->options, record->model);
  Keypoints keypoints;
  record->precision = extractor->precision();
  const auto extract = [&](const Image& image, FeatureSet* features) {
    extractor->Reset();
    return MillisecondsOf(
        [&] { extractor->Extract(image, nullptr, record->options.max_keypoints, features); });
  };
  for (int i = 0; i <= kRepetitions; ++i) {
    const double first = extract(record->first.image, &keypoints.first);
    const double second = extract(record->second.image, &keypoints.second);
    if (i == 0) continue;
    record->times.frame.push_back(first);
    record->times.frame.push_back(second);
  }
  return keypoints;
}

std::vector<Eigen::Vector2d> InDoubles(const std::vector<Eigen::Vector2f>& pixels) {
  std::vector<Eigen::Vector2d> doubles;
  for (const Eigen::Vector2f& pixel : pixels) doubles.push_back(pixel.cast<double>());
  return doubles;
}

MatchTruth Score(const NamedTruth& named, const PairMatches& pair, const Keypoints& keypoints) {
  std::vector<ScoredMatch> matches;
  for (size_t i = 0; i < pair.matches.size(); ++i) {
    const auto first = static_cast<size_t>(pair.matches[i].first);
    const auto second = static_cast<size_t>(pair.matches[i].second);
    matches.push_back({pair.first.pixels[first].cast<double>(),
                       pair.second.pixels[second].cast<double>(), pair.inliers[i] != 0});
  }
  MatchTruth truth;
  truth.kind = named.kind;
  truth.tolerance = kTolerance;
  truth.score = ScoreMatches(matches, named.truth, kTolerance);
  const std::vector<Eigen::Vector2d> first = InDoubles(keypoints.first.pixels);
  const std::vector<Eigen::Vector2d> second = InDoubles(keypoints.second.pixels);
  truth.repeatability_1px = Repeatability(first, second, named.truth, 1.0);
  truth.repeatability_3px = Repeatability(first, second, named.truth, 3.0);
  return truth;
}

}  // namespace

int Match(const MatchArguments& arguments) {
  MatchRecord record;
  record.options = ResolveFeatures(arguments);
  record.first = {arguments.first, ReadImage(arguments.first)};
  record.second = {arguments.second, ReadImage(arguments.second)};
  const auto truth = LoadTruth(arguments, record.first.image, record.second.image);
  record.model = PrepareModel(&record.options);
  const auto frontend = FeatureFrontend::Create(record.options, nullptr, record.model);
  PrepareOutputFolder(arguments.out, arguments.overwrite);
  if (!MatchAndTime(frontend.get(), arguments.quiet, &record)) return kInterrupted;
  const Keypoints keypoints = ExtractAndTime(&record);
  if (truth) record.truth = Score(*truth, record.pair, keypoints);
  WriteMatchOutputs(arguments.out, record);
  if (!arguments.quiet) std::fputs(MatchTable(record).c_str(), stdout);
  return 0;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "regolith/config/model_config.h"
#include "regolith/features/adaptive_threshold.h"
#include "regolith/features/descriptor_matcher.h"
#include "regolith/features/feature_frontend.h"
#include "regolith/features/network_extractor.h"
#include "regolith/features/score_map.h"

namespace regolith {
namespace {

constexpr int kKeypoints = 500;
constexpr int kFrames = 8;

/// Ground of many scales that moves by (3, 1) pixels a frame: noise of six octaves, bilinear.
Image Ground(int width, int height, int frame) {
  Image image{width, height, std::vector<uint8_t>(static_cast<size_t>(width * height))};
  const auto noise = [](int octave, int column, int row) {
    auto hash = static_cast<uint32_t>(column * 73856093) ^ static_cast<uint32_t>(row * 19349663) ^
                static_cast<uint32_t>(octave * 83492791);
    hash = (hash ^ (hash >> 13U)) * 1274126177U;
    return static_cast<double>((hash ^ (hash >> 16U)) & 0xffffU) / 65535.0 - 0.5;
  };
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      double value = 0.5;
      for (int octave = 1; octave <= 6; ++octave) {
        const double size = static_cast<double>(1 << octave);
        const double x = (column + 3 * frame) / size;
        const double y = (row + frame) / size;
        const int left = static_cast<int>(x);
        const int top = static_cast<int>(y);
        const double u = x - left;
        const double v = y - top;
        value +=
            0.14 *
            ((1 - v) * ((1 - u) * noise(octave, left, top) + u * noise(octave, left + 1, top)) +
             v * ((1 - u) * noise(octave, left, top + 1) + u * noise(octave, left + 1, top + 1)));
      }
      image.data[static_cast<size_t>(row * width + column)] =
          static_cast<uint8_t>(std::clamp(255.0 * value, 0.0, 255.0));
    }
  }
  return image;
}

const std::vector<Image>& Frames(int width, int height) {
  static std::map<std::pair<int, int>, std::vector<Image>> made;
  std::vector<Image>& frames = made[{width, height}];
  for (int i = static_cast<int>(frames.size()); i < kFrames; ++i)
    frames.push_back(Ground(width, height, i));
  return frames;
}

std::optional<ModelManifest> ManifestOf(const std::string& frontend) {
  if (frontend == "orb" || frontend == "st_lk") return std::nullopt;
  const std::string model = frontend == "ghost_lk" ? "ghost" : frontend;
  return LoadModelManifest(std::string(REGOLITH_SOURCE_DIR) + "/models/" + model + ".yaml");
}

/// Image → tracked features, everything included; the counters are the means of the stages, ms.
void Track(benchmark::State& state, const std::string& frontend, const std::string& precision,
           int width, int height, int threads) {
  FeatureOptions options;
  options.frontend = frontend;
  options.max_keypoints = kKeypoints;
  options.network.precision = precision;
  options.network.threads = threads;
  const std::vector<Image>& frames = Frames(width, height);
  std::unique_ptr<FeatureFrontend> tracker;
  try {
    tracker = FeatureFrontend::Create(options, nullptr, ManifestOf(frontend));
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
    return;
  }
  TimeNs time = 0;
  const auto track = [&](size_t index) {
    FrontendInput input;
    input.time = time += 100'000'000;
    input.image = &frames[index % frames.size()];
    return tracker->Track(input);
  };
  track(0);
  track(1);
  std::map<std::string, double> stages;
  size_t count = 0;
  for (auto _ : state) {
    const TrackedFrame frame = track(count++);
    for (const StageTime& stage : frame.stages) stages[stage.name] += stage.milliseconds;
  }
  for (const auto& [name, total] : stages) {
    state.counters[name] = total / static_cast<double>(std::max<size_t>(count, 1));
  }
}

void RegisterFrontends() {
  for (const auto& [width, height] : {std::pair{640, 480}, std::pair{1024, 1024}}) {
    for (const char* frontend :
         {"ghost", "ghost_lk", "ghost_paper", "superpoint", "orb", "st_lk"}) {
      const bool network = ManifestOf(frontend).has_value();
      for (const char* precision : {"f32", "bf16"}) {
        if (!network && std::string(precision) == "bf16") continue;
        for (const int threads : {1, 2}) {
          if (!network && threads == 2) continue;
          const std::string name = std::string("FeatureTrack/") + frontend + "/" +
                                   (network ? precision : "none") + "/" + std::to_string(width) +
                                   "x" + std::to_string(height) +
                                   "/threads:" + std::to_string(threads);
          benchmark::RegisterBenchmark(name.c_str(),
                                       [=](benchmark::State& state) {
                                         Track(state, frontend, precision, width, height, threads);
                                       })
              ->UseRealTime()
              ->Unit(benchmark::kMillisecond);
        }
      }
    }
  }
}

const bool kRegistered = (RegisterFrontends(), true);

/// Random outputs of a network at VGA, with about one strong pixel in every other cell.
struct Outputs {
  std::vector<float> logits;
  std::vector<float> descriptors;
  NetworkOutput view;
};

const Outputs& RandomOutputs() {
  static const Outputs outputs = [] {
    Outputs made;
    made.view.rows = 60;
    made.view.columns = 80;
    made.view.dimension = 128;
    std::mt19937 generator(3);
    std::normal_distribution<float> normal;
    for (int cell = 0; cell < 60 * 80; ++cell) {
      for (int channel = 0; channel < 65; ++channel)
        made.logits.push_back(0.7F * normal(generator));
      made.logits.back() += 7.0F;
      if (cell % 2 == 0) made.logits[made.logits.size() - 1 - generator() % 64 - 1] += 6.0F;
      for (int i = 0; i < made.view.dimension; ++i) made.descriptors.push_back(normal(generator));
    }
    return made;
  }();
  return outputs;
}

/// From a network's output to keypoints and descriptors: scores, suppression, selection, sampling.
void FeatureSelection(benchmark::State& state) {
  NetworkOutput output = RandomOutputs().view;
  output.logits = RandomOutputs().logits.data();
  output.descriptors = RandomOutputs().descriptors.data();
  ScoreMap map;
  NonMaximumSuppression suppression;
  SuppressionOptions options;
  options.floor = static_cast<float>(AdaptiveThresholdOptions().floor);
  AdaptiveThreshold threshold((AdaptiveThresholdOptions()));
  std::vector<Candidate> candidates;
  std::vector<Eigen::Vector2f> pixels;
  Descriptors descriptors;
  for (auto _ : state) {
    MakeScoreMap(output, 640, 480, &map);
    suppression.Run(map, nullptr, options, &candidates);
    state.counters["candidates"] = static_cast<double>(candidates.size());
    threshold.Select(640, 480, kKeypoints, &candidates);
    pixels.clear();
    for (const Candidate& candidate : candidates) pixels.push_back(RefinePixel(map, candidate));
    SampleDescriptors(output, pixels, &descriptors);
    benchmark::DoNotOptimize(descriptors.values.data());
  }
  state.counters["keypoints"] = static_cast<double>(candidates.size());
}
BENCHMARK(FeatureSelection)->Unit(benchmark::kMillisecond);

Descriptors RandomDescriptors(int count, int dimension, unsigned seed) {
  Descriptors descriptors;
  descriptors.type = DescriptorType::kFloat;
  descriptors.dimension = dimension;
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal;
  descriptors.values.resize(static_cast<size_t>(count * dimension));
  for (float& value : descriptors.values) value = normal(generator);
  for (int i = 0; i < count; ++i) {
    Eigen::Map<Eigen::VectorXf>(descriptors.values.data() + i * dimension, dimension).normalize();
  }
  return descriptors;
}

void FeatureKnn(benchmark::State& state) {
  const Descriptors first = RandomDescriptors(kKeypoints, static_cast<int>(state.range(0)), 1);
  const Descriptors second = RandomDescriptors(kKeypoints, static_cast<int>(state.range(0)), 2);
  DescriptorMatcher matcher((DescriptorMatcherOptions()));
  std::vector<FeatureMatch> matches;
  for (auto _ : state) {
    matcher.Match(first, second, &matches);
    benchmark::DoNotOptimize(matches.data());
  }
}
BENCHMARK(FeatureKnn)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regolith

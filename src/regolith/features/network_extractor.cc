// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/network_extractor.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/stopwatch.h"
#include "regolith/features/adaptive_threshold.h"
#include "regolith/features/contrast.h"
#include "regolith/features/corner_weight.h"
#include "regolith/features/feature_network.h"
#include "regolith/features/score_map.h"

namespace regolith {
namespace {

constexpr float kCell = 8.0F;
constexpr float kCentre = 3.5F;  // of a cell, pixels from its first

class NetworkExtractor : public FeatureExtractor {
 public:
  NetworkExtractor(const FeatureOptions& options, const ModelManifest& manifest)
      : options_(options), network_(manifest, options.network), threshold_(options.adaptive) {
    suppression_options_.radius = options.nms_radius;
    suppression_options_.border = options.border;
    suppression_options_.floor = static_cast<float>(options.adaptive.floor);
  }

  void Extract(const Image& image, const Image* mask, int max_keypoints,
               FeatureSet* features) override {
    REGOLITH_CHECK(mask == nullptr || (mask->width == image.width && mask->height == image.height),
                   "mask is ", mask->width, " × ", mask->height, ", image ", image.width, " × ",
                   image.height);
    Stopwatch stopwatch;
    features->pixels.clear();
    features->scores.clear();
    if (image.width <= 0 || image.height <= 0) {
      features->descriptors = Descriptors();
      return;
    }
    output_ = network_.Run(image);
    stopwatch.Lap("network");
    MakeScoreMap(output_, image.width, image.height, &map_);
    AddNeighbours(map_, &sums_);
    corner_weight_.Apply(image, &sums_);
    stopwatch.Lap("scores");
    suppression_.Run(sums_, mask, suppression_options_, &candidates_);
    DropNoise(image);
    stopwatch.Lap("suppression");
    threshold_.Select(image.width, image.height, max_keypoints, &candidates_);
    for (const Candidate& candidate : candidates_) {
      features->pixels.push_back(RefinePixel(map_, candidate));
      features->scores.push_back(candidate.score);
    }
    stopwatch.Lap("selection");
    SampleDescriptors(output_, features->pixels, &features->descriptors);
    stopwatch.Lap("sampling");
    stages_ = stopwatch.stages();
  }

  Descriptors Describe(const std::vector<Eigen::Vector2f>& pixels) const override {
    Descriptors descriptors;
    if (output_.descriptors != nullptr) SampleDescriptors(output_, pixels, &descriptors);
    return descriptors;
  }

  const DetectionStatus& status() const override { return threshold_.status(); }
  const std::vector<StageTime>& stages() const override { return stages_; }
  std::string precision() const override { return network_.precision(); }
  void Reset() override { threshold_.Reset(); }

 private:
  void DropNoise(const Image& image) {
    const double least = options_.adaptive.min_contrast;
    if (least <= 0.0) return;
    const auto noise = [&](const Candidate& one) {
      return LocalContrast(image, one.column, one.row) < least;
    };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), noise),
                      candidates_.end());
  }

  FeatureOptions options_;
  FeatureNetwork network_;
  AdaptiveThreshold threshold_;
  SuppressionOptions suppression_options_;
  NonMaximumSuppression suppression_;
  NetworkOutput output_;
  ScoreMap map_;
  ScoreMap sums_;
  CornerWeight corner_weight_;
  std::vector<Candidate> candidates_;
  std::vector<StageTime> stages_;
};

}  // namespace

void SampleDescriptors(const NetworkOutput& output, const std::vector<Eigen::Vector2f>& pixels,
                       Descriptors* descriptors) {
  descriptors->type = DescriptorType::kFloat;
  descriptors->dimension = output.dimension;
  descriptors->bits.clear();
  const auto dimension = static_cast<Eigen::Index>(output.dimension);
  descriptors->values.resize(pixels.size() * static_cast<size_t>(output.dimension));
  const auto cell = [&](int row, int column) {
    return Eigen::Map<const Eigen::ArrayXf>(
        output.descriptors + (static_cast<Eigen::Index>(row) * output.columns + column) * dimension,
        dimension);
  };
  float* target = descriptors->values.data();
  for (const Eigen::Vector2f& pixel : pixels) {
    const float x =
        std::clamp((pixel.x() - kCentre) / kCell, 0.0F, static_cast<float>(output.columns - 1));
    const float y =
        std::clamp((pixel.y() - kCentre) / kCell, 0.0F, static_cast<float>(output.rows - 1));
    const int left = static_cast<int>(x);
    const int top = static_cast<int>(y);
    const int right = std::min(left + 1, output.columns - 1);
    const int bottom = std::min(top + 1, output.rows - 1);
    const float u = x - static_cast<float>(left);
    const float v = y - static_cast<float>(top);
    Eigen::Map<Eigen::ArrayXf> sampled(target, dimension);
    sampled = (1.0F - v) * ((1.0F - u) * cell(top, left) + u * cell(top, right)) +
              v * ((1.0F - u) * cell(bottom, left) + u * cell(bottom, right));
    sampled /= std::max(std::sqrt(sampled.square().sum()), 1e-12F);
    target += dimension;
  }
}

std::unique_ptr<FeatureExtractor> CreateNetworkExtractor(const FeatureOptions& options,
                                                         const ModelManifest& manifest) {
  return std::make_unique<NetworkExtractor>(options, manifest);
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "regolith/config/model_config.h"
#include "regolith/features/feature_network.h"
#include "regolith/io/npy.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kMaxNetworkBytes = 6'000'000;
constexpr uintmax_t kMaxAllBytes = 12'000'000;

/// The networks that are shipped: as their manifests say, and in agreement with the exporter's
/// PyTorch.
class Models : public testing::TestWithParam<std::string> {
 protected:
  ModelManifest manifest_ =
      LoadModelManifest(std::string(REGOLITH_SOURCE_DIR) + "/models/" + GetParam() + ".yaml");

  struct Comparison {
    double logits = 0.0;      ///< largest difference
    double similarity = 1.0;  ///< smallest inner product of descriptors of a cell
  };

  Comparison Compare(const std::string& precision) {
    NetworkOptions options;
    options.precision = precision;
    options.normalise_contrast = false;
    FeatureNetwork network(manifest_, options);
    const NpyArray input = ReadNpy(manifest_.parity.input);
    const NpyArray logits = ReadNpy(manifest_.parity.logits);
    const NpyArray descriptors = ReadNpy(manifest_.parity.descriptors);
    Image image{static_cast<int>(input.shape[3]), static_cast<int>(input.shape[2]), {}};
    for (const float value : input.values) {
      image.data.push_back(static_cast<uint8_t>(std::lround(255.0 * static_cast<double>(value))));
    }
    const NetworkOutput output = network.Run(image);
    const auto cells = static_cast<size_t>(output.rows * output.columns);
    const auto dimension = static_cast<size_t>(output.dimension);
    EXPECT_EQ(logits.values.size(), cells * 65);
    EXPECT_EQ(descriptors.values.size(), cells * dimension);
    Comparison comparison;
    for (size_t cell = 0; cell < cells; ++cell) {
      for (size_t channel = 0; channel < 65; ++channel) {
        const double difference = static_cast<double>(output.logits[cell * 65 + channel]) -
                                  static_cast<double>(logits.values[channel * cells + cell]);
        comparison.logits = std::max(comparison.logits, std::abs(difference));
      }
      double product = 0.0;
      for (size_t i = 0; i < dimension; ++i) {
        product += static_cast<double>(output.descriptors[cell * dimension + i]) *
                   static_cast<double>(descriptors.values[i * cells + cell]);
      }
      comparison.similarity = std::min(comparison.similarity, product);
    }
    return comparison;
  }
};

TEST_P(Models, SayWhatTheExporterSaid) {
  const Comparison comparison = Compare("f32");
  EXPECT_LT(comparison.logits, 2e-3);
  EXPECT_GT(comparison.similarity, 1.0 - 1e-4);
}

TEST_P(Models, LoseLittleByTheShortFormat) {
  NetworkOptions automatic;
  if (FeatureNetwork(manifest_, automatic).precision() != "bf16") {
    GTEST_SKIP() << "this processor has no bf16";
  }
  const Comparison comparison = Compare("bf16");
  RecordProperty("largest_logit_difference", std::to_string(comparison.logits));
  RecordProperty("smallest_similarity", std::to_string(comparison.similarity));
  EXPECT_GT(comparison.similarity, 0.98);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Models, testing::Values("ghost", "ghost_paper", "superpoint"),
                         [](const auto& parameters) { return parameters.param; });

TEST(ModelFiles, AreSmall) {
  uintmax_t all = 0;
  for (const auto& entry : fs::directory_iterator(std::string(REGOLITH_SOURCE_DIR) + "/models")) {
    if (entry.path().extension() != ".onnx") continue;
    EXPECT_LT(entry.file_size(), kMaxNetworkBytes) << entry.path();
    all += entry.file_size();
  }
  EXPECT_GT(all, 0U);
  EXPECT_LT(all, kMaxAllBytes);
}

}  // namespace
}  // namespace regolith

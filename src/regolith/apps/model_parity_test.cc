// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The shipped networks give what their exporter (PyTorch) says they do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regolith/apps/install_paths.h"
#include "regolith/config/model_config.h"
#include "regolith/features/feature_network.h"
#include "regolith/io/npy.h"

namespace regolith {
namespace {

constexpr int kCell = 8;

/// The exporter's input, 1 × 1 × height × width of grey / 255, as the image that it was.
Image ImageOf(const NpyArray& input) {
  Image image;
  EXPECT_EQ(input.shape.size(), 4U);
  image.height = static_cast<int>(input.shape.at(2));
  image.width = static_cast<int>(input.shape.at(3));
  for (const float value : input.values) {
    const float grey = std::round(value * 255.0F);
    EXPECT_NEAR(grey / 255.0F, value, 1e-6F) << "the exporter's input is no image of 8 bits";
    image.data.push_back(static_cast<uint8_t>(grey));
  }
  return image;
}

/// Largest difference over the largest value. `expected`: 1 × channels × rows × columns; `found`:
/// cells × channels.
double RelativeError(const NpyArray& expected, const float* found, size_t channels) {
  EXPECT_EQ(expected.shape.at(1), channels);
  const size_t cells = expected.values.size() / channels;
  double largest = 0.0;
  double difference = 0.0;
  for (size_t cell = 0; cell < cells; ++cell) {
    for (size_t channel = 0; channel < channels; ++channel) {
      const double value = expected.values[channel * cells + cell];
      largest = std::max(largest, std::abs(value));
      difference = std::max(difference, std::abs(value - found[cell * channels + channel]));
    }
  }
  return difference / largest;
}

TEST(ModelParity, NetworksGiveTheExportersTensors) {
  int checked = 0;
  for (const std::string& name : ModelNames()) {
    SCOPED_TRACE(name);
    const ModelManifest manifest = LoadModelManifest(FindModel(name));
    if (manifest.parity.input.empty()) continue;
    NetworkOptions options;
    options.precision = "f32";
    options.normalise_contrast = false;
    FeatureNetwork network(manifest, options);
    const Image image = ImageOf(ReadNpy(manifest.parity.input));
    const NetworkOutput output = network.Run(image);
    ASSERT_EQ(output.rows, image.height / kCell);
    ASSERT_EQ(output.columns, image.width / kCell);
    EXPECT_LT(RelativeError(ReadNpy(manifest.parity.logits), output.logits, 65), 1e-4);
    EXPECT_LT(RelativeError(ReadNpy(manifest.parity.descriptors), output.descriptors,
                            static_cast<size_t>(output.dimension)),
              1e-4);
    ++checked;
  }
  if (checked == 0) GTEST_SKIP() << "NO MODELS with parity tensors are installed";
}

}  // namespace
}  // namespace regolith

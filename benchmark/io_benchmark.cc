// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>

#include "regolith/core/random.h"
#include "regolith/io/image_file.h"

namespace regolith {
namespace {

/// 640 x 480 of smooth shading with the noise of a sensor (3 grey levels).
void EncodePngOfNoisyFrame(benchmark::State& state) {
  Image image;
  image.width = 640;
  image.height = 480;
  Random random(1);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double grey = 60.0 + 0.15 * column + 0.1 * row + random.Gaussian(0.0, 3.0);
      image.data.push_back(static_cast<uint8_t>(std::clamp(grey, 0.0, 255.0)));
    }
  }
  for (auto _ : state) benchmark::DoNotOptimize(EncodePng(image));
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(image.data.size()));
}
BENCHMARK(EncodePngOfNoisyFrame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regolith

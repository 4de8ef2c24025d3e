// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run_monitor.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

CameraFrame Frame(double seconds, const std::string& camera) {
  CameraFrame frame;
  frame.time = FromSeconds(seconds);
  frame.camera = camera;
  return frame;
}

TEST(RunMonitor, SamplesLoadAndPairsOfConsecutiveImages) {
  RunMonitor monitor("mono", FromSeconds(100.0), FromSeconds(140.0));
  for (int i = 0; i < 400; ++i) {
    monitor.Observe(Frame(100.0 + 0.1 * i, "left"));
    monitor.Observe(Frame(100.0 + 0.1 * i, "mono"));
  }
  const RunSamples samples = monitor.TakeSamples();
  EXPECT_GT(samples.load.size(), 60U);
  EXPECT_LT(samples.load.size(), 90U);
  EXPECT_GT(samples.load.back().memory_mb, 1.0);
  EXPECT_GE(samples.load.back().cpu_seconds, samples.load.front().cpu_seconds);
  ASSERT_EQ(samples.images.size(), 8U);
  EXPECT_NEAR(SecondsBetween(FromSeconds(100.0), samples.images[0].first.time), 2.5, 0.11);
  for (const ImagePair& pair : samples.images) {
    EXPECT_EQ(pair.first.camera, "mono");
    EXPECT_NEAR(SecondsBetween(pair.first.time, pair.second.time), 0.1, 1e-6);
  }
}

TEST(RunMonitor, KeepsNoImagesWithoutACameraOrADuration) {
  for (const auto& [camera, end] : {std::pair{"", 10.0}, std::pair{"mono", 0.0}}) {
    RunMonitor monitor(camera, 0, FromSeconds(end));
    for (int i = 0; i < 100; ++i) monitor.Observe(Frame(0.1 * i, "mono"));
    const RunSamples samples = monitor.TakeSamples();
    EXPECT_TRUE(samples.images.empty());
    EXPECT_FALSE(samples.load.empty());
  }
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/keyframe_sight.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

CameraFrame ImageAt(double seconds, const std::string& camera = "mono") {
  return {FromSeconds(seconds), camera, {1, 1, {0}}};
}

std::shared_ptr<const ScanEstimate> EstimateAt(double seconds, double x, bool has_scan = true) {
  auto estimate = std::make_shared<ScanEstimate>();
  estimate->stamp = FromSeconds(seconds);
  estimate->T_world_body.translation.x() = x;
  estimate->has_scan = has_scan;
  return estimate;
}

TEST(SightCollector, TheLastImageBeforeTheKeyframeIsPlacedBetweenTheEstimates) {
  SightCollector sights("mono", 0.2);
  sights.AddEstimate(EstimateAt(1.0, 0.0));
  EXPECT_FALSE(sights.Take());
  for (const double time : {0.98, 1.03, 1.07, 1.12}) sights.AddImage(ImageAt(time));
  sights.AddImage(ImageAt(1.09, "left"));
  sights.AddEstimate(EstimateAt(1.1, 0.5));
  const auto sight = sights.Take();
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->frame->time, FromSeconds(1.07));
  EXPECT_NEAR(sight->T_odom_body.translation.x(), 0.35, 1e-9);
}

TEST(SightCollector, AnImageFromBeforeTheLastEstimateIsTooOld) {
  SightCollector sights("mono", 0.2);
  sights.AddImage(ImageAt(0.9));
  sights.AddEstimate(EstimateAt(1.0, 0.0));
  sights.AddEstimate(EstimateAt(1.1, 0.1));
  EXPECT_FALSE(sights.Take());
}

TEST(SightCollector, ScansAreKeptAsFarApartAsToldAndOnce) {
  SightCollector sights("mono", 0.2);
  for (int i = 0; i <= 10; ++i) {
    sights.AddEstimate(EstimateAt(0.1 * i, 0.05 * i, i != 4));
    sights.AddImage(ImageAt(0.1 * i + 0.05));
  }
  sights.AddEstimate(EstimateAt(1.1, 0.5));
  const auto sight = sights.Take();
  ASSERT_TRUE(sight);
  // At 0, 0.25 (0.2 has no scan) and 0.45 m.
  ASSERT_EQ(sight->scans.size(), 3U);
  EXPECT_EQ(sight->scans[1]->stamp, FromSeconds(0.5));
  sights.AddImage(ImageAt(1.15));
  sights.AddEstimate(EstimateAt(1.2, 0.55));
  EXPECT_TRUE(sights.Take()->scans.empty());
}

}  // namespace
}  // namespace regolith

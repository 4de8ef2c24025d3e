// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/slam_system.h"

#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

LidarScan Room(TimeNs stamp) {
  LidarScan scan;
  scan.stamp = stamp;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) {
      const float a = -6.0F + 0.2F * static_cast<float>(i);
      const float b = -6.0F + 0.2F * static_cast<float>(j);
      for (const Eigen::Vector3f& position :
           {Eigen::Vector3f(a, b, -1.0F), Eigen::Vector3f(6.0F, a, b),
            Eigen::Vector3f(a, 6.0F, b)}) {
        LidarPoint point;
        point.position = position;
        scan.points.push_back(point);
      }
    }
  }
  return scan;
}

TEST(SlamSystem, EveryScanGetsAPoseAndTheMapGrows) {
  RigCalibration rig;
  rig.lidar.emplace();
  ThreadPool threads(1);
  SlamSystem system({}, rig, &threads);
  EXPECT_FALSE(system.needs().imu);
  for (int i = 0; i < 5; ++i) {
    const auto reports = system.Process(Room(FromSeconds(0.1 * i)));
    ASSERT_EQ(reports.size(), 1U);
    EXPECT_LT(reports[0].T_world_body.translation.norm(), 0.01);
    EXPECT_FALSE(reports[0].stages.empty());
  }
  EXPECT_TRUE(system.Finish().empty());
  EXPECT_EQ(system.trajectory().size(), 5U);
  EXPECT_EQ(system.scans_seen(), 5U);
  EXPECT_GT(system.map_points().size(), 5000U);
}

TEST(SlamSystem, ARigWithoutALidarIsRefused) {
  ThreadPool threads(1);
  EXPECT_THROW(SlamSystem({}, RigCalibration(), &threads), InputError);
}

}  // namespace
}  // namespace regolith

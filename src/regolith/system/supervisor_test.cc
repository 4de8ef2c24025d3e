// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/supervisor.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

/// Measurements at the usual rates from `start` to `end` (s), of the lidar where it is there.
struct Feed {
  Supervisor supervisor;
  double now = 0.0;

  void Run(double seconds, bool lidar, bool camera, bool imu = true, bool lidar_is_good = true) {
    const int steps = static_cast<int>(seconds * 200.0);
    for (int i = 0; i < steps; ++i) {
      now += 0.005;
      ++tick;
      if (imu) supervisor.Observe(Subsystem::kImu, FromSeconds(now), true);
      if (tick % 20 != 0) continue;
      if (lidar) supervisor.Observe(Subsystem::kLidar, FromSeconds(now), lidar_is_good);
      if (camera) supervisor.Observe(Subsystem::kCamera, FromSeconds(now), true);
    }
  }

  std::optional<Subsystem> Leader() const { return supervisor.Leader(FromSeconds(now)); }
  SubsystemState State(Subsystem subsystem) const {
    return supervisor.State(subsystem, FromSeconds(now));
  }
  int tick = 0;
};

TEST(Supervisor, TheLidarLeadsAndTheCameraStepsIn) {
  Feed feed;
  EXPECT_EQ(feed.Leader(), std::nullopt);
  EXPECT_EQ(feed.State(Subsystem::kLidar), SubsystemState::kAbsent);
  feed.Run(1.0, true, true);
  EXPECT_EQ(feed.Leader(), Subsystem::kLidar);
  feed.Run(2.0, false, true);
  EXPECT_EQ(feed.State(Subsystem::kLidar), SubsystemState::kSilent);
  EXPECT_EQ(feed.Leader(), Subsystem::kCamera);
  feed.Run(2.0, false, false);
  EXPECT_EQ(feed.Leader(), Subsystem::kImu);
  feed.Run(0.01, false, false, false);
  EXPECT_EQ(feed.Leader(), Subsystem::kImu);
  feed.now += 1.0;
  EXPECT_EQ(feed.Leader(), std::nullopt);
}

TEST(Supervisor, WhoReturnsHasToBeGoodForAWhile) {
  Feed feed;
  feed.Run(1.0, true, true);
  feed.Run(2.0, false, true);
  feed.Run(0.5, true, true);
  EXPECT_EQ(feed.State(Subsystem::kLidar), SubsystemState::kReturning);
  EXPECT_EQ(feed.Leader(), Subsystem::kCamera);
  feed.Run(1.0, true, true);
  EXPECT_EQ(feed.Leader(), Subsystem::kLidar);
}

TEST(Supervisor, AFewPoorScansTakeNobodyTheLead) {
  Feed feed;
  feed.Run(1.0, true, true);
  feed.Run(0.2, true, true, true, false);
  EXPECT_EQ(feed.Leader(), Subsystem::kLidar);
  feed.Run(0.2, true, true, true, false);
  EXPECT_EQ(feed.State(Subsystem::kLidar), SubsystemState::kPoor);
  EXPECT_EQ(feed.Leader(), Subsystem::kCamera);
  feed.Run(0.3, true, true);
  EXPECT_EQ(feed.Leader(), Subsystem::kCamera);
  feed.Run(1.0, true, true);
  EXPECT_EQ(feed.Leader(), Subsystem::kLidar);
}

TEST(Supervisor, ShortGapsAreNone) {
  Feed feed;
  feed.Run(1.0, true, true);
  feed.Run(0.4, false, true);
  EXPECT_EQ(feed.Leader(), Subsystem::kLidar);
  feed.Run(0.2, true, true);
  EXPECT_EQ(feed.State(Subsystem::kLidar), SubsystemState::kGood);
}

TEST(Supervisor, TimesOfOneSubsystemDoNotDecrease) {
  Supervisor supervisor;
  supervisor.Observe(Subsystem::kImu, FromSeconds(1.0), true);
  EXPECT_THROW(supervisor.Observe(Subsystem::kImu, FromSeconds(0.9), true), CheckError);
}

}  // namespace
}  // namespace regolith

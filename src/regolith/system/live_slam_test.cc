// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/live_slam.h"

#include <atomic>
#include <chrono>
#include <future>

#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

constexpr double kStart = 100.0;

/// Three walls of a room, seen from x = 0.02 m · index.
LidarScan Room(int index) {
  LidarScan scan;
  scan.stamp = FromSeconds(kStart + 0.1 * index);
  const float x = 0.02F * static_cast<float>(index);
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      const float a = -6.0F + 0.3F * static_cast<float>(i);
      const float b = -6.0F + 0.3F * static_cast<float>(j);
      for (const Eigen::Vector3f& position :
           {Eigen::Vector3f(a - x, b, -1.0F), Eigen::Vector3f(6.0F - x, a, b),
            Eigen::Vector3f(a - x, 6.0F, b)}) {
        LidarPoint point;
        point.position = position;
        scan.points.push_back(point);
      }
    }
  }
  return scan;
}

class LiveSlamTest : public testing::Test {
 protected:
  LiveSlamTest() { rig_.lidar.emplace(); }

  std::unique_ptr<SlamSystem> MakeSystem() {
    return std::make_unique<SlamSystem>(PipelineOptions{}, rig_, &threads_);
  }

  std::unique_ptr<LiveSlam> Make(const LiveOptions& options, LiveSlam::Listener listener,
                                 LiveSlam::ResetListener reset_listener = {}) {
    return std::make_unique<LiveSlam>([this] { return MakeSystem(); }, 1, rig_.gravity, options,
                                      std::move(listener), std::move(reset_listener));
  }

  static void Await(const LiveSlam& live) {
    for (int i = 0; i < 2000 && !live.idle(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(live.idle());
  }

  RigCalibration rig_;
  ThreadPool threads_{1};
};

TEST_F(LiveSlamTest, GivesThePosesOfAnOfflineRun) {
  ThreadPool threads(1);  // each thread that estimates needs a pool of its own
  SlamSystem offline({}, rig_, &threads);
  const auto live = Make({}, {});
  for (int i = 0; i < 10; ++i) {
    offline.Process(Room(i));
    live->Push(0, Room(i));
  }
  offline.Settle();
  Await(*live);
  live->Ask([&](SlamSystem& system) {
    ASSERT_EQ(system.odometry().size(), 10U);
    for (size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(system.odometry().poses()[i].T_world_body.translation,
                offline.odometry().poses()[i].T_world_body.translation);
    }
  });
  EXPECT_EQ(live->status().processed, 10U);
  EXPECT_EQ(live->status().dropped_scans, 0U);
}

TEST_F(LiveSlamTest, DropsTheOldestWhereItCannotFollowAndSaysSo) {
  LiveOptions options;
  options.max_scans = 5;
  std::promise<void> go_on;
  const std::shared_future<void> wait = go_on.get_future().share();
  std::vector<TimeNs> seen;
  const auto live = Make(
      options, [&, wait](SlamSystem&, const SensorEvent* event, const std::vector<FrameReport>&) {
        wait.wait();
        if (event != nullptr) seen.push_back(EventTime(*event));
      });
  for (int i = 0; i < 30; ++i) live->Push(0, Room(i));
  EXPECT_LE(live->status().waiting, 6U);
  EXPECT_GE(live->status().dropped_scans, 23U);
  EXPECT_GT(live->status().behind, 0.3);
  go_on.set_value();
  Await(*live);
  EXPECT_EQ(seen.back(), Room(29).stamp);
  EXPECT_EQ(live->status().behind, 0.0);
}

TEST_F(LiveSlamTest, BeginsAnewOnRequestAndAfterAFailure) {
  std::atomic<bool> fails{false};
  std::vector<std::string> reasons;
  const auto live = Make(
      {},
      [&](SlamSystem&, const SensorEvent*, const std::vector<FrameReport>&) {
        if (fails) throw InputError("no good");
      },
      [&](const std::string& reason) { reasons.push_back(reason); });
  live->Push(0, Room(0));
  Await(*live);
  live->Reset("asked for");
  Await(*live);
  fails = true;
  live->Push(0, Room(1));
  Await(*live);
  EXPECT_EQ(live->status().resets, 2U);
  EXPECT_EQ(live->status().failure, "no good");
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_EQ(reasons[0], "asked for");
}

TEST_F(LiveSlamTest, ABagThatBeginsAgainBeginsAnew) {
  const auto live = Make({}, {});
  for (int i = 0; i < 40; ++i) live->Push(0, Room(i));
  for (int i = 0; i < 10; ++i) live->Push(0, Room(i));
  Await(*live);
  live->Ask([](SlamSystem& system) { EXPECT_EQ(system.odometry().size(), 10U); });
  EXPECT_EQ(live->status().time_jumps, 1U);
}

TEST_F(LiveSlamTest, WhatATaskThrowsComesBack) {
  const auto live = Make({}, {});
  EXPECT_THROW(live->Ask([](SlamSystem&) { throw OutputError("/no", "such folder"); }),
               OutputError);
}

TEST(LiveSlamPrediction, CarriesTheStateOnToTheNewestSample) {
  RigCalibration rig;
  rig.gravity = 1.62;
  rig.imu.emplace();
  rig.lidar.emplace();
  ThreadPool threads(1);
  LiveSlam live([&] { return std::make_unique<SlamSystem>(PipelineOptions{}, rig, &threads); }, 2,
                rig.gravity, {}, {}, {});
  EXPECT_FALSE(live.Predicted());
  for (int i = 0; i <= 600; ++i) {
    ImuSample sample;
    sample.time = FromSeconds(kStart + 0.005 * i);
    sample.specific_force = {0.0, 0.0, rig.gravity};
    live.Push(0, sample);
    if (i % 20 == 0) {
      LidarScan scan = Room(0);
      scan.stamp = sample.time;
      live.Push(1, std::move(scan));
    }
  }
  for (int i = 0; i < 2000 && !live.Predicted(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto state = live.Predicted();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->time, FromSeconds(kStart + 3.0));
  EXPECT_LT(state->T_world_imu.translation.norm(), 0.02);
}

}  // namespace
}  // namespace regolith

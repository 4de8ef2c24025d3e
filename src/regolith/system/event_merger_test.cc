// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/event_merger.h"

#include <gtest/gtest.h>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr size_t kImu = 0;
constexpr size_t kLidar = 1;
constexpr double kStart = 1000.0;

SensorEvent Imu(double seconds) {
  ImuSample sample;
  sample.time = FromSeconds(seconds);
  return sample;
}

SensorEvent Scan(double seconds) {
  LidarScan scan;
  scan.stamp = FromSeconds(seconds);
  return scan;
}

void Append(std::vector<SensorEvent> more, std::vector<SensorEvent>* events) {
  for (SensorEvent& event : more) events->push_back(std::move(event));
}

/// An IMU at 100 Hz, and scans that come when their turn of 0.1 s has ended. Returns what was
/// passed on.
std::vector<SensorEvent> Drive(EventMerger* merger, double start, double end) {
  std::vector<SensorEvent> events;
  for (int i = 0; start + 0.01 * i < end; ++i) {
    merger->Add(kImu, Imu(start + 0.01 * i));
    if (i % 10 == 0 && i > 0) merger->Add(kLidar, Scan(start + 0.01 * i - 0.1));
    Append(merger->TakeReady(), &events);
  }
  return events;
}

TEST(EventMerger, ScansThatComeWhenTheyEndStandBeforeWhatWasMeasuredMeanwhile) {
  EventMerger merger(2, {});
  std::vector<SensorEvent> events = Drive(&merger, kStart, kStart + 10.0);
  Append(merger.TakeAll(), &events);
  size_t scans = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    if (i > 0) {
      EXPECT_LE(EventTime(events[i - 1]), EventTime(events[i]));
    }
    scans += std::holds_alternative<LidarScan>(events[i]) ? 1 : 0;
  }
  EXPECT_EQ(scans, 99U);
  EXPECT_EQ(events.size(), 1099U);
  EXPECT_EQ(merger.dropped(kLidar).late, 0U);
  // Equal stamps in the order of the topics.
  EXPECT_TRUE(std::holds_alternative<ImuSample>(events[0]));
  EXPECT_TRUE(std::holds_alternative<LidarScan>(events[1]));
}

TEST(EventMerger, ATopicThatFallsSilentIsNotWaitedForForEver) {
  EventMerger merger(2, {});
  Drive(&merger, kStart, kStart + 2.0);
  for (int i = 0; i < 300; ++i) {
    merger.Add(kImu, Imu(kStart + 2.0 + 0.01 * i));
    merger.TakeReady();
    EXPECT_LE(merger.waiting(), 31U);
  }
  EXPECT_EQ(merger.waiting(), 0U);
}

TEST(EventMerger, DropsAndCountsWhatIsNoTime) {
  EventMerger merger(2, {});
  Drive(&merger, kStart, kStart + 2.0);
  merger.Add(kImu, Imu(kStart + 1.99));
  merger.Add(kLidar, Scan(0.0));
  // The hold of 0.3 s had passed this on long ago.
  EventMerger other(2, {});
  for (int i = 0; i < 200; ++i) {
    other.Add(kImu, Imu(kStart + 0.01 * i));
    other.TakeReady();
  }
  other.Add(kLidar, Scan(kStart + 1.0));
  EXPECT_EQ(merger.dropped(kImu).repeated, 1U);
  EXPECT_EQ(merger.dropped(kLidar).no_stamp, 1U);
  EXPECT_EQ(other.dropped(kLidar).late, 1U);
}

TEST(EventMerger, AClockInTheFutureDoesNotTakeTheOthersAlong) {
  EventMerger merger(2, {});
  Drive(&merger, kStart, kStart + 1.0);
  std::vector<SensorEvent> events;
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(merger.Add(kImu, Imu(kStart + 1.0 + 0.01 * i)));
    if (i % 10 == 0) {
      EXPECT_FALSE(merger.Add(kLidar, Scan(kStart + 3600.0 + 0.01 * i)));
    }
    Append(merger.TakeReady(), &events);
  }
  EXPECT_GT(merger.dropped(kLidar).astray, 18U);
  EXPECT_EQ(merger.dropped(kImu).astray, 0U);
  EXPECT_GT(events.size(), 180U);
}

TEST(EventMerger, ATopicThatLagsFarBehindIsLateAndNoOtherTime) {
  EventMerger merger(2, {});
  Drive(&merger, kStart, kStart + 1.0);
  for (int i = 0; i < 900; ++i) EXPECT_FALSE(merger.Add(kImu, Imu(kStart + 1.0 + 0.01 * i)));
  merger.TakeReady();
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(merger.Add(kLidar, Scan(kStart + 1.0 + 0.1 * i)));
  EXPECT_EQ(merger.dropped(kLidar).late, 50U);
  EXPECT_EQ(merger.dropped(kLidar).astray, 0U);
  for (int i = 50; i < 100; ++i) merger.Add(kLidar, Scan(kStart + 1.0 + 0.1 * i));
  EXPECT_LT(merger.dropped(kLidar).late, 99U);
}

TEST(EventMerger, ABagThatBeginsAgainIsANewRunWithoutLoss) {
  EventMerger merger(2, {});
  Drive(&merger, kStart, kStart + 30.0);
  int jumps = 0;
  std::vector<SensorEvent> events;
  for (int i = 0; i < 200; ++i) {
    jumps += merger.Add(kImu, Imu(kStart + 0.01 * i)) ? 1 : 0;
    if (i % 10 == 0 && i > 0) jumps += merger.Add(kLidar, Scan(kStart + 0.01 * i - 0.1)) ? 1 : 0;
    if (jumps > 0) Append(merger.TakeReady(), &events);
  }
  EXPECT_EQ(jumps, 1);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(EventTime(events.front()), FromSeconds(kStart));
  EXPECT_EQ(merger.dropped(kImu).astray, 0U);
}

TEST(EventMerger, AGapIsPassedOnAndAnotherDayIsANewRun) {
  EventMerger merger(1, {});
  merger.Add(0, Imu(kStart));
  bool jumped = false;
  for (int i = 0; i <= 60; ++i) jumped |= merger.Add(0, Imu(kStart + 20.0 + 0.01 * i));
  EXPECT_FALSE(jumped);
  EXPECT_EQ(merger.TakeReady().size(), 62U);
  for (int i = 0; i <= 60; ++i) jumped |= merger.Add(0, Imu(kStart + 86400.0 + 0.01 * i));
  EXPECT_TRUE(jumped);
}

TEST(EventMerger, RefusesOptionsThatMakeNoOrder) {
  EventMergerOptions options;
  options.max_behind = 0.1;
  EXPECT_THROW(EventMerger(1, options), CheckError);
}

}  // namespace
}  // namespace regolith

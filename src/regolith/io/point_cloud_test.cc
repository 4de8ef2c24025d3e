// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/point_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "regolith/io/ros1_test_messages_internal.h"

namespace regolith {
namespace {

using sensor_msgs::PointField;
using testing::HasSubstr;

constexpr TimeNs kTime = 1700000000123456789;

/// One turn of a 16-ring lidar in firing order, clockwise, 900 firings.
LidarScan Turn() {
  LidarScan scan;
  scan.stamp = kTime;
  for (int firing = 0; firing < 900; ++firing) {
    const double azimuth = -2.0 * M_PI * firing / 900.0;
    for (uint16_t ring = 0; ring < 16; ++ring) {
      const double elevation = (-15.0 + 2.0 * ring) * M_PI / 180.0;
      LidarPoint point;
      point.position =
          (10.0 * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation)))
              .cast<float>();
      point.intensity = 5.0F;
      point.ring = ring;
      point.time = static_cast<float>(0.1 * firing / 900.0);
      scan.points.push_back(point);
    }
  }
  return scan;
}

/// A cloud with the fields asked for, each of the type given, in alphabetical order and padded.
sensor_msgs::PointCloud2 MakeCloud(const LidarScan& scan, const std::map<std::string, int>& types,
                                   double time_scale = 1.0, double time_origin = 0.0) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = ToRosTime(scan.stamp);
  for (const auto& [name, type] : types) {
    PointField field;
    field.name = name;
    field.datatype = static_cast<uint8_t>(type);
    field.offset = cloud.point_step;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += 9;  // every field padded, none aligned
  }
  cloud.height = 1;
  cloud.width = static_cast<uint32_t>(scan.points.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  for (size_t i = 0; i < scan.points.size(); ++i) {
    const LidarPoint& point = scan.points[i];
    const std::map<std::string, double> values = {
        {"x", point.position.x()},      {"y", point.position.y()},
        {"z", point.position.z()},      {"intensity", point.intensity},
        {"ring", point.ring},           {"time", point.time * time_scale + time_origin},
        {"t", point.time * time_scale}, {"timestamp", point.time * time_scale + time_origin}};
    for (const PointField& field : cloud.fields) {
      uint8_t* const bytes = &cloud.data[i * cloud.point_step + field.offset];
      const double value = values.at(field.name);
      const auto store = [&](auto typed) { std::memcpy(bytes, &typed, sizeof(typed)); };
      if (field.datatype == PointField::FLOAT32) store(static_cast<float>(value));
      if (field.datatype == PointField::FLOAT64) store(value);
      if (field.datatype == PointField::UINT8) store(static_cast<uint8_t>(value));
      if (field.datatype == PointField::UINT16) store(static_cast<uint16_t>(value));
      if (field.datatype == PointField::UINT32) store(static_cast<uint32_t>(value));
    }
  }
  return cloud;
}

void ExpectSameScan(const LidarScan& read, const LidarScan& scan, double time_tolerance) {
  ASSERT_EQ(read.points.size(), scan.points.size());
  EXPECT_EQ(read.stamp, scan.stamp);
  EXPECT_TRUE(read.has_point_times);
  for (size_t i = 0; i < scan.points.size(); ++i) {
    ASSERT_NEAR((read.points[i].position - scan.points[i].position).norm(), 0.0, 1e-6) << i;
    ASSERT_EQ(read.points[i].ring, scan.points[i].ring) << i;
    ASSERT_NEAR(read.points[i].time, scan.points[i].time, time_tolerance) << i;
  }
}

PointCloudResult Parse(const sensor_msgs::PointCloud2& cloud) {
  return ParsePointCloud(Serialize(cloud), LidarCalibration());
}

TEST(PointCloud, RoundTripIsExact) {
  const LidarScan scan = Turn();
  const PointCloudResult result = Parse(ToRos(scan));
  ASSERT_TRUE(result.scan) << result.problem;
  ExpectSameScan(*result.scan, scan, 0.0);
  EXPECT_EQ(result.scan->points[7].intensity, 5.0F);
  EXPECT_FALSE(result.facts.ring_derived || result.facts.time_derived || result.facts.time_missing);
}

TEST(PointCloud, ReadsEveryTypeOrderAndUnit) {
  const LidarScan scan = Turn();
  const int f32 = PointField::FLOAT32;
  const int f64 = PointField::FLOAT64;
  const std::map<std::string, int> base = {{"x", f64},
                                           {"y", f32},
                                           {"z", f32},
                                           {"intensity", PointField::UINT8},
                                           {"ring", PointField::UINT8}};
  const auto parse = [&](const char* time, int type, double scale, double origin) {
    auto types = base;
    types[time] = type;
    const PointCloudResult result = Parse(MakeCloud(scan, types, scale, origin));
    EXPECT_TRUE(result.scan) << result.problem;
    EXPECT_FALSE(result.facts.time_derived) << time;
    return *result.scan;
  };
  ExpectSameScan(parse("time", f32, 1.0, 0.0), scan, 1e-7);
  ExpectSameScan(parse("time", f32, 1e6, 0.0), scan, 1e-7);              // µs
  ExpectSameScan(parse("t", PointField::UINT32, 1e9, 0.0), scan, 1e-7);  // ns, as Ouster
  ExpectSameScan(parse("timestamp", f64, 1.0, static_cast<double>(kTime) * 1e-9), scan, 1e-6);
  ExpectSameScan(parse("timestamp", f64, 1e9, static_cast<double>(kTime)), scan, 1e-6);
}

TEST(PointCloud, MissingFieldsAreDerivedAndSaid) {
  const LidarScan scan = Turn();
  const int f32 = PointField::FLOAT32;
  const PointCloudResult result = Parse(MakeCloud(scan, {{"x", f32}, {"y", f32}, {"z", f32}}));
  ASSERT_TRUE(result.scan) << result.problem;
  EXPECT_TRUE(result.facts.ring_derived && result.facts.time_derived);
  EXPECT_TRUE(result.facts.intensity_missing);
  ExpectSameScan(*result.scan, scan, 1e-4);
}

TEST(PointCloud, TimesAreNotInventedForPointsOutOfOrder) {
  LidarScan scan = Turn();
  std::stable_sort(scan.points.begin(), scan.points.end(),
                   [](const LidarPoint& a, const LidarPoint& b) { return a.ring < b.ring; });
  const int f32 = PointField::FLOAT32;
  const PointCloudResult result = Parse(MakeCloud(scan, {{"x", f32}, {"y", f32}, {"z", f32}}));
  ASSERT_TRUE(result.scan) << result.problem;
  EXPECT_FALSE(result.scan->has_point_times);
  EXPECT_TRUE(result.facts.time_missing);
  for (const LidarPoint& point : result.scan->points) ASSERT_EQ(point.time, 0.0F);
}

TEST(PointCloud, PointsWithoutValueOrOutOfRangeAreDropped) {
  LidarScan scan = Turn();
  scan.points[0].position.x() = NAN;
  scan.points[1].position.z() = INFINITY;
  scan.points[2].position *= 0.01F;
  scan.points[3].position *= 50.0F;
  const PointCloudResult result = Parse(ToRos(scan));
  ASSERT_TRUE(result.scan);
  EXPECT_EQ(result.facts.invalid_points, 2U);
  EXPECT_EQ(result.scan->points.size(), scan.points.size() - 4);
  EXPECT_EQ(result.scan->points.front().ring, 4);
  EXPECT_EQ(result.scan->points.front().time, scan.points[4].time);
}

TEST(PointCloud, MalformedCloudsAreRefused) {
  LidarScan scan = Turn();
  scan.points.resize(10);
  const auto problem = [&](const std::function<void(sensor_msgs::PointCloud2&)>& spoil) {
    sensor_msgs::PointCloud2 cloud = ToRos(scan);
    spoil(cloud);
    return Parse(cloud).problem;
  };
  EXPECT_EQ(problem([](auto&) {}), "");
  EXPECT_THAT(problem([](auto& c) { c.is_bigendian = 1; }), HasSubstr("big-endian"));
  EXPECT_THAT(problem([](auto& c) { c.row_step = 5; }), HasSubstr("do not agree"));
  EXPECT_THAT(problem([](auto& c) { c.width = 100000; }), HasSubstr("do not agree"));
  EXPECT_THAT(problem([](auto& c) { c.width = c.height = c.row_step = 0xFFFFFFFF; }),
              HasSubstr("do not agree"));
  EXPECT_NE(problem([](auto& c) { c.point_step = 0; }), "");
  EXPECT_THAT(problem([](auto& c) { c.data.resize(100); }), HasSubstr("do not agree"));
  EXPECT_THAT(problem([](auto& c) { c.fields[1].offset = 4000000000U; }), HasSubstr("field 'y'"));
  EXPECT_THAT(problem([](auto& c) { c.fields[1].datatype = 9; }), HasSubstr("field 'y'"));
  EXPECT_THAT(problem([](auto& c) { c.fields[2].name = "height"; }), HasSubstr("no fields x y z"));
  const auto bytes = Serialize(ToRos(scan));
  for (size_t length = 0; length + 1 < bytes.size(); ++length) {
    EXPECT_FALSE(ParsePointCloud({bytes.data(), length}, LidarCalibration()).scan) << length;
  }
}

TEST(PointCloud, EmptyCloudIsAScanWithoutPoints) {
  LidarScan scan;
  scan.stamp = kTime;
  const PointCloudResult result = Parse(ToRos(scan));
  ASSERT_TRUE(result.scan) << result.problem;
  EXPECT_TRUE(result.scan->points.empty());
}

TEST(PointCloud, ValuesThatItsTypesCannotHoldAreLeftOut) {
  LidarScan scan = Turn();
  scan.points.resize(2);
  sensor_msgs::PointCloud2 cloud = MakeCloud(scan, {{"x", PointField::FLOAT32},
                                                    {"y", PointField::FLOAT32},
                                                    {"z", PointField::FLOAT32},
                                                    {"intensity", PointField::FLOAT64},
                                                    {"ring", PointField::FLOAT32}});
  const auto store = [&](const std::string& name, auto value) {
    for (const PointField& field : cloud.fields) {
      if (field.name == name) std::memcpy(&cloud.data[field.offset], &value, sizeof(value));
    }
  };
  store("intensity", 1e300);
  store("ring", std::nanf(""));
  const auto result = ParsePointCloud(Serialize(cloud), LidarCalibration());
  ASSERT_TRUE(result.scan);
  ASSERT_EQ(result.scan->points.size(), 2U);
  EXPECT_EQ(result.scan->points[0].intensity, 0.0F);
  EXPECT_EQ(result.scan->points[0].ring, 0);
  EXPECT_EQ(result.scan->points[1].ring, 1);
}

TEST(PointCloud, RowsWithoutPointsTakeNoTime) {
  sensor_msgs::PointCloud2 cloud = MakeCloud(
      Turn(), {{"x", PointField::FLOAT32}, {"y", PointField::FLOAT32}, {"z", PointField::FLOAT32}});
  cloud.height = 0xffffffffU;
  cloud.width = 0;
  cloud.row_step = 0;
  const auto result = ParsePointCloud(Serialize(cloud), LidarCalibration());
  ASSERT_TRUE(result.scan);
  EXPECT_TRUE(result.scan->points.empty());
}

}  // namespace
}  // namespace regolith

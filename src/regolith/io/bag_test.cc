// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>

#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/bag_reader.h"
#include "regolith/io/bag_source.h"
#include "regolith/io/bag_writer.h"
#include "regolith/io/recording.h"
#include "regolith/io/ros1_conversions_internal.h"
#include "regolith/io/test_folder.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr TimeNs kStart = 1700000000000000000;
constexpr TimeNs kMillisecond = 1000000;

RigCalibration MakeRig() {
  RigCalibration rig;
  rig.imu.emplace();
  rig.lidar.emplace();
  rig.wheels.emplace();
  for (const char* const name : {"mono", "left"}) {
    CameraCalibration camera;
    camera.topic = std::string("/camera/") + name + "/image_raw";
    camera.intrinsics = {CameraModelType::kPinhole, 8, 6, {5, 5}, {3.5, 2.5}, {}};
    rig.cameras[name] = camera;
  }
  return rig;
}

LidarScan MakeScan(TimeNs stamp) {
  LidarScan scan;
  scan.stamp = stamp;
  for (int i = 0; i < 50; ++i) {
    const float value = static_cast<float>(i);
    scan.points.push_back({{5.0F + value, value, -1.0F}, value, 0.002F * value, 3});
  }
  return scan;
}

CameraFrame MakeFrame(TimeNs time, const std::string& name) {
  CameraFrame frame{time, name, {8, 6, {}}};
  for (int i = 0; i < 48; ++i) frame.image.data.push_back(static_cast<uint8_t>(i * 5));
  return frame;
}

ImuSample AtRest(TimeNs time) { return {time, Eigen::Vector3d::Zero(), {0.0, 0.0, 9.8}}; }

/// Every sensor for `count` tenths of a second, in order.
std::vector<SensorEvent> MakeEvents(int count) {
  std::vector<SensorEvent> events;
  for (int i = 0; i < count; ++i) {
    const TimeNs time = kStart + i * 100 * kMillisecond;
    events.emplace_back(MakeScan(time));
    for (int j = 0; j < 20; ++j) {
      const TimeNs sample_time = time + j * 5 * kMillisecond + 1;
      events.emplace_back(ImuSample{sample_time, {0.1, 0.2, 0.3}, {0.0, 0.1, 9.8}});
      if (j == 4) events.emplace_back(MakeFrame(sample_time + 1, "mono"));
      if (j == 4) events.emplace_back(MakeFrame(sample_time + 2, "left"));
      if (j % 4 == 0) {
        WheelOdometry odometry;
        odometry.time = sample_time + 3;
        odometry.T_odom_base.translation.x() = i + 0.05 * j;
        events.emplace_back(odometry);
      }
    }
  }
  return events;
}

void WriteBag(const std::string& path, const std::vector<SensorEvent>& events,
              BagCompression compression = BagCompression::kNone) {
  const auto writer = BagWriter::Create(path, MakeRig(), compression);
  for (const SensorEvent& event : events) writer->Write(event);
  writer->WriteTruth({kStart, SE3()});
  writer->Close();
}

ReadOptions Everything() {
  ReadOptions options;
  options.cameras = {"left", "mono"};
  options.wheels = true;
  return options;
}

std::vector<SensorEvent> ReadAll(SensorSource& source) {
  std::vector<SensorEvent> events;
  while (auto event = source.Next()) events.push_back(std::move(*event));
  return events;
}

std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void ExpectSame(const SensorEvent& read, const SensorEvent& written) {
  ASSERT_EQ(read.index(), written.index());
  ASSERT_EQ(EventTime(read), EventTime(written));
  if (const auto* sample = std::get_if<ImuSample>(&read)) {
    EXPECT_EQ(sample->specific_force, std::get<ImuSample>(written).specific_force);
    EXPECT_EQ(sample->angular_velocity, std::get<ImuSample>(written).angular_velocity);
  } else if (const auto* scan = std::get_if<LidarScan>(&read)) {
    const LidarScan& other = std::get<LidarScan>(written);
    ASSERT_EQ(scan->points.size(), other.points.size());
    EXPECT_EQ(scan->points[9].position, other.points[9].position);
    EXPECT_EQ(scan->points[9].time, other.points[9].time);
    EXPECT_EQ(scan->points[9].ring, other.points[9].ring);
  } else if (const auto* frame = std::get_if<CameraFrame>(&read)) {
    EXPECT_EQ(frame->camera, std::get<CameraFrame>(written).camera);
    EXPECT_EQ(frame->image.data, std::get<CameraFrame>(written).image.data);
  } else {
    EXPECT_EQ(std::get<WheelOdometry>(read).T_odom_base.translation,
              std::get<WheelOdometry>(written).T_odom_base.translation);
  }
}

class BagRoundTrip : public testing::TestWithParam<BagCompression> {};

TEST_P(BagRoundTrip, EveryTopicComesBackInOrder) {
  const TestFolder folder;
  const std::string path = folder.Path("recording.bag");
  const auto events = MakeEvents(20);
  WriteBag(path, events, GetParam());
  const auto source = OpenRecording(IdentifyRecording(path), MakeRig(), Everything());
  EXPECT_EQ(source->start_time(), kStart);
  EXPECT_NEAR(SecondsBetween(source->end_time(), EventTime(events.back())), 0.0, 0.01);
  const auto read = ReadAll(*source);
  ASSERT_EQ(read.size(), events.size());
  for (size_t i = 0; i < events.size(); ++i) ExpectSame(read[i], events[i]);
  EXPECT_TRUE(source->Notices().empty()) << source->Notices().front();
}

INSTANTIATE_TEST_SUITE_P(Compressions, BagRoundTrip,
                         testing::Values(BagCompression::kNone, BagCompression::kLz4,
                                         BagCompression::kBz2));

TEST(BagWriter, SameEventsGiveTheSameBytes) {
  const TestFolder folder;
  const auto events = MakeEvents(3);
  WriteBag(folder.Path("a.bag"), events);
  WriteBag(folder.Path("b.bag"), events);
  EXPECT_EQ(ReadFile(folder.Path("a.bag")), ReadFile(folder.Path("b.bag")));
}

TEST(BagWriter, HasAllTopicsOfTheContract) {
  const TestFolder folder;
  WriteBag(folder.Path("a.bag"), MakeEvents(1));
  std::vector<std::string> names;
  const auto bag = BagReader::Open(folder.Path("a.bag"));
  for (const BagTopic& topic : bag->topics()) {
    names.push_back(topic.name + " " + topic.type);
  }
  EXPECT_THAT(names, testing::ElementsAre("/camera/left/camera_info sensor_msgs/CameraInfo",
                                          "/camera/left/image_raw sensor_msgs/CompressedImage",
                                          "/camera/mono/camera_info sensor_msgs/CameraInfo",
                                          "/camera/mono/image_raw sensor_msgs/CompressedImage",
                                          "/ground_truth/pose geometry_msgs/PoseStamped",
                                          "/imu/data sensor_msgs/Imu", "/odom nav_msgs/Odometry",
                                          "/velodyne_points sensor_msgs/PointCloud2"));
}

TEST(BagWriter, UnclosedLeavesNothingAndPartialIsMarked) {
  const TestFolder folder;
  { BagWriter::Create(folder.Path("recording.bag"), MakeRig())->Write(AtRest(kStart)); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
  const auto writer = BagWriter::Create(folder.Path("recording.bag"), MakeRig());
  writer->Write(AtRest(0));
  writer->Write(AtRest(5));
  writer->Close(true);
  EXPECT_FALSE(fs::exists(folder.Path("recording.bag")));
  const auto identity = IdentifyRecording(folder.path());
  EXPECT_EQ(identity.format, RecordingFormat::kSimulated);
  ReadOptions options;
  options.lidar = false;
  EXPECT_EQ(ReadAll(*OpenRecording(identity, MakeRig(), options)).size(), 2U);
}

TEST(BagWriter, FullDiskIsAnOutputError) {
  const TestFolder folder;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit = {20000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THROW(WriteBag(folder.Path("a.bag"), MakeEvents(20)), OutputError);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_THROW(BagWriter::Create("/no/such/folder/a.bag", MakeRig()), OutputError);
}

TEST(BagSource, HeaderStampsRuleNotRecordTimes) {
  const TestFolder folder;
  const std::string path = folder.Path("late.bag");
  auto events = MakeEvents(10);
  {
    // Scans are recorded 60 ms after their stamp, everything else at once.
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    for (const SensorEvent& event : events) {
      if (const auto* scan = std::get_if<LidarScan>(&event)) {
        bag.write("/velodyne_points", ToRosTime(scan->stamp + 60 * kMillisecond), ToRos(*scan));
      } else if (const auto* sample = std::get_if<ImuSample>(&event)) {
        bag.write("/imu/data", ToRosTime(sample->time), ToRos(*sample));
      }
    }
    bag.close();
  }
  const auto read = ReadAll(*OpenBagSource(path, MakeRig(), {}));
  ASSERT_EQ(read.size(), 10U * 21U);
  for (size_t i = 1; i < read.size(); ++i) ASSERT_LE(EventTime(read[i - 1]), EventTime(read[i]));
  EXPECT_TRUE(std::holds_alternative<LidarScan>(read[0]));
}

TEST(BagSource, TimeOffsetsPutStampsOnTheImusClock) {
  const TestFolder folder;
  WriteBag(folder.Path("a.bag"), MakeEvents(5));
  RigCalibration rig = MakeRig();
  rig.lidar->time_offset = 0.0123;
  const auto read = ReadAll(*OpenBagSource(folder.Path("a.bag"), rig, {}));
  const auto first = std::find_if(read.begin(), read.end(), [](const SensorEvent& event) {
    return std::holds_alternative<LidarScan>(event);
  });
  EXPECT_EQ(EventTime(*first), kStart + 12300000);
  for (size_t i = 1; i < read.size(); ++i) ASSERT_LE(EventTime(read[i - 1]), EventTime(read[i]));
}

TEST(BagSource, RepeatedAndBackwardStampsAreDroppedAndReported) {
  const TestFolder folder;
  const std::string path = folder.Path("jump.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    TimeNs record = kStart;
    for (const int64_t ms : {0, 5, 5, 10, 3, 15, 20}) {
      ImuSample sample = AtRest(kStart + ms * kMillisecond);
      if (ms == 15) sample.specific_force.z() = NAN;
      bag.write("/imu/data", ToRosTime(record += 5 * kMillisecond), ToRos(sample));
    }
    bag.close();
  }
  ReadOptions options;
  options.lidar = false;
  const auto source = OpenBagSource(path, MakeRig(), options);
  EXPECT_EQ(ReadAll(*source).size(), 4U);
  EXPECT_THAT(source->Notices(),
              testing::UnorderedElementsAre(
                  "/imu/data: 2 messages dropped: stamp not after the previous one",
                  "/imu/data: 1 message dropped: values that are not finite"));
}

TEST(BagSource, CutsDropATopicForAWhile) {
  const TestFolder folder;
  WriteBag(folder.Path("a.bag"), MakeEvents(10));
  ReadOptions options;
  options.cuts = {{"/velodyne_points", 0.25, 0.55}};
  const auto source = OpenBagSource(folder.Path("a.bag"), MakeRig(), options);
  size_t scans = 0;
  for (const SensorEvent& event : ReadAll(*source)) {
    if (!std::holds_alternative<LidarScan>(event)) continue;
    ++scans;
    const double seconds = SecondsBetween(kStart, EventTime(event));
    EXPECT_TRUE(seconds < 0.25 || seconds > 0.55) << seconds;
  }
  EXPECT_EQ(scans, 7U);
  options.cuts = {{"/gps", 0.0, 1.0}};
  EXPECT_THAT(ErrorOf([&] { OpenBagSource(folder.Path("a.bag"), MakeRig(), options); }),
              AllOf(HasSubstr("/gps"), HasSubstr("/velodyne_points")));
}

TEST(BagSource, WrongTopicsAreNamed) {
  const TestFolder folder;
  const std::string path = folder.Path("a.bag");
  WriteBag(path, MakeEvents(2));
  RigCalibration rig = MakeRig();
  rig.imu->topic = "/imu/raw";
  EXPECT_THAT(ErrorOf([&] { OpenBagSource(path, rig, {}); }),
              AllOf(HasSubstr("no topic /imu/raw"), HasSubstr("/imu/data")));
  rig = MakeRig();
  rig.lidar->topic = "/imu/data";
  EXPECT_THAT(ErrorOf([&] { OpenBagSource(path, rig, {}); }),
              AllOf(HasSubstr("/imu/data is of type sensor_msgs/Imu"),
                    HasSubstr("expected sensor_msgs/PointCloud2")));
  rig = MakeRig();
  rig.cameras["mono"].intrinsics.width = 640;
  ReadOptions options;
  options.cameras = {"mono"};
  EXPECT_THAT(ErrorOf([&] { ReadAll(*OpenBagSource(path, rig, options)); }),
              AllOf(HasSubstr("8 x 6"), HasSubstr("640 x 6")));
  rig = MakeRig();
  rig.cameras["mono"].topic = "/elsewhere";
  EXPECT_THAT(ErrorOf([&] { OpenBagSource(path, rig, options); }),
              HasSubstr("no topic /elsewhere"));
  options.skip_absent_cameras = true;
  const auto source = OpenBagSource(path, rig, options);
  for (const SensorEvent& event : ReadAll(*source)) {
    EXPECT_FALSE(std::holds_alternative<CameraFrame>(event));
  }
  EXPECT_THAT(source->Notices(), testing::Contains(HasSubstr("no topic /elsewhere")));

  rig = MakeRig();
  rig.wheels.emplace().topic = "/nowhere";
  options = {};
  options.wheels = true;
  EXPECT_THAT(ErrorOf([&] { OpenBagSource(path, rig, options); }), HasSubstr("no topic /nowhere"));
  options.skip_absent_wheels = true;
  EXPECT_THAT(OpenBagSource(path, rig, options)->Notices(),
              testing::Contains(HasSubstr("no topic /nowhere")));
}

TEST(BagSource, CloudsWithoutRingAndTimeAreReported) {
  const TestFolder folder;
  const std::string path = folder.Path("a.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    sensor_msgs::PointCloud2 cloud = ToRos(MakeScan(kStart));
    cloud.fields.resize(4);
    cloud.data[3] = cloud.data[2] = 0xFF;  // x of the first point: NaN
    bag.write("/velodyne_points", ToRosTime(kStart), cloud);
    cloud.header.stamp = ToRosTime(kStart + 1);
    cloud.point_step = 0;
    bag.write("/velodyne_points", ToRosTime(kStart + 1), cloud);
    bag.close();
  }
  ReadOptions options;
  options.imu = false;
  const auto source = OpenBagSource(path, MakeRig(), options);
  EXPECT_EQ(ReadAll(*source).size(), 1U);
  EXPECT_THAT(source->Notices(),
              testing::ElementsAre(HasSubstr("no field 'ring'"), HasSubstr("derived from azimuth"),
                                   HasSubstr("1 message dropped: "),
                                   HasSubstr("1 point dropped: not finite (in 1 cloud)")));
}

TEST(BagSource, BadFilesGiveOneClearLine) {
  const TestFolder folder;
  const auto error = [&](const std::string& name, const std::string& bytes) {
    WriteFile(folder.Path(name), bytes);
    return ErrorOf([&] { OpenRecording(IdentifyRecording(folder.Path(name)), MakeRig(), {}); });
  };
  EXPECT_THAT(error("empty.bag", ""), HasSubstr("empty.bag: is empty"));
  EXPECT_THAT(error("text.bag", "this is no bag at all"), HasSubstr("is not a ROS bag"));
  EXPECT_THAT(error("a.db3", "SQLite format 3\0..."), HasSubstr("rosbags-convert --src"));
  EXPECT_THAT(error("a.mcap", "\x89MCAP0\r\n"), HasSubstr("rosbags-convert --src"));
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.Path("none.bag")); }),
              HasSubstr("no such file or folder"));
  {
    rosbag::Bag bag(folder.Path("void.bag"), rosbag::bagmode::Write);
    bag.close();
  }
  EXPECT_THAT(ErrorOf([&] { OpenBagSource(folder.Path("void.bag"), MakeRig(), {}); }),
              HasSubstr("no messages"));
}

TEST(BagSource, EveryTruncationIsAnErrorOrAStream) {
  const TestFolder folder;
  for (const BagCompression compression : {BagCompression::kNone, BagCompression::kBz2}) {
    WriteBag(folder.Path("whole.bag"), MakeEvents(3), compression);
    const std::string bytes = ReadFile(folder.Path("whole.bag"));
    const size_t step = bytes.size() / 60 + 1;
    for (size_t length = 1; length < bytes.size(); length += length < 20 ? 1 : step) {
      const std::string path = folder.Path("cut.bag");
      WriteFile(path, std::string_view(bytes).substr(0, length));
      EXPECT_THROW(
          {
            const auto source = OpenRecording(IdentifyRecording(path), MakeRig(), Everything());
            ReadAll(*source);
          },
          InputError)
          << length << " of " << bytes.size();
    }
    WriteFile(folder.Path("cut.bag"), std::string_view(bytes).substr(0, bytes.size() - 1));
    EXPECT_THAT(ErrorOf([&] { OpenBagSource(folder.Path("cut.bag"), MakeRig(), {}); }),
                HasSubstr("rosbag reindex"));
  }
}

long PeakMemoryKb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(BagSource, MemoryDoesNotGrowWithTheRecording) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer keeps freed memory";
#endif
  const TestFolder folder;
  const std::string path = folder.Path("long.bag");
  RigCalibration rig = MakeRig();
  rig.cameras["mono"].intrinsics.width = 640;
  rig.cameras["mono"].intrinsics.height = 480;
  {
    // 120 MB of raw images, and a topic that falls silent after the first message.
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    sensor_msgs::Image image;
    image.encoding = "mono8";
    image.width = image.step = 640;
    image.height = 480;
    image.data.assign(640 * 480, 7);
    bag.write("/imu/data", ToRosTime(kStart), ToRos(AtRest(kStart)));
    TimeNs time = kStart;
    for (int i = 0; i < 400; ++i) {
      image.header.stamp = ToRosTime(time += 100 * kMillisecond);
      bag.write("/camera/mono/image_raw", image.header.stamp, image);
    }
    bag.write("/imu/data", ToRosTime(time), ToRos(AtRest(time)));
    bag.close();
  }
  const long before = PeakMemoryKb();
  ReadOptions options;
  options.lidar = false;
  options.cameras = {"mono"};
  const auto source = OpenBagSource(path, rig, options);
  size_t count = 0;
  while (source->Next()) ++count;
  EXPECT_EQ(count, 402U);
  EXPECT_LT(PeakMemoryKb() - before, 30000);
}

TEST(BagSource, ReadsRealBags) {
  const std::string data = DataFolder() + "/bags/";
  if (!fs::exists(data)) GTEST_SKIP() << "NO REAL DATA in " << data;
  RigCalibration rig;
  rig.imu.emplace();
  rig.wheels.emplace();
  rig.wheels->topic = "/jackal_velocity_controller/odom";
  ReadOptions options;
  options.wheels = true;
  const auto source =
      OpenRecording(IdentifyRecording(data + "jackal_imu_odometry.bag"), rig, options);
  size_t samples = 0;
  size_t odometry = 0;
  TimeNs last = 0;
  while (const auto event = source->Next()) {
    ASSERT_GE(EventTime(*event), last);
    last = EventTime(*event);
    samples += std::holds_alternative<ImuSample>(*event) ? 1 : 0;
    odometry += std::holds_alternative<WheelOdometry>(*event) ? 1 : 0;
  }
  EXPECT_GE(samples, 3050U);
  EXPECT_GE(odometry, 3050U);
  rig.imu->topic = "/imu/data";
  rig.wheels.reset();
  EXPECT_THAT(ErrorOf([&] { OpenBagSource(data + "phidgets_imu.bag", rig, options); }),
              HasSubstr("/imu/data_raw"));
}

}  // namespace
}  // namespace regolith

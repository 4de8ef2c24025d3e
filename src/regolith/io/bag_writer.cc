// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/bag_writer.h"

#include <map>
#include <utility>
#include <vector>

#include <rosbag/bag.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/ros1_conversions_internal.h"

namespace regolith {
namespace {

rosbag::CompressionType ToRosbag(BagCompression compression) {
  switch (compression) {
    case BagCompression::kLz4:
      return rosbag::compression::LZ4;
    case BagCompression::kBz2:
      return rosbag::compression::BZ2;
    case BagCompression::kNone:
      break;
  }
  return rosbag::compression::Uncompressed;
}

/// A bag that failed while being written would try again in its destructor, throw there and end the
/// process: it is kept instead.
void Abandon(std::unique_ptr<rosbag::Bag> bag) {
  static auto* const abandoned = new std::vector<std::unique_ptr<rosbag::Bag>>();
  abandoned->push_back(std::move(bag));
}

class RosBagWriter : public BagWriter {
 public:
  RosBagWriter(const std::string& path, RigCalibration rig, BagCompression compression)
      : output_(path), rig_(std::move(rig)), bag_(std::make_unique<rosbag::Bag>()) {
    Guard([&] {
      bag_->open(output_.temporary_path(), rosbag::bagmode::Write);
      bag_->setCompression(ToRosbag(compression));
    });
  }

  ~RosBagWriter() override {
    if (bag_ == nullptr) return;
    try {
      Finish();
    } catch (const OutputError&) {
      // Nobody waits for this bag: it is removed in any case.
    }
  }

  void Write(const SensorEvent& event) override {
    std::visit([this](const auto& value) { WriteEvent(value); }, event);
  }

  void WriteTruth(const StampedPose& pose) override { Put(kTruthTopic, ToRos(pose)); }

  void Close(bool partial) override {
    REGOLITH_CHECK(bag_ != nullptr, output_.path());
    Finish();
    output_.Commit(partial);
  }

 private:
  void WriteEvent(const ImuSample& sample) {
    REGOLITH_CHECK(rig_.imu.has_value(), "the rig has no IMU");
    Put(rig_.imu->topic, ToRos(sample));
  }

  void WriteEvent(const LidarScan& scan) {
    REGOLITH_CHECK(rig_.lidar.has_value(), "the rig has no lidar");
    Put(rig_.lidar->topic, ToRos(scan));
  }

  void WriteEvent(const WheelOdometry& odometry) {
    REGOLITH_CHECK(rig_.wheels.has_value(), "the rig has no wheels");
    Put(rig_.wheels->topic, ToRos(odometry));
  }

  void WriteEvent(const CameraFrame& frame) {
    const auto camera = rig_.cameras.find(frame.camera);
    REGOLITH_CHECK(camera != rig_.cameras.end(), "the rig has no camera ", frame.camera);
    sensor_msgs::CameraInfo info = ToRos(camera->second.intrinsics);
    info.header.stamp = ToRosTime(frame.time);
    info.header.frame_id = frame.camera;
    Put(camera->second.topic, ToRos(frame));
    Put(CameraInfoTopic(camera->second.topic), std::move(info));
  }

  template <typename Message>
  void Put(const std::string& topic, Message message) {
    REGOLITH_CHECK(bag_ != nullptr, output_.path());
    message.header.seq = sequence_[topic]++;
    // A bag cannot hold the time 0.
    const ros::Time time = std::max(message.header.stamp, ros::TIME_MIN);
    Guard([&] { bag_->write(topic, time, message); });
  }

  void Finish() {
    Guard([&] { bag_->close(); });
    bag_.reset();
  }

  template <typename Action>
  void Guard(Action action) {
    try {
      action();
    } catch (const ros::Exception& error) {
      if (bag_->isOpen()) {
        Abandon(std::move(bag_));
      } else {
        bag_.reset();
      }
      throw OutputError(output_.path(), std::string("cannot be written: ") + error.what());
    }
  }

  TemporaryOutput output_;
  RigCalibration rig_;
  std::unique_ptr<rosbag::Bag> bag_;
  std::map<std::string, uint32_t> sequence_;
};

}  // namespace

std::unique_ptr<BagWriter> BagWriter::Create(const std::string& path, const RigCalibration& rig,
                                             BagCompression compression) {
  return std::make_unique<RosBagWriter>(path, rig, compression);
}

std::string CameraInfoTopic(const std::string& image_topic) {
  const size_t slash = image_topic.rfind('/');
  const size_t length = slash == std::string::npos ? 0 : slash + 1;
  return image_topic.substr(0, length) + "camera_info";
}

}  // namespace regolith

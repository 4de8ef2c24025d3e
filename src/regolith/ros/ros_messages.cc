// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/ros/ros_messages_internal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "regolith/core/check.h"
#include "regolith/io/ros1_conversions_internal.h"

namespace regolith {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kPathStep = 0.5;     // m between the poses of a path without keyframes
constexpr int kMarkReach = 3;         // pixels
constexpr int kOldTrack = 20;         // frames
constexpr double kMarkerSize = 0.15;  // m
constexpr double kBehind = 0.5;       // s, from which on a node falls behind

void SetPixel(int column, int row, const std::array<uint8_t, 3>& colour,
              sensor_msgs::Image* image) {
  if (column < 0 || row < 0 || column >= static_cast<int>(image->width) ||
      row >= static_cast<int>(image->height)) {
    return;
  }
  const size_t place = static_cast<size_t>(row) * image->step + static_cast<size_t>(column) * 3;
  std::copy(colour.begin(), colour.end(), image->data.begin() + static_cast<ptrdiff_t>(place));
}

visualization_msgs::Marker EmptyMarker(TimeNs time, const std::string& frame,
                                       const std::string& name, int32_t type) {
  visualization_msgs::Marker marker;
  marker.header.stamp = ToRosTime(time);
  marker.header.frame_id = frame;
  marker.ns = name;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = kMarkerSize;
  marker.color.a = 1.0F;
  return marker;
}

geometry_msgs::Point PointMessage(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

template <typename Value>
void Add(const std::string& key, const Value& value, DiagnosticStatus* status) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = Concatenate(value);
  status->values.push_back(std::move(pair));
}

void Raise(DiagnosticStatus::_level_type level, const std::string& message,
           DiagnosticStatus* status) {
  if (level > status->level || status->message.empty()) status->message = message;
  status->level = std::max(status->level, level);
}

}  // namespace

geometry_msgs::Pose PoseMessage(const SE3& pose) {
  geometry_msgs::Pose message;
  message.position = PointMessage(pose.translation);
  message.orientation.x = pose.rotation.x();
  message.orientation.y = pose.rotation.y();
  message.orientation.z = pose.rotation.z();
  message.orientation.w = pose.rotation.w();
  return message;
}

geometry_msgs::TransformStamped TransformMessage(TimeNs time, const std::string& parent,
                                                 const std::string& child,
                                                 const SE3& T_parent_child) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = ToRosTime(time);
  message.header.frame_id = parent;
  message.child_frame_id = child;
  const geometry_msgs::Pose pose = PoseMessage(T_parent_child);
  message.transform.translation.x = pose.position.x;
  message.transform.translation.y = pose.position.y;
  message.transform.translation.z = pose.position.z;
  message.transform.rotation = pose.orientation;
  return message;
}

nav_msgs::Odometry OdometryMessage(const NavState& state, const Eigen::Vector3d& rate,
                                   const SE3& T_imu_base, const std::string& odom_frame,
                                   const std::string& base_frame) {
  nav_msgs::Odometry message;
  message.header.stamp = ToRosTime(state.time);
  message.header.frame_id = odom_frame;
  message.child_frame_id = base_frame;
  message.pose.pose = PoseMessage(state.T_world_imu * T_imu_base);
  const Eigen::Quaterniond R_base_imu = T_imu_base.rotation.conjugate();
  const Eigen::Vector3d velocity =
      R_base_imu * (state.T_world_imu.rotation.conjugate() * state.v_world_imu +
                    rate.cross(T_imu_base.translation));
  const Eigen::Vector3d rate_base = R_base_imu * rate;
  message.twist.twist.linear.x = velocity.x();
  message.twist.twist.linear.y = velocity.y();
  message.twist.twist.linear.z = velocity.z();
  message.twist.twist.angular.x = rate_base.x();
  message.twist.twist.angular.y = rate_base.y();
  message.twist.twist.angular.z = rate_base.z();
  return message;
}

geometry_msgs::PoseWithCovarianceStamped PoseWithCovariance(TimeNs time, const SE3& T_map_base,
                                                            const Matrix6d& covariance,
                                                            const std::string& map_frame) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.stamp = ToRosTime(time);
  message.header.frame_id = map_frame;
  message.pose.pose = PoseMessage(T_map_base);
  // ROS has the position first, and turns about the axes of the map.
  Matrix6d to_ros = Matrix6d::Zero();
  to_ros.topRightCorner<3, 3>().setIdentity();
  to_ros.bottomLeftCorner<3, 3>() = T_map_base.rotation.toRotationMatrix();
  const Matrix6d turned = to_ros * covariance * to_ros.transpose();
  for (int i = 0; i < 36; ++i) {
    message.pose.covariance[static_cast<size_t>(i)] = turned(i / 6, i % 6);
  }
  return message;
}

std::vector<StampedPose> KeyPoses(const SlamSystem& system, const SE3& T_imu_base) {
  std::vector<StampedPose> poses;
  if (const Backend* const backend = system.backend()) {
    for (size_t i = 0; i < backend->keyframes().size(); ++i) {
      poses.push_back({backend->keyframes()[i].time, backend->T_world_body(i) * T_imu_base});
    }
    return poses;
  }
  const Trajectory trajectory = system.trajectory();
  for (const StampedPose& pose : trajectory.poses()) {
    const SE3 T_map_base = pose.T_world_body * T_imu_base;
    if (!poses.empty() &&
        (T_map_base.translation - poses.back().T_world_body.translation).norm() < kPathStep) {
      continue;
    }
    poses.push_back({pose.time, T_map_base});
  }
  return poses;
}

nav_msgs::Path PathMessage(Span<const StampedPose> poses, const std::string& map_frame) {
  nav_msgs::Path path;
  path.header.frame_id = map_frame;
  if (!poses.empty()) path.header.stamp = ToRosTime(poses.back().time);
  for (const StampedPose& pose : poses) {
    geometry_msgs::PoseStamped stamped;
    stamped.header.frame_id = map_frame;
    stamped.header.stamp = ToRosTime(pose.time);
    stamped.pose = PoseMessage(pose.T_world_body);
    path.poses.push_back(std::move(stamped));
  }
  return path;
}

sensor_msgs::PointCloud2 CloudMessage(TimeNs time, Span<const MapPoint> points,
                                      const std::string& frame) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = ToRosTime(time);
  cloud.header.frame_id = frame;
  for (const char* const name : {"x", "y", "z", "intensity"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += sizeof(float);
  }
  cloud.height = 1;
  cloud.width = static_cast<uint32_t>(points.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = 1;
  cloud.data.resize(cloud.row_step);
  uint8_t* bytes = cloud.data.data();
  for (const MapPoint& point : points) {
    std::memcpy(bytes, point.position.data(), 12);
    std::memcpy(bytes + 12, &point.intensity, 4);
    bytes += cloud.point_step;
  }
  return cloud;
}

sensor_msgs::Image FeaturesMessage(const CameraFrame& frame, Span<const TrackedFeature> features) {
  sensor_msgs::Image message;
  message.header.stamp = ToRosTime(frame.time);
  message.header.frame_id = frame.camera;
  message.height = static_cast<uint32_t>(frame.image.height);
  message.width = static_cast<uint32_t>(frame.image.width);
  message.encoding = "rgb8";
  message.step = 3 * message.width;
  message.data.reserve(message.step * message.height);
  for (const uint8_t value : frame.image.data) message.data.insert(message.data.end(), 3, value);
  for (const TrackedFeature& feature : features) {
    const int column = static_cast<int>(std::lround(feature.pixel.x()));
    const int row = static_cast<int>(std::lround(feature.pixel.y()));
    const int green = std::min(255, 140 + 115 * feature.age / kOldTrack);
    const int red = std::max(0, 255 - 255 * feature.age / kOldTrack);
    const std::array<uint8_t, 3> colour = {static_cast<uint8_t>(red), static_cast<uint8_t>(green),
                                           0};
    for (int i = -kMarkReach; i <= kMarkReach; ++i) {
      SetPixel(column + i, row, colour, &message);
      SetPixel(column, row + i, colour, &message);
    }
  }
  return message;
}

visualization_msgs::MarkerArray LoopsMessage(const SlamSystem& system, TimeNs time,
                                             const SE3& T_imu_base, const std::string& map_frame) {
  visualization_msgs::MarkerArray message;
  const Backend* const backend = system.backend();
  if (backend == nullptr) return message;
  const auto place = [&](size_t keyframe) {
    return PointMessage(backend->T_world_body(keyframe) * T_imu_base.translation);
  };
  visualization_msgs::Marker keyframes =
      EmptyMarker(time, map_frame, "keyframes", visualization_msgs::Marker::SPHERE_LIST);
  keyframes.color.r = 0.2F;
  keyframes.color.g = 0.6F;
  keyframes.color.b = 1.0F;
  for (size_t i = 0; i < backend->keyframes().size(); ++i) {
    keyframes.points.push_back(place(i));
  }
  visualization_msgs::Marker loops =
      EmptyMarker(time, map_frame, "loops", visualization_msgs::Marker::LINE_LIST);
  loops.scale.x = 0.5 * kMarkerSize;
  loops.color.r = 1.0F;
  loops.color.g = 0.3F;
  for (const LoopRecord& loop : backend->loops()) {
    if (loop.verdict.outcome != LoopOutcome::kAccepted) continue;
    for (const size_t end : {loop.old_keyframe, loop.new_keyframe}) {
      loops.points.push_back(place(end));
    }
  }
  // RViz refuses lists without points.
  if (!keyframes.points.empty()) message.markers.push_back(std::move(keyframes));
  if (!loops.points.empty()) message.markers.push_back(std::move(loops));
  return message;
}

DiagnosticStatus TopicDiagnostics(const std::string& node, const TopicInput& input,
                                  const TopicStatus& status, const EventMerger::Dropped& dropped,
                                  double silence, const std::string& others) {
  DiagnosticStatus message;
  message.name = node + ": " + input.name();
  message.hardware_id = input.topic();
  const size_t out_of_order = dropped.no_stamp + dropped.repeated + dropped.late + dropped.astray;
  Raise(DiagnosticStatus::OK, Concatenate(status.rate, " Hz"), &message);
  if (out_of_order + status.dropped > 0) {
    Raise(DiagnosticStatus::WARN,
          Concatenate(out_of_order + status.dropped, " of ", status.messages, " messages dropped"),
          &message);
  }
  if (!status.age) {
    Raise(DiagnosticStatus::ERROR,
          "no message on " + input.topic() + " (" + input.types().front() + ") so far" +
              (others.empty() ? "" : "; of that type there is" + others),
          &message);
  } else if (*status.age > silence) {
    Raise(DiagnosticStatus::STALE, Concatenate("silent for ", std::lround(*status.age), " s"),
          &message);
  }
  if (!status.problem.empty()) Raise(DiagnosticStatus::ERROR, status.problem, &message);
  Add("topic", input.topic(), &message);
  Add("type", status.type, &message);
  Add("messages", status.messages, &message);
  Add("rate, Hz", status.rate, &message);
  Add("dropped: unreadable", status.dropped, &message);
  Add("dropped: stamp is 0", dropped.no_stamp, &message);
  Add("dropped: stamp not after the previous one", dropped.repeated, &message);
  Add("dropped: too late to be put in order", dropped.late, &message);
  Add("dropped: stamp far from those of other topics", dropped.astray, &message);
  for (size_t i = 0; i < status.notices.size(); ++i) {
    Add(Concatenate("notice ", i + 1), status.notices[i], &message);
  }
  return message;
}

DiagnosticStatus PipelineMessage(const std::string& node, const PipelineDiagnostics& state) {
  DiagnosticStatus message;
  message.name = node + ": pipeline";
  message.hardware_id = state.pipeline;
  if (state.has_pose) {
    Raise(DiagnosticStatus::OK, "led by " + state.leader, &message);
    if (state.leader == "imu" && !state.at_rest) {
      Raise(DiagnosticStatus::WARN, "dead reckoning: the IMU goes alone", &message);
    }
  } else {
    Raise(DiagnosticStatus::WARN, "no pose yet", &message);
  }
  if (!state.health.empty() && state.health != "good") {
    Raise(DiagnosticStatus::WARN, "visual odometry: " + state.health, &message);
  }
  if (state.newly_dropped > 0 || state.live.behind > kBehind) {
    Raise(DiagnosticStatus::WARN,
          Concatenate("measurements come faster than they can be worked off: ", state.live.behind,
                      " s behind, ", state.live.dropped_scans, " scans and ",
                      state.live.dropped_images, " images dropped so far"),
          &message);
  }
  if (!state.live.failure.empty()) {
    Raise(DiagnosticStatus::WARN, "began anew after a failure: " + state.live.failure, &message);
  }
  Add("pipeline", state.pipeline, &message);
  Add("measurements", state.live.processed, &message);
  Add("waiting", state.live.waiting, &message);
  Add("behind, s", state.live.behind, &message);
  Add("dropped scans", state.live.dropped_scans, &message);
  Add("dropped images", state.live.dropped_images, &message);
  Add("dropped IMU and wheels", state.live.dropped_imu, &message);
  Add("time jumps", state.live.time_jumps, &message);
  Add("new starts", state.live.resets, &message);
  Add("restarts of visual odometry", state.restarts, &message);
  Add("at rest", state.at_rest, &message);
  Add("degenerate directions", state.degenerate_directions, &message);
  Add("poses", state.poses, &message);
  Add("distance, m", state.distance, &message);
  Add("keyframes", state.keyframes, &message);
  Add("loops", state.loops, &message);
  for (size_t i = 0; i < state.notices.size(); ++i) {
    Add(Concatenate("notice ", i + 1), state.notices[i], &message);
  }
  return message;
}

}  // namespace regolith

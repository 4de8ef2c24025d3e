// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"

namespace regolith {

enum class RecordingFormat { kRosBag, kSimulated, kEuroc, kKittiRaw, kKittiOdometry };

/// "ROS 1 bag", "KITTI raw drive", …
std::string RecordingFormatName(RecordingFormat format);

struct RecordingIdentity {
  RecordingFormat format = RecordingFormat::kRosBag;
  std::string path;        ///< what the user named
  std::string data_path;   ///< the bag, or the folder that holds the data (mav0, drive, sequence)
  std::string preset_rig;  ///< "euroc", "kitti" or empty
  /// A rig.yaml that belongs to it (inside the folder of `simulate`, next to the bag), or empty.
  std::string rig_file;
  /// A ground_truth.tum that belongs to it, or empty. For the report only: estimators never see it.
  std::string truth_file;
};

/// Recognises a recording by its contents. Throws InputError that says what was found instead, or
/// how to convert it (ROS 2 bags).
RecordingIdentity IdentifyRecording(const std::string& path);

/// Lays what the folder itself says of its sensors over the rig. EuRoC: sensor.yaml of imu0, cam0
/// ("left"), cam1 ("right"). KITTI: the body is the lidar, so there is no IMU and T_imu_lidar is
/// identity; the grey cameras "left" and "right" as far as they and their calibration are there;
/// rings and fan of the first scan. Bags carry no rig: nothing changes.
void ApplyFolderCalibration(const RecordingIdentity& identity, RigCalibration* rig);

/// Messages that a user drops, to see what an estimator does without them.
struct TopicCut {
  std::string topic;   ///< of a sensor of the rig; the sensor's name ("imu", "left") will do
  double start = 0.0;  ///< s from the recording's start
  double end = 0.0;    ///< s from the recording's start
};

struct ReadOptions {
  bool imu = true;
  bool lidar = true;
  std::vector<std::string> cameras;  ///< names in the rig
  /// Cameras whose topic a bag lacks are left out, with a notice, instead of refused.
  bool skip_absent_cameras = false;
  bool skip_absent_wheels = false;  ///< the same for the wheels' topic
  bool wheels = false;
  std::vector<TopicCut> cuts;
};

/// The measurements wanted, in order of their stamps on the IMU's clock (the rig's time offsets are
/// applied). A sensor that the rig lacks is not read. Throws InputError: a topic that is absent or
/// of another type, images of another size than the rig's, a cut of an unknown topic, damage.
std::unique_ptr<SensorSource> OpenRecording(const RecordingIdentity& identity,
                                            const RigCalibration& rig, const ReadOptions& options);

}  // namespace regolith

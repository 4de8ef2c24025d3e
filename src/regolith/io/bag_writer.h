// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "regolith/geometry/trajectory.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"

namespace regolith {

enum class BagCompression { kNone, kLz4, kBz2 };

/// Writes a ROS 1 bag with the topics of the rig (docs/architecture.md, "Recording"). Record times
/// are the stamps, so the same measurements give the same bytes. The bag grows under another name
/// and appears when it is closed; one that is not closed is removed.
class BagWriter {
 public:
  static std::unique_ptr<BagWriter> Create(const std::string& path, const RigCalibration& rig,
                                           BagCompression compression = BagCompression::kNone);
  virtual ~BagWriter() = default;

  /// To the topic of its sensor; a camera frame with its camera_info beside it. Throws CheckError
  /// for a sensor that the rig lacks, OutputError where the disk is full.
  virtual void Write(const SensorEvent& event) = 0;

  /// T_world_imu on /ground_truth/pose.
  virtual void WriteTruth(const StampedPose& pose) = 0;

  /// `partial`: as PartialPath (atomic_file.h).
  virtual void Close(bool partial = false) = 0;
};

/// The topic of a camera's calibration: "camera_info" beside its images.
std::string CameraInfoTopic(const std::string& image_topic);

inline constexpr const char* kTruthTopic = "/ground_truth/pose";

}  // namespace regolith

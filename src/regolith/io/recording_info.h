// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/io/recording.h"

namespace regolith {

/// What is in one topic of a recording.
struct TopicInfo {
  std::string name;
  std::string type;
  size_t messages = 0;
  double duration = 0.0;     ///< s from the first stamp to the last
  double rate = 0.0;         ///< Hz, mean; 0 for fewer than two messages
  double largest_gap = 0.0;  ///< s
  size_t repeated = 0;       ///< stamps equal to the one before
  size_t backward = 0;       ///< stamps before the one before
  int width = 0;             ///< pixels, of the first image; 0 where there is none
  int height = 0;            ///< pixels
  double rest_force = 0.0;   ///< m/s², mean |specific force| of the first two seconds; 0: no IMU
  std::vector<std::string> remarks;
};

struct RecordingInfo {
  std::string format;
  double duration = 0.0;  ///< s
  std::vector<TopicInfo> topics;
  std::vector<std::string> notices;
};

/// Looks through a whole recording: stamps of every message, values of every IMU message, fields
/// and values of every tenth cloud, the first image of a camera. Throws InputError.
RecordingInfo InspectRecording(const RecordingIdentity& identity);

/// What keeps a rig from fitting a recording, a line each; empty where it fits: topics absent or of
/// another type, images of another size, an IMU at another rate, forces in g or under another
/// gravity.
std::vector<std::string> CheckRigFits(const RecordingIdentity& identity, const RecordingInfo& info,
                                      const RigCalibration& rig);

}  // namespace regolith

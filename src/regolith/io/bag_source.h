// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "regolith/io/bag_reader.h"
#include "regolith/io/message_decoder.h"
#include "regolith/io/recording.h"

namespace regolith {

/// The measurements of a ROS 1 bag (OpenRecording, for files). Each message is read once, in the
/// order of the file, and held until nothing earlier can come.
std::unique_ptr<SensorSource> OpenBagSource(const std::string& path, const RigCalibration& rig,
                                            const ReadOptions& options);

/// Finds the topic of a sensor. Throws InputError that names the topics that would fit where it is
/// absent, and the type where that is another one.
SensorTopic FindTopic(const BagReader& bag, SensorTopic sensor);

}  // namespace regolith

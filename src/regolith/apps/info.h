// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "regolith/io/recording.h"
#include "regolith/sensor/rig_calibration.h"

namespace regolith {

struct InfoArguments {
  std::string recording;
  std::string rig_file;  ///< empty where none was given
};

/// Prints what is in a recording and, with a rig, whether that fits. 0, or 2 where it does not fit.
int Info(const InfoArguments& arguments, const std::optional<RigCalibration>& rig,
         const RecordingIdentity& identity, std::ostream& out);

}  // namespace regolith

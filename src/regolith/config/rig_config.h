// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/config/fields.h"
#include "regolith/sensor/rig_calibration.h"

namespace regolith {

/// The rig that a document describes, checked. Throws InputError that names file, line and key.
RigCalibration LoadRig(const YamlDocument& document);

/// The rig as YAML that LoadRig reads back, with the units in comments.
std::string WriteRig(const RigCalibration& rig);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/geometry/trajectory.h"

namespace regolith {

/// A trajectory in the format of the TUM RGB-D benchmark: "stamp tx ty tz qx qy qz qw" a line
/// (seconds, metres, Hamilton quaternion), # for comments. Poses stay in the order of the file;
/// stamps may repeat or run backwards. Throws InputError with the line: another number of columns,
/// no number, NaN, a quaternion that is not of unit length.
std::vector<StampedPose> ReadTum(const std::string& path);

/// Nine decimals everywhere; the same bytes for the same poses. Throws OutputError. `partial`: as
/// PartialPath (atomic_file.h).
void WriteTum(const std::string& path, Span<const StampedPose> poses, bool partial = false);

/// One line of such a file, its end included.
std::string TumLine(const StampedPose& pose);

}  // namespace regolith

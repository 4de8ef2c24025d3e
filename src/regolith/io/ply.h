// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/cloud/map_point.h"
#include "regolith/core/span.h"

namespace regolith {

/// Points as binary little-endian PLY with float x y z intensity. Throws OutputError. `partial`: as
/// PartialPath (atomic_file.h).
void WritePly(const std::string& path, Span<const MapPoint> points, bool partial = false);

/// The vertices of a binary little-endian PLY file: x y z and, where present, intensity, of any
/// scalar type; other scalar properties are skipped. Throws InputError for another encoding, lists
/// among the vertices' properties, or data that ends early.
std::vector<MapPoint> ReadPly(const std::string& path);

}  // namespace regolith

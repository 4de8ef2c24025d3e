// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/downsample.h"

#include "regolith/cloud/voxel_table.h"
#include "regolith/core/check.h"

namespace regolith {

std::vector<uint32_t> DownsampleIndices(Span<const Eigen::Vector3d> points, double voxel_size) {
  REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
  const double inverse_size = 1.0 / voxel_size;
  VoxelTable table(points.size());
  const auto key_at = [&](uint32_t index) { return KeyOf(points[index], inverse_size); };
  std::vector<uint32_t> kept;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const VoxelKey key = key_at(i);
    if (table.Find(key, key_at) != VoxelTable::kNone) continue;
    table.Insert(key, i, key_at);
    kept.push_back(i);
  }
  return kept;
}

}  // namespace regolith

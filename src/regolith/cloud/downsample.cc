// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/downsample.h"

#include "regolith/cloud/voxel_key.h"
#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {

std::vector<uint32_t> DownsampleIndices(Span<const Eigen::Vector3d> points, double voxel_size) {
  REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
  constexpr uint32_t kEmpty = 0xffffffffU;
  size_t slots = 16;
  while (slots < 2 * points.size()) slots *= 2;
  // Open addressing: slots hold indices of kept points.
  std::vector<uint32_t> kept_at(slots, kEmpty);
  std::vector<VoxelKey> keys(points.size());
  std::vector<uint32_t> kept;
  for (uint32_t i = 0; i < points.size(); ++i) {
    keys[i] = KeyOf(points[i], 1.0 / voxel_size);
    size_t slot = Scramble(keys[i]) & (slots - 1);
    while (kept_at[slot] != kEmpty && keys[kept_at[slot]] != keys[i]) {
      slot = (slot + 1) & (slots - 1);
    }
    if (kept_at[slot] != kEmpty) continue;
    kept_at[slot] = i;
    kept.push_back(i);
  }
  return kept;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/downsample.h"

#include <algorithm>

#include "regolith/cloud/voxel_key.h"
#include "regolith/core/check.h"

namespace regolith {

std::vector<uint32_t> DownsampleIndices(Span<const Eigen::Vector3d> points, double voxel_size) {
  REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
  struct Entry {
    VoxelKey key;
    uint32_t index;
  };
  std::vector<Entry> entries(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    entries[i] = {KeyOf(points[i], 1.0 / voxel_size), static_cast<uint32_t>(i)};
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& first, const Entry& second) {
    return first.key != second.key ? first.key < second.key : first.index < second.index;
  });
  std::vector<uint32_t> kept;
  for (size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].key != entries[i - 1].key) kept.push_back(entries[i].index);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace regolith

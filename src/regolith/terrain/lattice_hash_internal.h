// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace regolith {

inline constexpr uint32_t kColumnFactor = 0x9e3779b1U;
inline constexpr uint32_t kRowFactor = 0x85ebca77U;

/// Hash of a lattice point in 32 bits, which vectorise where 64 do not. `key` is seed + column ·
/// kColumnFactor + row · kRowFactor, so that a neighbour costs one addition. The mixing is
/// "lowbias32" (Wellons 2018).
inline uint32_t LatticeHash(uint32_t key) {
  key = (key ^ (key >> 16)) * 0x7feb352dU;
  key = (key ^ (key >> 15)) * 0x846ca68bU;
  return key ^ (key >> 16);
}

}  // namespace regolith

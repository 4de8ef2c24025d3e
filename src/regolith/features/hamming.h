// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>

#include "regolith/features/feature_set.h"

namespace regolith {

/// Bits in which two binary descriptors (Descriptors::Bits) differ.
inline int HammingDistance(const uint8_t* first, const uint8_t* second) {
  int distance = 0;
  for (int word = 0; word < kBinaryBytes / 8; ++word) {
    uint64_t a;
    uint64_t b;
    std::memcpy(&a, first + 8 * word, 8);
    std::memcpy(&b, second + 8 * word, 8);
    distance += __builtin_popcountll(a ^ b);
  }
  return distance;
}

}  // namespace regolith

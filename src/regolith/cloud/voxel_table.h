// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "regolith/cloud/voxel_key.h"
#include "regolith/core/random.h"

namespace regolith {

/// Finds the index of a voxel's entry by its key: open addressing with linear probing, of a size
/// that never changes, so no insertion is dearer than another. The entries and their keys are the
/// owner's; it hands in `key_at`, a function from index to key.
class VoxelTable {
 public:
  static constexpr uint32_t kNone = 0xffffffffU;

  /// For up to `capacity` entries.
  explicit VoxelTable(size_t capacity) {
    size_t slots = 16;
    while (slots < 2 * capacity) slots *= 2;
    slots_.resize(slots);
  }

  /// kNone where the key is absent.
  template <typename KeyAt>
  uint32_t Find(VoxelKey key, const KeyAt& key_at) const {
    return slots_[SlotOf(key, key_at)] - 1U;
  }

  /// The key is absent.
  template <typename KeyAt>
  void Insert(VoxelKey key, uint32_t index, const KeyAt& key_at) {
    slots_[SlotOf(key, key_at)] = index + 1U;
  }

  /// The key is present.
  template <typename KeyAt>
  void Erase(VoxelKey key, const KeyAt& key_at) {
    // What follows in the run of slots moves up where its own place allows (Knuth 1998, 6.4, R).
    const size_t mask = slots_.size() - 1;
    size_t hole = SlotOf(key, key_at);
    for (size_t slot = (hole + 1) & mask; slots_[slot] != kEmpty; slot = (slot + 1) & mask) {
      const size_t home = Scramble(key_at(slots_[slot] - 1U)) & mask;
      if (((slot - home) & mask) < ((slot - hole) & mask)) continue;
      slots_[hole] = slots_[slot];
      hole = slot;
    }
    slots_[hole] = kEmpty;
  }

 private:
  // Slots hold index + 1, so that kEmpty - 1 is kNone.
  static constexpr uint32_t kEmpty = 0;

  template <typename KeyAt>
  size_t SlotOf(VoxelKey key, const KeyAt& key_at) const {
    const size_t mask = slots_.size() - 1;
    size_t slot = Scramble(key) & mask;
    while (slots_[slot] != kEmpty && key_at(slots_[slot] - 1U) != key) slot = (slot + 1) & mask;
    return slot;
  }

  std::vector<uint32_t> slots_;
};

}  // namespace regolith

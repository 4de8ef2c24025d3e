// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "regolith/core/span.h"
#include "regolith/core/time.h"

namespace regolith {

/// Reads the fields of a serialized ROS 1 message (little-endian, packed) one after the other.
/// Bounds are checked, so that no message, however damaged, reads past its end: then ok() turns
/// false and everything after it is zero.
class WireReader {
 public:
  explicit WireReader(Span<const uint8_t> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }

  template <typename T>
  T Read() {
    T value{};
    const Span<const uint8_t> raw = Take(sizeof(T));
    if (!raw.empty()) std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

  Span<const uint8_t> ReadArray() { return Take(Read<uint32_t>()); }

  std::string ReadString() {
    const Span<const uint8_t> raw = ReadArray();
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
  }

  /// std_msgs/Header; its stamp.
  TimeNs ReadHeader() {
    Skip(sizeof(uint32_t));
    const TimeNs seconds = Read<uint32_t>();
    const TimeNs nanoseconds = Read<uint32_t>();
    ReadArray();
    return seconds * 1000000000 + nanoseconds;
  }

  void Skip(size_t count) { Take(count); }

 private:
  Span<const uint8_t> Take(size_t count) {
    if (count > bytes_.size() - position_) ok_ = false;
    if (!ok_) return {};
    const Span<const uint8_t> taken = bytes_.Subspan(position_, count);
    position_ += count;
    return taken;
  }

  Span<const uint8_t> bytes_;
  size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/tum.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

constexpr size_t kColumns = 8;
/// Files with few decimals round their quaternions; past this the columns mean something else.
constexpr double kQuaternionTolerance = 0.01;

StampedPose ParseLine(std::string_view line, const std::string& place) {
  const auto fields = SplitBlanks(line);
  if (fields.size() != kColumns) {
    throw InputError(place, Concatenate("has ", fields.size(),
                                        " columns; expected 8: stamp tx ty tz qx qy qz qw"));
  }
  const auto time = ParseSeconds(fields[0]);
  if (!time) throw InputError(place, "stamp '" + std::string(fields[0]) + "' is not in seconds");
  std::array<double, kColumns> values{};
  for (size_t i = 1; i < kColumns; ++i) {
    const auto value = ParseNumber(fields[i]);
    if (!value || !std::isfinite(*value)) {
      throw InputError(
          place, Concatenate("column ", i + 1, " is '", fields[i], "'; expected a finite number"));
    }
    values[i] = *value;
  }
  const Eigen::Quaterniond rotation(values[7], values[4], values[5], values[6]);
  if (std::abs(rotation.norm() - 1.0) > kQuaternionTolerance) {
    throw InputError(place, Concatenate("quaternion has length ", rotation.norm(),
                                        "; expected 1 (columns: stamp tx ty tz qx qy qz qw)"));
  }
  return {*time, SE3(rotation.normalized(), {values[1], values[2], values[3]})};
}

void AppendNumber(double value, std::string* text) {
  std::array<char, 350> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                    std::chars_format::fixed, 9);
  text->push_back(' ');
  text->append(buffer.data(), result.ptr);
}

}  // namespace

std::vector<StampedPose> ReadTum(const std::string& path) {
  LineReader reader(path);
  std::vector<StampedPose> poses;
  for (std::string line; reader.Next(&line);) poses.push_back(ParseLine(line, reader.Place()));
  return poses;
}

std::string TumLine(const StampedPose& pose) {
  constexpr TimeNs kSecond = 1000000000;
  const TimeNs magnitude = std::abs(pose.time);
  std::array<char, 40> stamp{};
  std::snprintf(stamp.data(), stamp.size(), "%s%lld.%09lld", pose.time < 0 ? "-" : "",
                static_cast<long long>(magnitude / kSecond),
                static_cast<long long>(magnitude % kSecond));
  std::string line(stamp.data());
  for (int i = 0; i < 3; ++i) AppendNumber(pose.T_world_body.translation[i], &line);
  for (int i = 0; i < 4; ++i) AppendNumber(pose.T_world_body.rotation.coeffs()[i], &line);
  line.push_back('\n');
  return line;
}

void WriteTum(const std::string& path, Span<const StampedPose> poses, bool partial) {
  AtomicFile file(path);
  for (const StampedPose& pose : poses) file.Write(TumLine(pose));
  file.Commit(partial);
}

}  // namespace regolith

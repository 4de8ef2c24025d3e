// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "regolith/core/time.h"

namespace regolith {

/// The bytes of a file. Throws InputError where it cannot be read.
std::string ReadFile(const std::string& path);

/// The lines of a text file, one at a time, without their ends; memory does not grow with the file.
class LineReader {
 public:
  /// Throws InputError where the file cannot be opened.
  explicit LineReader(const std::string& path);

  /// The next line that is neither empty nor a comment (#); false at the end.
  bool Next(std::string* line);
  /// "FILE:NUMBER" of the last line, for messages.
  std::string Place() const;

 private:
  std::string path_;
  std::ifstream stream_;
  size_t number_ = 0;
};

/// Fields between spaces and tabs.
std::vector<std::string_view> SplitBlanks(std::string_view line);
/// Fields between separators, blanks around them removed.
std::vector<std::string_view> SplitAt(std::string_view line, char separator);

/// A number, whatever the locale; "nan" and "inf" are numbers. Nothing where anything else stands.
std::optional<double> ParseNumber(std::string_view text);
std::optional<int64_t> ParseInteger(std::string_view text);

/// Seconds in decimal to nanoseconds without passing through a double, which keeps a date of this
/// century to 0.2 µs only. Digits past the ninth are rounded.
std::optional<TimeNs> ParseSeconds(std::string_view text);

/// "2011-09-26 13:04:32.351950336" to nanoseconds since 1970, taken as UTC.
std::optional<TimeNs> ParseDate(std::string_view text);

}  // namespace regolith

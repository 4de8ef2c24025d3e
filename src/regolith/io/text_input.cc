// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/text_input.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include "regolith/core/error.h"

namespace regolith {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";
constexpr int64_t kNanoseconds = 1000000000;

std::string_view Trim(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Days from 1970-01-01 in the Gregorian calendar (Hinnant, "chrono-Compatible Low-Level Date
/// Algorithms").
int64_t DaysFromCivil(int64_t year, int64_t month, int64_t day) {
  year -= month <= 2 ? 1 : 0;
  const int64_t era = (year >= 0 ? year : year - 399) / 400;
  const int64_t year_of_era = year - era * 400;
  const int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year -
         719468;
}

/// The digits after a decimal point as nanoseconds.
std::optional<int64_t> ParseFraction(std::string_view digits) {
  int64_t nanoseconds = 0;
  for (size_t i = 0; i < digits.size(); ++i) {
    if (digits[i] < '0' || digits[i] > '9') return std::nullopt;
    if (i < 9) nanoseconds = nanoseconds * 10 + (digits[i] - '0');
    if (i == 9 && digits[i] >= '5') ++nanoseconds;
  }
  for (size_t i = digits.size(); i < 9; ++i) nanoseconds *= 10;
  return nanoseconds;
}

/// A folder opens as a stream and reads as an empty file.
void RefuseFolder(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw InputError(path, "is a folder; expected a file");
  }
}

}  // namespace

std::string ReadFile(const std::string& path) {
  RefuseFolder(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path, "cannot be opened");
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (stream.bad()) throw InputError(path, "cannot be read");
  return bytes;
}

LineReader::LineReader(const std::string& path) : path_(path), stream_(path) {
  RefuseFolder(path);
  if (!stream_) throw InputError(path, "cannot be opened");
}

bool LineReader::Next(std::string* line) {
  while (std::getline(stream_, *line)) {
    ++number_;
    if (number_ == 1 && line->rfind("\xEF\xBB\xBF", 0) == 0) line->erase(0, 3);
    const std::string_view text = Trim(*line);
    if (text.empty() || text.front() == '#') continue;
    *line = std::string(text);
    return true;
  }
  return false;
}

std::string LineReader::Place() const { return path_ + ":" + std::to_string(number_); }

std::vector<std::string_view> SplitBlanks(std::string_view line) {
  std::vector<std::string_view> fields;
  size_t begin = line.find_first_not_of(kBlanks);
  while (begin != std::string_view::npos) {
    const size_t end = line.find_first_of(kBlanks, begin);
    fields.push_back(line.substr(begin, end == std::string_view::npos ? end : end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return fields;
}

std::vector<std::string_view> SplitAt(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    const size_t end = line.find(separator);
    fields.push_back(Trim(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> ParseNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<int64_t> ParseInteger(std::string_view text) {
  int64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<TimeNs> ParseSeconds(std::string_view text) {
  if (text.find_first_of("eE") != std::string_view::npos) {
    const auto seconds = ParseNumber(text);
    if (!seconds || !(std::abs(*seconds) < 9e9)) return std::nullopt;
    return FromSeconds(*seconds);
  }
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (negative || text.front() == '+')) text.remove_prefix(1);
  const size_t point = text.find('.');
  const std::string_view digits = text.substr(0, point);
  const std::string_view fraction =
      point == std::string_view::npos ? std::string_view() : text.substr(point + 1);
  if (digits.empty() && fraction.empty()) return std::nullopt;
  const auto whole = digits.empty() ? std::optional<int64_t>(0) : ParseInteger(digits);
  const auto nanoseconds = ParseFraction(fraction);
  if (!whole || !nanoseconds || *whole < 0 || *whole > INT64_MAX / kNanoseconds - 1) {
    return std::nullopt;
  }
  const TimeNs time = *whole * kNanoseconds + *nanoseconds;
  return negative ? -time : time;
}

std::optional<TimeNs> ParseDate(std::string_view text) {
  const auto parts = SplitBlanks(text);
  if (parts.size() != 2) return std::nullopt;
  const auto date = SplitAt(parts[0], '-');
  const auto clock = SplitAt(parts[1], ':');
  if (date.size() != 3 || clock.size() != 3) return std::nullopt;
  const auto year = ParseInteger(date[0]);
  const auto month = ParseInteger(date[1]);
  const auto day = ParseInteger(date[2]);
  const auto hour = ParseInteger(clock[0]);
  const auto minute = ParseInteger(clock[1]);
  const auto seconds = ParseSeconds(clock[2]);
  if (!year || !month || !day || !hour || !minute || !seconds) return std::nullopt;
  // Years that nanoseconds in 64 bits can hold.
  if (*year < 1900 || *year > 2200 || *month < 1 || *month > 12 || *day < 1 || *day > 31 ||
      *hour < 0 || *hour > 23 || *minute < 0 || *minute > 59) {
    return std::nullopt;
  }
  const int64_t minutes = (DaysFromCivil(*year, *month, *day) * 24 + *hour) * 60 + *minute;
  return minutes * 60 * kNanoseconds + *seconds;
}

}  // namespace regolith

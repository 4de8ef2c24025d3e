// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace regolith {

/// A broken precondition or invariant: a fault in the calling code, never of a user's input.
class CheckError : public std::logic_error {
 public:
  CheckError(const std::string& place, const std::string& expectation)
      : std::logic_error(place + ": " + expectation), place_length_(place.size() + 2) {}

  /// What was expected, and the values found instead; without the place in the sources.
  const char* expectation() const noexcept { return what() + place_length_; }

 private:
  size_t place_length_;
};

/// The parts written one after the other, as by operator<<.
template <typename... Parts>
std::string Concatenate(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

}  // namespace regolith

/// Throws CheckError with the condition, the place and the values given after it.
#define REGOLITH_CHECK(condition, ...)                                        \
  do {                                                                        \
    if (!(condition)) {                                                       \
      throw ::regolith::CheckError(                                           \
          ::regolith::Concatenate(__FILE__, ":", __LINE__),                   \
          ::regolith::Concatenate("expected " #condition ": ", __VA_ARGS__)); \
    }                                                                         \
  } while (false)

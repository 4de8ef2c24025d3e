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
  using std::logic_error::logic_error;
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
#define REGOLITH_CHECK(condition, ...)                                           \
  do {                                                                           \
    if (!(condition)) {                                                          \
      throw ::regolith::CheckError(::regolith::Concatenate(                      \
          __FILE__, ":", __LINE__, ": expected " #condition ": ", __VA_ARGS__)); \
    }                                                                            \
  } while (false)

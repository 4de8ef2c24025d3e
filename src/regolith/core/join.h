// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace regolith {

/// The strings of a range, one after the other with `between` them.
template <typename Range>
std::string Join(const Range& words, const std::string& between = ", ") {
  std::string joined;
  bool is_first = true;
  for (const std::string& word : words) {
    if (!is_first) joined += between;
    joined += word;
    is_first = false;
  }
  return joined;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// A pixel that a corner detector found.
struct Corner {
  float response = 0.0F;
  int column = 0;
  int row = 0;
};

/// Strongest first, of equal ones the upper, then the left one.
inline bool Stronger(const Corner& a, const Corner& b) {
  if (a.response != b.response) return a.response > b.response;
  return a.row != b.row ? a.row < b.row : a.column < b.column;
}

}  // namespace regolith

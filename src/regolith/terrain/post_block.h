// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace regolith {

/// Posts on a lattice: post (i, j) lies at x + i · spacing, y + j · spacing (m, frame `map`) and
/// has the index j · columns + i.
struct PostBlock {
  double x = 0.0;
  double y = 0.0;
  double spacing = 1.0;
  int columns = 0;
  int rows = 0;

  size_t size() const { return static_cast<size_t>(columns) * static_cast<size_t>(rows); }
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/homography.h"

#include <cmath>

#include <Eigen/Dense>

#include "regolith/core/error.h"
#include "regolith/io/text_input.h"

namespace regolith {

Eigen::Matrix3d ReadHomography(const std::string& path) {
  LineReader lines(path);
  Eigen::Matrix3d homography;
  std::string line;
  int row = 0;
  for (; lines.Next(&line); ++row) {
    const auto fields = SplitBlanks(line);
    if (row == 3 || fields.size() != 3) {
      throw InputError(lines.Place(), "expected a homography: three lines of three numbers");
    }
    for (int column = 0; column < 3; ++column) {
      const std::string_view field = fields[static_cast<size_t>(column)];
      const auto number = ParseNumber(field);
      if (!number || !std::isfinite(*number)) {
        throw InputError(lines.Place(), "`" + std::string(field) + "`: expected a number");
      }
      homography(row, column) = *number;
    }
  }
  if (row != 3) throw InputError(path, "expected a homography: three lines of three numbers");
  // Relative to its size: a homography is known up to a factor.
  const Eigen::Matrix3d scaled = homography / homography.cwiseAbs().maxCoeff();
  if (!(std::abs(scaled.determinant()) > 1e-15)) {
    throw InputError(path, "is a homography that cannot be inverted");
  }
  return homography;
}

}  // namespace regolith

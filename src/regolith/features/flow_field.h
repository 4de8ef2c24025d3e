// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/features/keypoint_grid.h"

namespace regolith {

/// How the image moves around a pixel: medians, cell by cell, of what known points did.
class FlowField {
 public:
  /// `flows` (pixels) belong to points at `pixels`. Cells with few points take the median of all;
  /// without any point the flow is 0.
  void Estimate(const KeypointGrid& grid, Span<const Eigen::Vector2f> pixels,
                Span<const Eigen::Vector2f> flows);

  Eigen::Vector2f At(const Eigen::Vector2f& pixel) const;

 private:
  KeypointGrid grid_;
  std::vector<Eigen::Vector2f> cell_flows_;
  std::vector<std::vector<Eigen::Vector2f>> samples_;  ///< of each cell
  std::vector<Eigen::Vector2f> around_;                ///< of a cell and its neighbours
};

}  // namespace regolith

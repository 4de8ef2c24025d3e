// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/keypoint_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace regolith {

KeypointGrid::KeypointGrid(int width, int height, int cell_size)
    : columns_(std::max(1, (width + cell_size / 2) / cell_size)),
      rows_(std::max(1, (height + cell_size / 2) / cell_size)),
      columns_per_pixel_(static_cast<float>(columns_) / static_cast<float>(std::max(width, 1))),
      rows_per_pixel_(static_cast<float>(rows_) / static_cast<float>(std::max(height, 1))) {}

int KeypointGrid::CellOf(const Eigen::Vector2f& pixel) const {
  const auto cell = [](float place, float per_pixel, int count) {
    return std::clamp(static_cast<int>(std::floor((place + 0.5F) * per_pixel)), 0, count - 1);
  };
  return cell(pixel.y(), rows_per_pixel_, rows_) * columns_ +
         cell(pixel.x(), columns_per_pixel_, columns_);
}

void KeypointGrid::CountFilled(Span<const Eigen::Vector2f> pixels, DetectionStatus* status) const {
  std::vector<uint8_t> filled(static_cast<size_t>(cells()), 0);
  for (const Eigen::Vector2f& pixel : pixels) filled[static_cast<size_t>(CellOf(pixel))] = 1;
  status->cells = cells();
  status->cells_filled = std::accumulate(filled.begin(), filled.end(), 0);
}

void EvenSelection::Select(const KeypointGrid& grid, Span<const Eigen::Vector2f> present,
                           Span<const Eigen::Vector2f> candidates, int count,
                           std::vector<int>* rows) {
  in_cell_.assign(static_cast<size_t>(grid.cells()), 0);
  for (const Eigen::Vector2f& pixel : present) ++in_cell_[static_cast<size_t>(grid.CellOf(pixel))];
  rounds_.clear();
  for (const Eigen::Vector2f& pixel : candidates) {
    rounds_.push_back(in_cell_[static_cast<size_t>(grid.CellOf(pixel))]++);
  }
  rows->resize(candidates.size());
  std::iota(rows->begin(), rows->end(), 0);
  const auto earlier = [this](int a, int b) {
    const int round_a = rounds_[static_cast<size_t>(a)];
    const int round_b = rounds_[static_cast<size_t>(b)];
    return round_a != round_b ? round_a < round_b : a < b;
  };
  const size_t kept = std::min(rows->size(), static_cast<size_t>(std::max(count, 0)));
  std::partial_sort(rows->begin(), rows->begin() + static_cast<std::ptrdiff_t>(kept), rows->end(),
                    earlier);
  rows->resize(kept);
  std::sort(rows->begin(), rows->end());  // strongest first again
}

}  // namespace regolith

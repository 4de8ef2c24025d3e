// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/pixel_grid.h"

namespace regolith {
namespace {

constexpr float kCellSize = 16.0F;   // pixels: a few keypoints at the usual density
constexpr float kMaxCells = 128.0F;  // a side, however far apart the pixels are

}  // namespace

PixelGrid::PixelGrid(const std::vector<Eigen::Vector2f>& pixels, std::vector<int32_t>* cell_starts,
                     std::vector<int32_t>* cell_rows)
    : pixels_(pixels.data()) {
  Eigen::Vector2f low = Eigen::Vector2f::Constant(INFINITY);
  Eigen::Vector2f high = Eigen::Vector2f::Constant(-INFINITY);
  for (const Eigen::Vector2f& pixel : pixels) {
    if (!pixel.allFinite()) continue;
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  if (!low.allFinite()) return;
  origin_ = low;
  const Eigen::Vector2f extent = high - low;
  cell_size_ = std::max(kCellSize, extent.maxCoeff() / kMaxCells);
  columns_ = static_cast<size_t>(extent.x() / cell_size_) + 1;
  rows_ = static_cast<size_t>(extent.y() / cell_size_) + 1;

  // Counting sort. Each pixel is counted one cell further on, so that after the second pass the
  // starts stand where they belong.
  const auto cell_of = [&](const Eigen::Vector2f& pixel) {
    return Cell(pixel.y() - origin_.y(), rows_) * columns_ +
           Cell(pixel.x() - origin_.x(), columns_);
  };
  cell_starts->assign(columns_ * rows_ + 2, 0);
  for (const Eigen::Vector2f& pixel : pixels) {
    if (pixel.allFinite()) ++(*cell_starts)[cell_of(pixel) + 2];
  }
  for (size_t i = 1; i < cell_starts->size(); ++i) (*cell_starts)[i] += (*cell_starts)[i - 1];
  cell_rows->resize(pixels.size());
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (!pixels[i].allFinite()) continue;
    const int32_t place = (*cell_starts)[cell_of(pixels[i]) + 1]++;
    (*cell_rows)[static_cast<size_t>(place)] = static_cast<int32_t>(i);
  }
  cell_starts_ = cell_starts->data();
  cell_rows_ = cell_rows->data();
}

size_t PixelGrid::Cell(float offset, size_t count) const {
  const float cell = offset / cell_size_;
  return static_cast<size_t>(std::min(std::max(cell, 0.0F), static_cast<float>(count - 1)));
}

}  // namespace regolith

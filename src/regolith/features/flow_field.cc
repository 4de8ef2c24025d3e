// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/flow_field.h"

#include <algorithm>

namespace regolith {
namespace {

constexpr size_t kLeastSamples = 6;

// Of each axis by itself. Reorders the samples.
Eigen::Vector2f Median(std::vector<Eigen::Vector2f>* samples) {
  Eigen::Vector2f median = Eigen::Vector2f::Zero();
  if (samples->empty()) return median;
  const auto middle = samples->begin() + static_cast<std::ptrdiff_t>(samples->size() / 2);
  for (int axis = 0; axis < 2; ++axis) {
    std::nth_element(samples->begin(), middle, samples->end(),
                     [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    median[axis] = (*middle)[axis];
  }
  return median;
}

}  // namespace

void FlowField::Estimate(const KeypointGrid& grid, Span<const Eigen::Vector2f> pixels,
                         Span<const Eigen::Vector2f> flows) {
  grid_ = grid;
  samples_.resize(static_cast<size_t>(grid.cells()));
  for (auto& samples : samples_) samples.clear();
  for (size_t i = 0; i < pixels.size(); ++i) {
    samples_[static_cast<size_t>(grid.CellOf(pixels[i]))].push_back(flows[i]);
  }
  around_.assign(flows.begin(), flows.end());
  const Eigen::Vector2f everywhere = Median(&around_);
  cell_flows_.assign(samples_.size(), everywhere);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      around_.clear();
      for (int y = std::max(0, row - 1); y <= std::min(grid.rows() - 1, row + 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(grid.columns() - 1, column + 1); ++x) {
          const auto& samples = samples_[static_cast<size_t>(y * grid.columns() + x)];
          around_.insert(around_.end(), samples.begin(), samples.end());
        }
      }
      if (around_.size() < kLeastSamples) continue;
      cell_flows_[static_cast<size_t>(row * grid.columns() + column)] = Median(&around_);
    }
  }
}

Eigen::Vector2f FlowField::At(const Eigen::Vector2f& pixel) const {
  if (cell_flows_.empty()) return Eigen::Vector2f::Zero();
  return cell_flows_[static_cast<size_t>(grid_.CellOf(pixel))];
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "regolith/core/error.h"

namespace regolith {
namespace {

// Breadth-first from the posts with data, so that each hole takes a nearest neighbour's height.
void FillHoles(HeightGrid* grid, std::vector<char>* filled) {
  std::vector<size_t> front;
  for (size_t i = 0; i < grid->heights.size(); ++i) {
    const bool hole = !std::isfinite(grid->heights[i]);
    (*filled)[i] = hole ? 1 : 0;
    if (!hole) front.push_back(i);
  }
  const auto columns = static_cast<size_t>(grid->columns);
  for (size_t head = 0; head < front.size(); ++head) {
    const size_t i = front[head];
    const auto visit = [&](size_t neighbour) {
      if (std::isfinite(grid->heights[neighbour])) return;
      grid->heights[neighbour] = grid->heights[i];
      front.push_back(neighbour);
    };
    if (i % columns > 0) visit(i - 1);
    if (i % columns + 1 < columns) visit(i + 1);
    if (i >= columns) visit(i - columns);
    if (i + columns < grid->heights.size()) visit(i + columns);
  }
}

// Catmull and Rom 1974: interpolating, C1.
double Cubic(double before, double left, double right, double after, double fraction) {
  const double slope_left = 0.5 * (right - before);
  const double slope_right = 0.5 * (after - left);
  const double a = 2.0 * (left - right) + slope_left + slope_right;
  const double b = 3.0 * (right - left) - 2.0 * slope_left - slope_right;
  return ((a * fraction + b) * fraction + slope_left) * fraction + left;
}

}  // namespace

Dem::Dem(const HeightGrid& grid) : grid_(grid), filled_(grid.heights.size(), 0) {
  if (grid.columns < 4 || grid.rows < 4) {
    throw InputError("elevation model",
                     "is smaller than 4 x 4 posts; use a larger one or crop less");
  }
  double sum = 0.0;
  double count = 0.0;
  for (const float height : grid.heights) {
    if (!std::isfinite(height)) continue;
    sum += height;
    count += 1.0;
  }
  if (count == 0.0) {
    throw InputError("elevation model", "holds no data, only no-data posts; choose another crop");
  }
  // Rays are cast in single precision: absolute elevations of kilometres would cost millimetres.
  for (float& height : grid_.heights) height = static_cast<float>(height - sum / count);
  FillHoles(&grid_, &filled_);
}

Eigen::Vector2d Dem::half_size() const {
  return 0.5 * grid_.spacing * Eigen::Vector2d(grid_.columns - 1, grid_.rows - 1);
}

Eigen::Vector2d Dem::ToPost(double x, double y) const {
  const Eigen::Vector2d half = half_size();
  return {(x + half.x()) / grid_.spacing, (half.y() - y) / grid_.spacing};
}

double Dem::Clamped(int column, int row) const {
  return grid_.At(std::clamp(column, 0, grid_.columns - 1), std::clamp(row, 0, grid_.rows - 1));
}

double Dem::Height(double x, double y) const {
  const Eigen::Vector2d post = ToPost(x, y);
  const double u = std::clamp(post.x(), 0.0, static_cast<double>(grid_.columns - 1));
  const double v = std::clamp(post.y(), 0.0, static_cast<double>(grid_.rows - 1));
  const int column = static_cast<int>(u);
  const int row = static_cast<int>(v);
  double lines[4];
  for (int i = 0; i < 4; ++i) {
    const int r = row - 1 + i;
    lines[i] = Cubic(Clamped(column - 1, r), Clamped(column, r), Clamped(column + 1, r),
                     Clamped(column + 2, r), u - column);
  }
  return Cubic(lines[0], lines[1], lines[2], lines[3], v - row);
}

void Dem::AddTo(const PostBlock& block, double* heights) const {
  std::vector<int> columns;
  std::vector<double> fractions;
  for (int i = 0; i < block.columns; ++i) {
    const double u = std::clamp(ToPost(block.x + i * block.spacing, 0.0).x(), 0.0,
                                static_cast<double>(grid_.columns - 1));
    columns.push_back(static_cast<int>(u));
    fractions.push_back(u - columns.back());
  }
  // Each row of posts sees one line of the model, interpolated north to south where it is needed.
  const int first = columns.front() - 1;
  std::vector<double> line(static_cast<size_t>(columns.back() + 3 - first));
  for (int j = 0; j < block.rows; ++j) {
    const double v = std::clamp(ToPost(0.0, block.y + j * block.spacing).y(), 0.0,
                                static_cast<double>(grid_.rows - 1));
    const int row = static_cast<int>(v);
    for (size_t k = 0; k < line.size(); ++k) {
      const int column = first + static_cast<int>(k);
      line[k] = Cubic(Clamped(column, row - 1), Clamped(column, row), Clamped(column, row + 1),
                      Clamped(column, row + 2), v - row);
    }
    for (size_t i = 0; i < columns.size(); ++i) {
      const double* const at = &line[static_cast<size_t>(columns[i] - first)];
      *heights++ += Cubic(at[-1], at[0], at[1], at[2], fractions[i]);
    }
  }
}

bool Dem::HasData(double x, double y, double margin) const {
  const Eigen::Vector2d low = ToPost(x - margin, y + margin);
  const Eigen::Vector2d high = ToPost(x + margin, y - margin);
  if (low.x() < 0.0 || low.y() < 0.0) return false;
  if (high.x() > grid_.columns - 1 || high.y() > grid_.rows - 1) return false;
  for (int row = static_cast<int>(low.y()); row <= static_cast<int>(std::ceil(high.y())); ++row) {
    for (int column = static_cast<int>(low.x()); column <= static_cast<int>(std::ceil(high.x()));
         ++column) {
      if (filled_[static_cast<size_t>(row) * static_cast<size_t>(grid_.columns) +
                  static_cast<size_t>(column)] != 0) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/relief_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

// m², of a cell's height at best: range noise and what lies between the points.
constexpr double kLeastVariance = 4e-4;

// The search looks at about this many cells of the query.
constexpr size_t kSearchCells = 800;
constexpr double kVarianceOfOne = 2.5e-3;  // m²
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// One way of laying the query over the target.
struct Hypothesis {
  float dx = 0.0F;   ///< m
  float dy = 0.0F;   ///< m
  float yaw = 0.0F;  ///< rad
  float agreement = -1.0F;
  float height = 0.0F;
  int cells = 0;
};

/// Weighted sums over the cells in common, from which planes can be taken off both heights.
struct Sums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  double a = 0, ax = 0, ay = 0, b = 0, bx = 0, by = 0;
  double aa = 0, bb = 0, ab = 0;

  int cells = 0;

  void Add(const ReliefImage::Cell& cell, double pa, const ReliefImage::Height& height) {
    const double w = kLeastVariance / (kLeastVariance + cell.variance + height.variance);
    const double px = cell.x;
    const double py = cell.y;
    const double pb = height.z;
    ++cells;
    n += w;
    x += w * px;
    y += w * py;
    xx += w * px * px;
    xy += w * px * py;
    yy += w * py * py;
    a += w * pa;
    ax += w * pa * px;
    ay += w * pa * py;
    b += w * pb;
    bx += w * pb * px;
    by += w * pb * py;
    aa += w * pa * pa;
    bb += w * pb * pb;
    ab += w * pa * pb;
  }

  double Agreement() const {
    Eigen::Matrix3d plane;
    plane << n, x, y, x, xx, xy, y, xy, yy;
    const Eigen::Vector3d first(a, ax, ay);
    const Eigen::Vector3d second(b, bx, by);
    const Eigen::Matrix3d inverse = plane.inverse();
    if (!inverse.allFinite()) return -1.0;
    const double spread = aa - first.dot(inverse * first) + bb - second.dot(inverse * second);
    const double common = ab - first.dot(inverse * second);
    return spread > 0.0 ? 2.0 * common / spread : -1.0;
  }
};

struct SE3f {
  explicit SE3f(const SE3& transform)
      : rotation(transform.rotation.toRotationMatrix().cast<float>()),
        position(transform.translation.cast<float>()) {}
  Eigen::Matrix3f rotation;
  Eigen::Vector3f position;
};

/// The best agreement within half a step of a hypothesis, by interpolation.
double CloseLook(Span<const ReliefImage::Cell> query, const ReliefImage& target,
                 const Eigen::Vector2d& centre, const Hypothesis& hypothesis,
                 const ReliefMatchOptions& relief) {
  double best = -1.0;
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      const double x = centre.x() + hypothesis.dx + 0.4 * relief.cell_size * column;
      const double y = centre.y() + hypothesis.dy + 0.4 * relief.cell_size * row;
      const SE3 pose(ExpSo3({0.0, 0.0, hypothesis.yaw}), {x, y, hypothesis.height});
      best = std::max(best, AgreementAt(query, target, pose, relief.min_cells));
    }
  }
  return best;
}

std::vector<Hypothesis> HypothesesOf(const ReliefSearch& search, const ReliefMatchOptions& relief) {
  const int steps = static_cast<int>(std::ceil(search.radius / relief.cell_size));
  const int turns = static_cast<int>(std::ceil(search.yaw_radius / relief.yaw_step));
  std::vector<Hypothesis> hypotheses;
  for (int turn = -turns; turn <= turns; ++turn) {
    for (int row = -steps; row <= steps; ++row) {
      for (int column = -steps; column <= steps; ++column) {
        Hypothesis hypothesis;
        hypothesis.dx = static_cast<float>(column * relief.cell_size);
        hypothesis.dy = static_cast<float>(row * relief.cell_size);
        hypothesis.yaw = static_cast<float>(turn * relief.yaw_step);
        hypotheses.push_back(hypothesis);
      }
    }
  }
  return hypotheses;
}

void Evaluate(Span<const ReliefImage::Cell> query, const ReliefImage& target,
              const Eigen::Vector2d& centre, size_t stride, int min_cells, Hypothesis* hypothesis) {
  const float cosine = std::cos(hypothesis->yaw);
  const float sine = std::sin(hypothesis->yaw);
  const float x0 = static_cast<float>(centre.x()) + hypothesis->dx;
  const float y0 = static_cast<float>(centre.y()) + hypothesis->dy;
  Sums sums;
  for (size_t i = 0; i < query.size(); i += stride) {
    const ReliefImage::Cell& cell = query[i];
    const ReliefImage::Height height =
        target.At(x0 + cosine * cell.x - sine * cell.y, y0 + sine * cell.x + cosine * cell.y);
    if (!std::isnan(height.z)) sums.Add(cell, cell.z, height);
  }
  hypothesis->cells = sums.cells * static_cast<int>(stride);
  if (hypothesis->cells < min_cells) return;
  hypothesis->agreement = static_cast<float>(sums.Agreement());
  hypothesis->height = static_cast<float>((sums.b - sums.a) / sums.n);
}

}  // namespace

ReliefImage::ReliefImage(Span<const Eigen::Vector3d> points_level,
                         const ReliefMatchOptions& options)
    : inverse_size_(static_cast<float>(1.0 / options.cell_size)),
      half_(static_cast<int>(std::ceil(options.radius / options.cell_size))),
      width_(2 * half_ + 1),
      heights_(static_cast<size_t>(width_) * static_cast<size_t>(width_),
               Height{kNothing, kNothing}) {
  struct Sum {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double squared_height = 0.0;
    int count = 0;
  };
  std::vector<Sum> sums(heights_.size());
  for (const Eigen::Vector3d& point : points_level) {
    if (point.head<2>().norm() > options.radius) continue;
    const int column = static_cast<int>(std::lround(point.x() / options.cell_size)) + half_;
    const int row = static_cast<int>(std::lround(point.y() / options.cell_size)) + half_;
    Sum& sum = sums[static_cast<size_t>(row * width_ + column)];
    sum.position += point;
    sum.squared_height += point.z() * point.z();
    ++sum.count;
  }
  for (size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].count == 0) continue;
    const Eigen::Vector3d mean = sums[i].position / sums[i].count;
    // Of a single point nothing is known but that it may be a rock's.
    const double variance =
        sums[i].count == 1
            ? kVarianceOfOne
            : std::max(sums[i].squared_height / sums[i].count - mean.z() * mean.z(), 0.0);
    heights_[i] = {static_cast<float>(mean.z()), static_cast<float>(variance)};
    cells_.push_back({static_cast<float>(mean.x()), static_cast<float>(mean.y()), heights_[i].z,
                      heights_[i].variance});
  }
}

ReliefImage::Height ReliefImage::At(float x, float y) const {
  const int column = static_cast<int>(std::lrintf(x * inverse_size_)) + half_;
  const int row = static_cast<int>(std::lrintf(y * inverse_size_)) + half_;
  if (column < 0 || row < 0 || column >= width_ || row >= width_) return {kNothing, kNothing};
  return heights_[static_cast<size_t>(row * width_ + column)];
}

ReliefImage::Height ReliefImage::Between(float x, float y) const {
  const float column = x * inverse_size_ + static_cast<float>(half_);
  const float row = y * inverse_size_ + static_cast<float>(half_);
  const int left = static_cast<int>(std::floor(column));
  const int lower = static_cast<int>(std::floor(row));
  if (left < 0 || lower < 0 || left + 1 >= width_ || lower + 1 >= width_) {
    return {kNothing, kNothing};
  }
  const Height* corner = heights_.data() + lower * width_ + left;
  const float right = column - static_cast<float>(left);
  const float upper = row - static_cast<float>(lower);
  const auto mix = [&](float a, float b, float c, float d) {
    return (1.0F - upper) * ((1.0F - right) * a + right * b) +
           upper * ((1.0F - right) * c + right * d);
  };
  return {mix(corner[0].z, corner[1].z, corner[width_].z, corner[width_ + 1].z),
          mix(corner[0].variance, corner[1].variance, corner[width_].variance,
              corner[width_ + 1].variance)};
}

ReliefMatch MatchRelief(Span<const ReliefImage::Cell> query_cells, const ReliefImage& target,
                        const ReliefSearch& search, const LoopVerifierOptions& options,
                        ThreadPool* threads) {
  const int min_cells = std::max(
      options.relief.min_cells,
      static_cast<int>(options.relief.min_overlap *
                       static_cast<double>(std::min(query_cells.size(), target.cells().size()))));
  std::vector<Hypothesis> hypotheses = HypothesesOf(search, options.relief);
  const size_t stride = query_cells.size() / kSearchCells + 1;
  threads->ParallelFor(hypotheses.size(), 64, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      Evaluate(query_cells, target, search.centre, stride, min_cells, &hypotheses[i]);
    }
  });
  const auto worse = [](const Hypothesis& a, const Hypothesis& b) {
    return a.agreement < b.agreement;
  };
  const Hypothesis best = *std::max_element(hypotheses.begin(), hypotheses.end(), worse);
  ReliefMatch match;
  match.found = best.cells >= min_cells && best.agreement > -1.0F;
  match.offset = {best.dx, best.dy};
  match.yaw = best.yaw;
  match.height = best.height;
  match.agreement = best.agreement;
  match.cells = best.cells;
  Hypothesis second;
  for (const Hypothesis& other : hypotheses) {
    const bool is_elsewhere =
        std::hypot(other.dx - best.dx, other.dy - best.dy) > options.separation ||
        std::abs(other.yaw - best.yaw) > options.yaw_separation;
    if (is_elsewhere && other.agreement > second.agreement) second = other;
  }
  if (second.agreement > -1.0F) {
    match.runner_up = std::max<double>(
        second.agreement, CloseLook(query_cells, target, search.centre, second, options.relief));
  }
  return match;
}

double AgreementAt(Span<const ReliefImage::Cell> query_cells, const ReliefImage& target,
                   const SE3& T_target_query, int min_cells) {
  const SE3f T(T_target_query);
  Sums sums;
  for (const ReliefImage::Cell& cell : query_cells) {
    const Eigen::Vector3f placed =
        T.rotation * Eigen::Vector3f(cell.x, cell.y, cell.z) + T.position;
    const ReliefImage::Height height = target.Between(placed.x(), placed.y());
    if (!std::isnan(height.z)) sums.Add(cell, placed.z(), height);
  }
  return sums.cells < min_cells ? -1.0 : sums.Agreement();
}

}  // namespace regolith

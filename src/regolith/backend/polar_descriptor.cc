// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/polar_descriptor.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Cholesky>

namespace regolith {
namespace {

// Nearer than the lowest beam on level ground nothing is seen but by chance.
constexpr double kInnerRadius = 3.0;  // m
constexpr int kLeastCells = 5;        // of a ring

/// The least-squares plane z = p · (1, x, y).
Eigen::Vector3d PlaneOf(Span<const ReliefImage::Cell> cells) {
  Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const ReliefImage::Cell& cell : cells) {
    const Eigen::Vector3d row(1.0, cell.x, cell.y);
    normal += row * row.transpose();
    right += cell.z * row;
  }
  return normal.ldlt().solve(right);
}

}  // namespace

PolarDescriptor DescribeRelief(Span<const ReliefImage::Cell> cells, double radius) {
  constexpr int kOrders = PolarDescriptor::kOrders;
  std::array<std::complex<double>, PolarDescriptor::kRings * kOrders> sums{};
  std::array<int, PolarDescriptor::kRings> counts{};
  const Eigen::Vector3d plane = PlaneOf(cells);
  for (const ReliefImage::Cell& cell : cells) {
    const double range = std::hypot(cell.x, cell.y);
    const double place = (range - kInnerRadius) / (radius - kInnerRadius);
    if (place < 0.0 || place >= 1.0) continue;
    const auto ring = static_cast<size_t>(place * PolarDescriptor::kRings);
    const double height = cell.z - plane.dot(Eigen::Vector3d(1.0, cell.x, cell.y));
    const double azimuth = std::atan2(cell.y, cell.x);
    for (int order = 0; order < kOrders; ++order) {
      sums[ring * kOrders + static_cast<size_t>(order)] +=
          std::polar(1.0, -order * azimuth) * height;
    }
    ++counts[ring];
  }
  PolarDescriptor descriptor;
  for (size_t i = 0; i < sums.size(); ++i) {
    const int count = counts[i / kOrders];
    if (count < kLeastCells) continue;
    const std::complex<double> mean = sums[i] / static_cast<double>(count);
    descriptor.amplitudes[i] = static_cast<float>(i % kOrders == 0 ? mean.real() : std::abs(mean));
  }
  return descriptor;
}

double PolarDistance(const PolarDescriptor& first, const PolarDescriptor& second) {
  double difference = 0.0;
  double size = 0.0;
  for (size_t i = 0; i < first.amplitudes.size(); ++i) {
    const double a = first.amplitudes[i];
    const double b = second.amplitudes[i];
    difference += (a - b) * (a - b);
    size += a * a + b * b;
  }
  return size > 0.0 ? std::sqrt(2.0 * difference / size) : 0.0;
}

}  // namespace regolith

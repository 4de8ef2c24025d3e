// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/check.h"

namespace regolith {

/// The pieces of the uniform B-spline basis of `kDegree` at fraction u of an interval, in [0, 1)
/// (de Boor 1972): entry j weighs the j-th of the kDegree + 1 control points in reach.
template <int kDegree>
std::array<double, kDegree + 1> UniformBasis(double u) {
  std::array<double, kDegree + 1> basis{};
  basis[0] = 1.0;
  for (int k = 1; k <= kDegree; ++k) {
    for (int j = k; j >= 0; --j) {
      const auto i = static_cast<size_t>(j);
      const double left = j > 0 ? basis[i - 1] : 0.0;
      const double right = j < k ? basis[i] : 0.0;
      basis[i] = ((u + (k - j)) * left + (1.0 - u + j) * right) / k;
    }
  }
  return basis;
}

/// A quintic B-spline in R^kSize, four times continuously differentiable. Control point i has its
/// weight about time i · interval; before the first and after the last one they repeat.
template <int kSize>
class UniformSpline {
 public:
  using Vector = Eigen::Matrix<double, kSize, 1>;

  struct Value {
    Vector value;
    Vector first;   ///< derivative by time, 1/s
    Vector second;  ///< 1/s²
  };

  UniformSpline() = default;
  UniformSpline(std::vector<Vector> controls, double interval)
      : controls_(std::move(controls)), interval_(interval) {
    REGOLITH_CHECK(!controls_.empty() && interval > 0.0, controls_.size(), " controls");
  }

  /// Adds a control point behind the last one. What is before `settled()` stays as it is.
  void Append(const Vector& control) { controls_.push_back(control); }
  /// Time (s) up to which more control points change nothing.
  double settled() const { return (static_cast<double>(controls_.size()) - 3.0) * interval_; }

  /// `time` in s.
  Value At(double time) const {
    const double position = time / interval_;
    const double index = std::floor(position);
    const double u = position - index;
    std::array<Vector, 6> points;
    for (int j = 0; j < 6; ++j) {
      points[static_cast<size_t>(j)] = Control(static_cast<int>(index) - 2 + j);
    }
    Value result;
    result.value = Weighted(UniformBasis<5>(u), points);
    std::array<Vector, 5> differences;
    for (size_t j = 0; j < 5; ++j) differences[j] = (points[j + 1] - points[j]) / interval_;
    result.first = Weighted(UniformBasis<4>(u), differences);
    std::array<Vector, 4> seconds;
    for (size_t j = 0; j < 4; ++j) {
      seconds[j] = (differences[j + 1] - differences[j]) / interval_;
    }
    result.second = Weighted(UniformBasis<3>(u), seconds);
    return result;
  }

 private:
  const Vector& Control(int index) const {
    return controls_[static_cast<size_t>(
        std::clamp(index, 0, static_cast<int>(controls_.size()) - 1))];
  }

  template <size_t kCount>
  static Vector Weighted(const std::array<double, kCount>& weights,
                         const std::array<Vector, kCount>& points) {
    // From the first point on, so that equal points give exactly their value: rest is rest.
    Vector sum = points[0];
    for (size_t j = 1; j < kCount; ++j) sum += weights[j] * (points[j] - points[0]);
    return sum;
  }

  std::vector<Vector> controls_;
  double interval_ = 1.0;
};

}  // namespace regolith

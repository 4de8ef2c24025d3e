// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/slope_statistics.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/core/median.h"
#include "regolith/core/random.h"

namespace regolith {
std::vector<double> HeightDifferences(const HeightFunction& height, const Eigen::AlignedBox2d& box,
                                      double distance, int samples) {
  REGOLITH_CHECK(samples > 0 && distance > 0.0, samples, " samples over ", distance, " m");
  Random random(1, "slope statistics");
  std::vector<double> differences;
  differences.reserve(static_cast<size_t>(samples));
  for (int i = 0; i < samples; ++i) {
    const double x = random.Uniform(box.min().x(), box.max().x());
    const double y = random.Uniform(box.min().y(), box.max().y());
    const double angle = random.Uniform(0.0, 2.0 * M_PI);
    differences.push_back(height(x + distance * std::cos(angle), y + distance * std::sin(angle)) -
                          height(x, y));
  }
  return differences;
}

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double MedianMagnitude(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return Median(std::move(values));
}

double RobustSigma(std::vector<double> values) {
  constexpr double kSigmaPerMedian = 1.4826;
  return values.empty() ? 0.0 : kSigmaPerMedian * MedianMagnitude(std::move(values));
}

double RmsDeviation(const HeightFunction& height, const Eigen::AlignedBox2d& box, double distance,
                    int samples) {
  return RootMeanSquare(HeightDifferences(height, box, distance, samples));
}

double MedianSlope(const HeightFunction& height, const Eigen::AlignedBox2d& box, double distance,
                   int samples) {
  return std::atan(MedianMagnitude(HeightDifferences(height, box, distance, samples)) / distance);
}

double HurstExponent(const HeightFunction& height, const Eigen::AlignedBox2d& box, double shorter,
                     double longer, int samples) {
  return std::log(RmsDeviation(height, box, longer, samples) /
                  RmsDeviation(height, box, shorter, samples)) /
         std::log(longer / shorter);
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/slope_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

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

}  // namespace

double RmsDeviation(const HeightFunction& height, const Eigen::AlignedBox2d& box, double distance,
                    int samples) {
  double sum = 0.0;
  for (const double difference : HeightDifferences(height, box, distance, samples)) {
    sum += difference * difference;
  }
  return std::sqrt(sum / samples);
}

double MedianSlope(const HeightFunction& height, const Eigen::AlignedBox2d& box, double distance,
                   int samples) {
  std::vector<double> differences = HeightDifferences(height, box, distance, samples);
  for (double& difference : differences) difference = std::abs(difference);
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return std::atan(*middle / distance);
}

double HurstExponent(const HeightFunction& height, const Eigen::AlignedBox2d& box, double shorter,
                     double longer, int samples) {
  return std::log(RmsDeviation(height, box, longer, samples) /
                  RmsDeviation(height, box, shorter, samples)) /
         std::log(longer / shorter);
}

}  // namespace regolith

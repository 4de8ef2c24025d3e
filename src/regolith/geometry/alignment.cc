// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/alignment.h"

#include <limits>

#include <Eigen/SVD>

#include "regolith/core/check.h"

namespace regolith {
namespace {

Eigen::Vector3d Mean(Span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<Alignment> AlignPoints(Span<const Eigen::Vector3d> source,
                                     Span<const Eigen::Vector3d> target, bool with_scale) {
  REGOLITH_CHECK(source.size() == target.size(), source.size(), " and ", target.size(), " points");
  if (source.size() < 3) return std::nullopt;
  const Eigen::Vector3d source_mean = Mean(source);
  const Eigen::Vector3d target_mean = Mean(target);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double source_variance = 0.0;
  for (size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d centred = source[i] - source_mean;
    covariance += (target[i] - target_mean) * centred.transpose();
    source_variance += centred.squaredNorm();
  }
  covariance /= static_cast<double>(source.size());
  source_variance /= static_cast<double>(source.size());

  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& singular = svd.singularValues();
  // Rank two is enough for a rotation; below it the points lie on one line.
  if (!(singular[1] > singular[0] * 10.0 * std::numeric_limits<double>::epsilon())) {
    return std::nullopt;
  }
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;

  Alignment alignment;
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  if (with_scale) alignment.scale = singular.dot(signs) / source_variance;
  alignment.T_target_source.rotation = Eigen::Quaterniond(rotation).normalized();
  alignment.T_target_source.translation =
      (target_mean - alignment.scale * (rotation * source_mean)) / alignment.scale;
  return alignment;
}

}  // namespace regolith

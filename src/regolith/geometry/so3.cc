// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/so3.h"

#include <cmath>

namespace regolith {
namespace {

// Below this angle (rad) the closed forms lose more digits than the series leaves out.
constexpr double kSmallAngle = 1e-4;

}  // namespace

Eigen::Matrix3d Hat(const Eigen::Vector3d& vector) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -vector.z(), vector.y(), vector.z(), 0.0, -vector.x(), -vector.y(), vector.x(),
      0.0;
  return matrix;
}

Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const double half = 0.5 * angle;
  const double scale = angle < kSmallAngle ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
  Eigen::Quaterniond rotation(std::cos(half), scale * rotation_vector.x(),
                              scale * rotation_vector.y(), scale * rotation_vector.z());
  rotation.normalize();
  return rotation;
}

Eigen::Vector3d LogSo3(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const double sine = rotation.vec().norm();
  const double cosine = sign * rotation.w();
  const double scale =
      sine < kSmallAngle ? 2.0 + sine * sine / 3.0 : 2.0 * std::atan2(sine, cosine) / sine;
  return sign * scale * rotation.vec();
}

Eigen::Matrix3d RightJacobianSo3(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Eigen::Matrix3d hat = Hat(rotation_vector);
  const double square = angle * angle;
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() - 0.5 * hat + hat * hat / 6.0;
  return Eigen::Matrix3d::Identity() - (1.0 - std::cos(angle)) / square * hat +
         (angle - std::sin(angle)) / (square * angle) * hat * hat;
}

Eigen::Matrix3d RightJacobianInverseSo3(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Eigen::Matrix3d hat = Hat(rotation_vector);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * hat + hat * hat / 12.0;
  const double factor =
      1.0 / (angle * angle) - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  return Eigen::Matrix3d::Identity() + 0.5 * hat + factor * hat * hat;
}

double AngleBetween(const Eigen::Quaterniond& first, const Eigen::Quaterniond& second) {
  return LogSo3(first.conjugate() * second).norm();
}

double AngleBetween(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace regolith

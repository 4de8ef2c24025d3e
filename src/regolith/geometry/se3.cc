// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/se3.h"

#include <cmath>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

// The block Q of the left Jacobian (Barfoot & Furgale 2014, eq. 102; Solà et al. 2018, eq. 180).
Eigen::Matrix3d LeftJacobianCoupling(const Eigen::Vector3d& rotation_vector,
                                     const Eigen::Vector3d& position) {
  const Eigen::Matrix3d phi = Hat(rotation_vector);
  const Eigen::Matrix3d rho = Hat(position);
  const double angle = rotation_vector.norm();
  const double square = angle * angle;
  double first = 1.0 / 6.0;
  double second = 1.0 / 24.0;
  double third = -1.0 / 120.0;
  if (angle > 0.02) {
    const double sine = std::sin(angle);
    const double cosine = std::cos(angle);
    first = (angle - sine) / (square * angle);
    second = (0.5 * square + cosine - 1.0) / (square * square);
    third = (angle - sine - square * angle / 6.0) / (square * square * angle);
  } else {
    first -= square / 120.0;
    second -= square / 720.0;
    third += square / 5040.0;
  }
  const Eigen::Matrix3d phi_rho = phi * rho;
  const Eigen::Matrix3d phi_rho_phi = phi_rho * phi;
  return 0.5 * rho + first * (phi_rho + rho * phi + phi_rho_phi) +
         second * (phi * phi_rho + rho * phi * phi - 3.0 * phi_rho_phi) -
         0.5 * (-second - 3.0 * third) * (phi_rho_phi * phi + phi * phi_rho_phi);
}

Eigen::Matrix3d LeftJacobianSo3(const Eigen::Vector3d& rotation_vector) {
  return RightJacobianSo3(-rotation_vector);
}

}  // namespace

SE3 SE3::FromMatrix(const Eigen::Matrix4d& matrix) {
  SE3 transform(Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())),
                matrix.topRightCorner<3, 1>());
  transform.rotation.normalize();
  return transform;
}

Eigen::Matrix4d SE3::Matrix() const {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = translation;
  return matrix;
}

SE3 SE3::Inverse() const {
  const Eigen::Quaterniond inverse = rotation.conjugate();
  return {inverse, -(inverse * translation)};
}

SE3 SE3::operator*(const SE3& other) const {
  SE3 product(rotation * other.rotation, rotation * other.translation + translation);
  product.rotation.normalize();
  return product;
}

SE3 ExpSe3(const Vector6d& tangent) {
  const Eigen::Vector3d rotation_vector = tangent.head<3>();
  return {ExpSo3(rotation_vector), LeftJacobianSo3(rotation_vector) * tangent.tail<3>()};
}

Vector6d LogSe3(const SE3& transform) {
  Vector6d tangent;
  const Eigen::Vector3d rotation_vector = LogSo3(transform.rotation);
  tangent << rotation_vector, RightJacobianInverseSo3(-rotation_vector) * transform.translation;
  return tangent;
}

Matrix6d AdjointSe3(const SE3& transform) {
  const Eigen::Matrix3d rotation = transform.rotation.toRotationMatrix();
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = rotation;
  adjoint.bottomRightCorner<3, 3>() = rotation;
  adjoint.bottomLeftCorner<3, 3>() = Hat(transform.translation) * rotation;
  return adjoint;
}

Matrix6d RightJacobianSe3(const Vector6d& tangent) {
  // J_r(τ) = J_l(-τ).
  const Eigen::Vector3d rotation_vector = -tangent.head<3>();
  const Eigen::Matrix3d diagonal = LeftJacobianSo3(rotation_vector);
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topLeftCorner<3, 3>() = diagonal;
  jacobian.bottomRightCorner<3, 3>() = diagonal;
  jacobian.bottomLeftCorner<3, 3>() = LeftJacobianCoupling(rotation_vector, -tangent.tail<3>());
  return jacobian;
}

Matrix6d RightJacobianInverseSe3(const Vector6d& tangent) {
  const Eigen::Vector3d rotation_vector = -tangent.head<3>();
  const Eigen::Matrix3d diagonal = RightJacobianInverseSo3(-rotation_vector);
  Matrix6d inverse = Matrix6d::Zero();
  inverse.topLeftCorner<3, 3>() = diagonal;
  inverse.bottomRightCorner<3, 3>() = diagonal;
  inverse.bottomLeftCorner<3, 3>() =
      -diagonal * LeftJacobianCoupling(rotation_vector, -tangent.tail<3>()) * diagonal;
  return inverse;
}

SE3 Plus(const SE3& transform, const Vector6d& tangent) {
  SE3 moved(transform.rotation * ExpSo3(tangent.head<3>()),
            transform.translation + tangent.tail<3>());
  moved.rotation.normalize();
  return moved;
}

Vector6d Minus(const SE3& to, const SE3& from) {
  Vector6d tangent;
  tangent << LogSo3(from.rotation.conjugate() * to.rotation), to.translation - from.translation;
  return tangent;
}

SE3 Interpolate(const SE3& from, const SE3& to, double fraction) {
  return {from.rotation.slerp(fraction, to.rotation),
          from.translation + fraction * (to.translation - from.translation)};
}

}  // namespace regolith

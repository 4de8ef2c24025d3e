// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/relative_pose.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace regolith {
namespace {

constexpr int kIterations = 6;  // of each start, and again of the best
// Of the weights, in thresholds: wide enough for a rough pose to get from, then no wider than the
// noise.
constexpr double kFirstWidth = 2.0;
constexpr double kLastWidth = 0.75;

using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Vector5d = Eigen::Matrix<double, 5, 1>;

std::vector<uint8_t> Agree(const RotatedBearings& bearings, const RelativePose& pose,
                           double threshold) {
  RotatedBearings rotated = bearings;
  for (Eigen::Vector3d& first : rotated.first) first = pose.R_second_first * first;
  return AgreeWithTranslation(rotated, pose.direction, threshold);
}

/// A match under a pose: how far the second bearing is from the epipolar plane of the first.
struct Residual {
  Eigen::Vector3d first;  ///< in the second camera's frame
  Eigen::Vector3d plane;  ///< first x second
  double sine = 1.0;      ///< of the angle between first and t
  double value = 0.0;     ///< about rad

  Residual(const RelativePose& pose, const Eigen::Vector3d& bearing_first,
           const Eigen::Vector3d& bearing_second)
      : first(pose.R_second_first * bearing_first), plane(first.cross(bearing_second)) {
    const double along = first.dot(pose.direction);
    // Epipolar planes turn fast near the epipole.
    sine = std::sqrt(std::max(1.0 - along * along, 1e-6));
    value = plane.dot(pose.direction) / sine;
  }
};

/// Sum of Geman and McClure's losses, each below 1.
double Cost(const RotatedBearings& bearings, const RelativePose& pose, double width) {
  double cost = 0.0;
  for (size_t i = 0; i < bearings.first.size(); ++i) {
    const double relative = Residual(pose, bearings.first[i], bearings.second[i]).value / width;
    cost += relative * relative / (1.0 + relative * relative);
  }
  return cost;
}

/// One step of Gauss-Newton. Rotation moves by R <- exp(w) R, direction in its tangent plane.
RelativePose Step(const RotatedBearings& bearings, const RelativePose& pose, double width) {
  const Eigen::Vector3d& t = pose.direction;
  Eigen::Matrix<double, 3, 2> tangent;
  tangent.col(0) = t.unitOrthogonal();
  tangent.col(1) = t.cross(tangent.col(0));
  Matrix5d normal = Matrix5d::Zero();
  Vector5d right = Vector5d::Zero();
  for (size_t i = 0; i < bearings.first.size(); ++i) {
    const Residual residual(pose, bearings.first[i], bearings.second[i]);
    const double relative = residual.value / width;
    const double root_weight = 1.0 / (1.0 + relative * relative);
    Vector5d jacobian;
    jacobian << residual.first.cross(bearings.second[i].cross(t)),
        tangent.transpose() * residual.plane;
    jacobian *= root_weight / residual.sine;
    normal.noalias() += jacobian * jacobian.transpose();
    right -= jacobian * (root_weight * residual.value);
  }
  // Without parallax nothing is known of the direction; then it stays.
  normal.diagonal().array() += 1e-9 * normal.trace() + 1e-12;
  const Vector5d step = normal.ldlt().solve(right);
  RelativePose next = pose;
  const double angle = step.head<3>().norm();
  if (angle > 0.0) {
    next.R_second_first =
        Eigen::AngleAxisd(angle, step.head<3>() / angle).toRotationMatrix() * pose.R_second_first;
  }
  next.direction = (t + tangent * step.tail<2>()).normalized();
  return next;
}

}  // namespace

RelativePose PoseOfEssential(const RotatedBearings& bearings, const Eigen::Matrix3d& E_second_first,
                             double threshold) {
  // Hartley and Zisserman 2004, 9.6.2.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(E_second_first,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d quarter_turn;
  quarter_turn << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  RelativePose best;
  std::ptrdiff_t best_count = -1;
  for (const Eigen::Matrix3d& turn : {quarter_turn, Eigen::Matrix3d(quarter_turn.transpose())}) {
    RelativePose pose;
    pose.R_second_first = svd.matrixU() * turn * svd.matrixV().transpose();
    if (pose.R_second_first.determinant() < 0.0) pose.R_second_first = -pose.R_second_first;
    pose.direction = svd.matrixU().col(2);
    // Widely: the matrix is not yet refined.
    const std::vector<uint8_t> agree = Agree(bearings, pose, 3.0 * threshold);
    const auto count = std::count(agree.begin(), agree.end(), uint8_t{1});
    if (count <= best_count) continue;
    best = pose;
    best_count = count;
  }
  return best;
}

RelativePose RefineRelativePose(const RotatedBearings& bearings, const RelativePose& initial,
                                double threshold) {
  // What the rough pose is far from is left out, which halves the work where half are outliers.
  const std::vector<uint8_t> near = Agree(bearings, initial, 4.0 * threshold);
  RotatedBearings likely;
  for (size_t i = 0; i < near.size(); ++i) {
    if (!near[i]) continue;
    likely.first.push_back(bearings.first[i]);
    likely.second.push_back(bearings.second[i]);
  }
  // Turning left looks much like driving right, and for little parallax the rough pose is often in
  // the valley of the wrong one: all three axes are tried beside it.
  RelativePose best = initial;
  double best_cost = Cost(likely, initial, threshold);
  for (int start = -1; start < 3; ++start) {
    RelativePose pose = initial;
    if (start >= 0) pose.direction = Eigen::Vector3d::Unit(start);
    for (int i = 0; i < kIterations; ++i) pose = Step(likely, pose, kFirstWidth * threshold);
    const double cost = Cost(likely, pose, threshold);
    if (cost >= best_cost) continue;
    best = pose;
    best_cost = cost;
  }
  RelativePose pose = best;
  for (int i = 0; i < kIterations; ++i) pose = Step(likely, pose, kLastWidth * threshold);
  return Cost(likely, pose, threshold) < best_cost ? pose : best;
}

}  // namespace regolith

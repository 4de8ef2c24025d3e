// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/motion_initialization.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "regolith/core/median.h"
#include "regolith/geometry/so3.h"
#include "regolith/imu/preintegration.h"
#include "regolith/imu/propagation.h"
#include "regolith/imu/rest_detection.h"

namespace regolith {
namespace {

constexpr size_t kMinShared = 12;  // tracks of two frames
constexpr size_t kMinLandmarks = 15;
constexpr double kMaxError = 0.02;     // rad, median
constexpr double kMinParallax = 0.02;  // rad, median
constexpr double kMaxSpeed = 20.0;     // m/s
/// What little is known of the speed at both ends of the window, against errors of bearings: where
/// bearings change little, it keeps landmarks from being far and fast.
constexpr double kSpeedSigma = 2.0;      // m/s, an axis
constexpr double kBearingSigma = 0.002;  // rad

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix6x3 = Eigen::Matrix<double, 6, 3>;

ImuPreintegration MotionBetween(Span<const ImuSample> samples, TimeNs start, TimeNs end,
                                const Eigen::Vector3d& gyro_bias) {
  ImuPreintegration motion(ImuNoise(), gyro_bias, Eigen::Vector3d::Zero());
  motion.Integrate(SamplesBetween(samples, start, end));
  return motion;
}

/// Tracks of two frames, each in its camera.
struct SharedBearings {
  std::vector<Eigen::Vector3d> first;
  std::vector<Eigen::Vector3d> second;
};

SharedBearings Shared(const BearingFrame& first, const BearingFrame& second) {
  SharedBearings shared;
  size_t j = 0;
  for (const auto& [id, bearing] : first.bearings) {
    while (j < second.bearings.size() && second.bearings[j].first < id) ++j;
    if (j == second.bearings.size()) break;
    if (second.bearings[j].first != id) continue;
    shared.first.push_back(bearing);
    shared.second.push_back(second.bearings[j].second);
  }
  return shared;
}

/// Two frames, the tracks that both see (bearings in the IMU's frame), and the turn between them
/// with its derivative by the gyro's bias.
struct TurnedPair {
  SharedBearings shared;
  Eigen::Quaterniond R_first_second;
  Eigen::Matrix3d by_gyro_bias;

  /// Mean square distance of the epipolar normals from the plane that fits them best.
  double Error(const Eigen::Vector3d& gyro_bias) const {
    const Eigen::Quaterniond R = R_first_second * ExpSo3(by_gyro_bias * gyro_bias);
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    for (size_t i = 0; i < shared.first.size(); ++i) {
      const Eigen::Vector3d normal = shared.first[i].cross(R * shared.second[i]);
      // A normal's error does not depend on its length; beyond a degree it counts less.
      normals += normal * normal.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        normals / static_cast<double>(shared.first.size()), Eigen::EigenvaluesOnly);
    return std::max(solver.eigenvalues()[0], 0.0);
  }
};

std::vector<TurnedPair> MakePairs(Span<const BearingFrame> frames, Span<const ImuSample> samples,
                                  const SE3& T_imu_camera) {
  std::vector<TurnedPair> pairs;
  for (size_t i = 0; i < frames.size(); ++i) {
    for (const size_t step : {2, 5}) {
      if (i + step >= frames.size()) continue;
      TurnedPair pair{Shared(frames[i], frames[i + step]), {}, {}};
      if (pair.shared.first.size() < kMinShared) continue;
      for (auto* bearings : {&pair.shared.first, &pair.shared.second}) {
        for (Eigen::Vector3d& bearing : *bearings) bearing = T_imu_camera.rotation * bearing;
      }
      const ImuPreintegration motion =
          MotionBetween(samples, frames[i].time, frames[i + step].time, Eigen::Vector3d::Zero());
      pair.R_first_second = motion.delta_rotation();
      pair.by_gyro_bias = motion.jacobian_gyro_bias().topRows<3>();
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

double SumOfErrors(const std::vector<TurnedPair>& pairs, const Eigen::Vector3d& gyro_bias) {
  double sum = 0.0;
  for (const TurnedPair& pair : pairs) sum += pair.Error(gyro_bias);
  return sum;
}

/// Everything that the closed form needs of one frame, in the first frame's IMU axes.
struct InertialView {
  double time = 0.0;       ///< s since the first frame
  Eigen::Vector3d gained;  ///< velocity, without gravity
  Eigen::Vector3d moved;   ///< camera, without velocity and gravity
  Eigen::Quaterniond R_first_camera;
};

/// One landmark's equations: f - (c + v t + g t²/2) lies along its rays.
struct LandmarkEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 6> coupling = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
};

using Sightings = std::vector<std::pair<size_t, Eigen::Vector3d>>;  // frame, bearing

/// Least squares of velocity and gravity (6) and landmarks, with a weight for each landmark's
/// distance.
class ClosedForm {
 public:
  ClosedForm(std::vector<InertialView> views, std::vector<Sightings> landmarks, double gravity)
      : views_(std::move(views)), landmarks_(std::move(landmarks)), gravity_(gravity) {
    points_.assign(landmarks_.size(), Eigen::Vector3d::Zero());
    distances_.assign(landmarks_.size(), 1.0);
  }

  bool Solve() {
    for (int round = 0; round < 3; ++round) {
      if (!SolveOnce()) return false;
    }
    return true;
  }

  const Vector6d& velocity_and_gravity() const { return solution_; }

  /// Errors (rad) of all bearings, those behind a camera count as errors of π; and the largest
  /// parallax of each landmark, as it was seen: a solution may find some in the noise of a rest.
  void Judge(std::vector<double>* errors, std::vector<double>* parallaxes) const {
    for (size_t i = 0; i < landmarks_.size(); ++i) {
      Eigen::Vector3d first = Eigen::Vector3d::Zero();
      double parallax = 0.0;
      for (const auto& [frame, bearing] : landmarks_[i]) {
        const Eigen::Vector3d ray = views_[frame].R_first_camera * bearing;
        const Eigen::Vector3d seen = (points_[i] - CameraAt(frame)).normalized();
        errors->push_back(AngleBetween(ray, seen));
        if (first.isZero()) first = ray;
        parallax = std::max(parallax, AngleBetween(first, ray));
      }
      parallaxes->push_back(parallax);
    }
  }

 private:
  Eigen::Vector3d CameraAt(size_t frame) const {
    const double t = views_[frame].time;
    return views_[frame].moved + t * solution_.head<3>() + 0.5 * t * t * solution_.tail<3>();
  }

  LandmarkEquations EquationsOf(size_t index) const {
    LandmarkEquations equations;
    const double weight = 1.0 / (distances_[index] * distances_[index]);
    for (const auto& [frame, bearing] : landmarks_[index]) {
      const InertialView& view = views_[frame];
      const Eigen::Vector3d ray = view.R_first_camera * bearing;
      const Eigen::Matrix3d across = weight * (Eigen::Matrix3d::Identity() - ray * ray.transpose());
      equations.information += across;
      equations.coupling.leftCols<3>() -= view.time * across;
      equations.coupling.rightCols<3>() -= 0.5 * view.time * view.time * across;
      equations.right += across * view.moved;
    }
    return equations;
  }

  bool SolveOnce() {
    Matrix6d information = Matrix6d::Zero();
    Vector6d right = Vector6d::Zero();
    for (size_t i = 0; i < landmarks_.size(); ++i) {
      const LandmarkEquations equations = EquationsOf(i);
      const Eigen::LDLT<Eigen::Matrix3d> inverse(equations.information);
      // Terms of velocity and gravity alone: Σ Bᵀ P⁻¹ B over the frames, by the same projections.
      const double weight = 1.0 / (distances_[i] * distances_[i]);
      for (const auto& [frame, bearing] : landmarks_[i]) {
        const InertialView& view = views_[frame];
        const Eigen::Vector3d ray = view.R_first_camera * bearing;
        const Eigen::Matrix3d across =
            weight * (Eigen::Matrix3d::Identity() - ray * ray.transpose());
        Eigen::Matrix<double, 3, 6> by_motion;
        by_motion << view.time * Eigen::Matrix3d::Identity(),
            0.5 * view.time * view.time * Eigen::Matrix3d::Identity();
        information += by_motion.transpose() * across * by_motion;
        right -= by_motion.transpose() * across * view.moved;
      }
      information -= equations.coupling.transpose() * inverse.solve(equations.coupling);
      right -= equations.coupling.transpose() * inverse.solve(equations.right);
    }
    AddSpeedPrior(&information, &right);
    if (!SolveMotion(information, right)) return false;
    for (size_t i = 0; i < landmarks_.size(); ++i) {
      const LandmarkEquations equations = EquationsOf(i);
      points_[i] = Eigen::LDLT<Eigen::Matrix3d>(equations.information)
                       .solve(equations.right - equations.coupling * solution_);
      distances_[i] = std::max((points_[i] - CameraAt(landmarks_[i].front().first)).norm(), 0.1);
    }
    return solution_.allFinite();
  }

  /// The first velocity is v, the last one v + t g + what was gained.
  void AddSpeedPrior(Matrix6d* information, Vector6d* right) const {
    const double weight = kBearingSigma * kBearingSigma / (kSpeedSigma * kSpeedSigma);
    information->topLeftCorner<3, 3>().diagonal().array() += weight;
    Eigen::Matrix<double, 3, 6> by_motion;
    by_motion << Eigen::Matrix3d::Identity(), views_.back().time * Eigen::Matrix3d::Identity();
    *information += weight * by_motion.transpose() * by_motion;
    *right -= weight * by_motion.transpose() * views_.back().gained;
  }

  /// Velocity and gravity with gravity's magnitude: (S + λ I) g = r after the velocity is
  /// eliminated, λ by bisection.
  bool SolveMotion(const Matrix6d& information, const Vector6d& right) {
    const Eigen::LDLT<Eigen::Matrix3d> velocity(information.topLeftCorner<3, 3>());
    const Eigen::Matrix3d gain =
        velocity.solve(Eigen::Matrix3d(information.topRightCorner<3, 3>())).transpose();
    const Eigen::Matrix3d schur =
        information.bottomRightCorner<3, 3>() - gain * information.topRightCorner<3, 3>();
    const Eigen::Vector3d rest = right.tail<3>() - gain * right.head<3>();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(schur);
    const Eigen::Vector3d coordinates = solver.eigenvectors().transpose() * rest;
    const auto length = [&](double lambda) {
      return (coordinates.array() / (solver.eigenvalues().array() + lambda)).matrix().norm();
    };
    double low = -solver.eigenvalues()[0] + 1e-12 * solver.eigenvalues()[2];
    double high = rest.norm() / gravity_ + solver.eigenvalues()[2];
    if (!(length(low) > gravity_) || !(length(high) < gravity_)) return false;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (length(middle) > gravity_ ? low : high) = middle;
    }
    solution_.tail<3>() = solver.eigenvectors() *
                          (coordinates.array() / (solver.eigenvalues().array() + low)).matrix();
    solution_.head<3>() =
        velocity.solve(right.head<3>() - information.topRightCorner<3, 3>() * solution_.tail<3>());
    return solution_.allFinite();
  }

  std::vector<InertialView> views_;
  std::vector<Sightings> landmarks_;
  double gravity_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> distances_;
  Vector6d solution_ = Vector6d::Zero();
};

std::vector<Sightings> LandmarksOf(Span<const BearingFrame> frames) {
  std::map<int64_t, Sightings> tracks;
  for (size_t i = 0; i < frames.size(); ++i) {
    for (const auto& [id, bearing] : frames[i].bearings) tracks[id].emplace_back(i, bearing);
  }
  std::vector<Sightings> landmarks;
  for (auto& [id, sightings] : tracks) {
    if (2 * sightings.size() >= frames.size() && sightings.size() >= 4) {
      landmarks.push_back(std::move(sightings));
    }
  }
  return landmarks;
}

}  // namespace

std::optional<Eigen::Vector3d> EstimateGyroBias(Span<const BearingFrame> frames,
                                                Span<const ImuSample> samples,
                                                const SE3& T_imu_camera) {
  const std::vector<TurnedPair> pairs = MakePairs(frames, samples, T_imu_camera);
  if (pairs.size() < 3) return std::nullopt;
  constexpr double kStep = 1e-3;  // rad/s
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  double error = SumOfErrors(pairs, bias);
  double damping = 1e-3;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::Vector3d gradient;
    Eigen::Matrix3d hessian;
    const auto at = [&](const Eigen::Vector3d& offset) {
      return SumOfErrors(pairs, bias + offset);
    };
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step_i = kStep * Eigen::Vector3d::Unit(i);
      const double forward = at(step_i);
      const double backward = at(-step_i);
      gradient[i] = (forward - backward) / (2.0 * kStep);
      hessian(i, i) = (forward - 2.0 * error + backward) / (kStep * kStep);
      for (int j = 0; j < i; ++j) {
        const Eigen::Vector3d step_j = kStep * Eigen::Vector3d::Unit(j);
        hessian(i, j) = hessian(j, i) = (at(step_i + step_j) - at(step_i - step_j) -
                                         at(step_j - step_i) + at(-step_i - step_j)) /
                                        (4.0 * kStep * kStep);
      }
    }
    Eigen::Matrix3d damped = hessian;
    damped.diagonal().array() += damping * hessian.diagonal().cwiseAbs().maxCoeff();
    const Eigen::Vector3d step = -damped.ldlt().solve(gradient);
    const double next = SumOfErrors(pairs, bias + step);
    if (!std::isfinite(next) || next >= error) {
      if (damping > 1e3) break;
      damping *= 10.0;
      continue;
    }
    bias += step;
    damping = std::max(damping * 0.1, 1e-6);
    error = next;
    if (step.norm() < 1e-6) break;
  }
  return bias;
}

std::optional<MotionStart> InitializeInMotion(Span<const BearingFrame> frames,
                                              Span<const ImuSample> samples,
                                              const SE3& T_imu_camera, double gravity) {
  if (frames.size() < 5 || samples.size() < 2) return std::nullopt;
  const auto gyro_bias = EstimateGyroBias(frames, samples, T_imu_camera);
  if (!gyro_bias) return std::nullopt;
  std::vector<InertialView> views = {
      {0.0, Eigen::Vector3d::Zero(), T_imu_camera.translation, T_imu_camera.rotation}};
  for (size_t i = 1; i < frames.size(); ++i) {
    const ImuPreintegration motion =
        MotionBetween(samples, frames[0].time, frames[i].time, *gyro_bias);
    views.push_back({motion.duration(), motion.delta_velocity(),
                     motion.delta_position() + motion.delta_rotation() * T_imu_camera.translation,
                     motion.delta_rotation() * T_imu_camera.rotation});
  }
  std::vector<Sightings> landmarks = LandmarksOf(frames);
  if (landmarks.size() < kMinLandmarks) return std::nullopt;
  MotionStart start;
  start.landmarks = static_cast<int>(landmarks.size());
  ClosedForm closed_form(std::move(views), std::move(landmarks), gravity);
  if (!closed_form.Solve()) return std::nullopt;
  std::vector<double> errors;
  std::vector<double> parallaxes;
  closed_form.Judge(&errors, &parallaxes);
  start.median_error = Median(errors);
  start.parallax = Median(parallaxes);
  const Eigen::Vector3d velocity = closed_form.velocity_and_gravity().head<3>();
  if (start.median_error > kMaxError || start.parallax < kMinParallax ||
      velocity.norm() > kMaxSpeed) {
    return std::nullopt;
  }
  const Eigen::Vector3d up = -closed_form.velocity_and_gravity().tail<3>();
  start.state.time = frames[0].time;
  start.state.T_world_imu.rotation = RotationFromUp(up);
  start.state.v_world_imu = start.state.T_world_imu.rotation * velocity;
  start.state.gyro_bias = *gyro_bias;
  return start;
}

}  // namespace regolith

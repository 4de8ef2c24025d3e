// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sensor/camera_model.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

using Jacobian23 = Eigen::Matrix<double, 2, 3>;

// Points nearer to the image plane than this share of their distance have no stable projection.
constexpr double kLeastDepthShare = 1e-3;
constexpr int kMostIterations = 30;
constexpr double kConverged = 1e-12;

/// Smallest x > 0 where a polynomial 1 + c1 x + c2 x² + … stops being positive; infinite where it
/// never does below `limit`. Distortions are monotonic up to there.
template <size_t N>
double FirstRoot(const std::array<double, N>& coefficients, double limit) {
  constexpr int kSteps = 2000;
  for (int step = 1; step <= kSteps; ++step) {
    const double x = limit * step / kSteps;
    double value = 1.0;
    double power = 1.0;
    for (const double coefficient : coefficients) value += coefficient * (power *= x);
    if (value <= 0.0) return x - limit / kSteps;
  }
  return std::numeric_limits<double>::infinity();
}

class Pinhole final : public CameraModel {
 public:
  explicit Pinhole(const CameraIntrinsics& intrinsics) : intrinsics_(intrinsics) {
    const auto& [k1, k2, p1, p2] = intrinsics_.distortion;
    // d(r + k1 r³ + k2 r⁵)/dr > 0 up to 84 degrees off the axis.
    max_radius_squared_ = FirstRoot(std::array<double, 2>{3.0 * k1, 5.0 * k2}, 100.0);
  }

  const CameraIntrinsics& intrinsics() const override { return intrinsics_; }

  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point,
                                         Jacobian23* jacobian) const override {
    if (!(point.z() > kLeastDepthShare * point.norm())) return std::nullopt;
    const Eigen::Vector2d normalised = point.head<2>() / point.z();
    if (normalised.squaredNorm() > max_radius_squared_) return std::nullopt;
    Eigen::Matrix2d derivative;
    const Eigen::Vector2d distorted = Distort(normalised, &derivative);
    if (jacobian != nullptr) {
      Jacobian23 to_normalised;
      to_normalised << 1.0 / point.z(), 0.0, -normalised.x() / point.z(), 0.0, 1.0 / point.z(),
          -normalised.y() / point.z();
      *jacobian = intrinsics_.focal.asDiagonal() * derivative * to_normalised;
    }
    return intrinsics_.focal.cwiseProduct(distorted) + intrinsics_.principal_point;
  }

  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& pixel) const override {
    const Eigen::Vector2d target =
        (pixel - intrinsics_.principal_point).cwiseQuotient(intrinsics_.focal);
    Eigen::Vector2d normalised = target;
    if (normalised.squaredNorm() > max_radius_squared_) {
      normalised *= 0.95 * std::sqrt(max_radius_squared_) / normalised.norm();
    }
    for (int i = 0; i < kMostIterations; ++i) {
      Eigen::Matrix2d derivative;
      const Eigen::Vector2d error = Distort(normalised, &derivative) - target;
      if (error.squaredNorm() < kConverged * kConverged) break;
      normalised -= derivative.inverse() * error;
    }
    if (!((Distort(normalised, nullptr) - target).norm() < 1e-9) ||
        normalised.squaredNorm() > max_radius_squared_) {
      return std::nullopt;
    }
    return Eigen::Vector3d(normalised.x(), normalised.y(), 1.0).normalized();
  }

 private:
  // Brown's model, as in OpenCV: x' = x (1 + k1 r² + k2 r⁴) + 2 p1 x y + p2 (r² + 2 x²), y'
  // likewise.
  Eigen::Vector2d Distort(const Eigen::Vector2d& point, Eigen::Matrix2d* derivative) const {
    const auto& [k1, k2, p1, p2] = intrinsics_.distortion;
    const double x = point.x();
    const double y = point.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + k2 * r2);
    if (derivative != nullptr) {
      const double radial_slope = 2.0 * (k1 + 2.0 * k2 * r2);
      const double mixed = x * y * radial_slope + 2.0 * (p1 * x + p2 * y);
      *derivative << radial + x * x * radial_slope + 2.0 * p1 * y + 6.0 * p2 * x, mixed, mixed,
          radial + y * y * radial_slope + 6.0 * p1 * y + 2.0 * p2 * x;
    }
    return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  }

  CameraIntrinsics intrinsics_;
  double max_radius_squared_;
};

/// Fisheye: radius = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸); equidistant where all k are zero.
class Fisheye final : public CameraModel {
 public:
  explicit Fisheye(const CameraIntrinsics& intrinsics) : intrinsics_(intrinsics) {
    const auto& [k1, k2, k3, k4] = intrinsics_.distortion;
    const double root = FirstRoot(std::array<double, 4>{3.0 * k1, 5.0 * k2, 7.0 * k3, 9.0 * k4},
                                  kMostAngle * kMostAngle);
    max_angle_ = std::min(kMostAngle, std::sqrt(root));
  }

  const CameraIntrinsics& intrinsics() const override { return intrinsics_; }

  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point,
                                         Jacobian23* jacobian) const override {
    const double lateral = point.head<2>().norm();
    const double angle = std::atan2(lateral, point.z());
    const double square = point.squaredNorm();
    if (!(square > 0.0) || angle > max_angle_) return std::nullopt;
    double slope = 0.0;
    const double radius = Radius(angle, &slope);
    // On the axis the direction is not defined, and radius / lateral tends to 1 / z.
    const bool on_axis = lateral < 1e-9 * point.z();
    const Eigen::Vector2d direction =
        on_axis ? Eigen::Vector2d(1.0, 0.0) : Eigen::Vector2d(point.head<2>() / lateral);
    const double radius_per_lateral = on_axis ? 1.0 / point.z() : radius / lateral;
    if (jacobian != nullptr) {
      // d angle / d point = [z direction, -lateral] / |point|².
      const Eigen::Matrix2d outer = direction * direction.transpose();
      Jacobian23 derivative;
      derivative.leftCols<2>() = slope * point.z() / square * outer +
                                 radius_per_lateral * (Eigen::Matrix2d::Identity() - outer);
      derivative.col(2) = -slope * lateral / square * direction;
      *jacobian = intrinsics_.focal.asDiagonal() * derivative;
    }
    return intrinsics_.focal.cwiseProduct(radius_per_lateral * point.head<2>()) +
           intrinsics_.principal_point;
  }

  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& pixel) const override {
    const Eigen::Vector2d target =
        (pixel - intrinsics_.principal_point).cwiseQuotient(intrinsics_.focal);
    const double radius = target.norm();
    if (radius < 1e-12) return Eigen::Vector3d::UnitZ();
    double angle = std::min(radius, max_angle_);
    for (int i = 0; i < kMostIterations; ++i) {
      double slope = 0.0;
      const double error = Radius(angle, &slope) - radius;
      if (std::abs(error) < kConverged) break;
      angle = std::min(angle - error / slope, max_angle_);
    }
    double slope = 0.0;
    if (!(std::abs(Radius(angle, &slope) - radius) < 1e-9)) return std::nullopt;
    const Eigen::Vector2d lateral = std::sin(angle) / radius * target;
    return Eigen::Vector3d(lateral.x(), lateral.y(), std::cos(angle));
  }

 private:
  // Beyond 150 degrees off the axis no lens has an image.
  static constexpr double kMostAngle = 2.6;

  double Radius(double angle, double* slope) const {
    const auto& [k1, k2, k3, k4] = intrinsics_.distortion;
    const double square = angle * angle;
    *slope =
        1.0 + square * (3.0 * k1 + square * (5.0 * k2 + square * (7.0 * k3 + square * 9.0 * k4)));
    return angle * (1.0 + square * (k1 + square * (k2 + square * (k3 + square * k4))));
  }

  CameraIntrinsics intrinsics_;
  double max_angle_;
};

void CheckIntrinsics(const CameraIntrinsics& intrinsics) {
  if (intrinsics.width < 1 || intrinsics.height < 1 || intrinsics.width > 20000 ||
      intrinsics.height > 20000) {
    throw InputError("width, height", Concatenate(intrinsics.width, " × ", intrinsics.height,
                                                  "; expected the image's size in pixels"));
  }
  if (!(intrinsics.focal.minCoeff() > 0.0) || !intrinsics.focal.allFinite()) {
    throw InputError("intrinsics", Concatenate("focal lengths ", intrinsics.focal.transpose(),
                                               "; expected positive pixels"));
  }
  const Eigen::Vector2d& centre = intrinsics.principal_point;
  if (!(centre.x() >= 0.0 && centre.x() <= intrinsics.width && centre.y() >= 0.0 &&
        centre.y() <= intrinsics.height)) {
    throw InputError("intrinsics", Concatenate("principal point ", centre.transpose(),
                                               " lies outside the image of ", intrinsics.width,
                                               " × ", intrinsics.height));
  }
  for (const double coefficient : intrinsics.distortion) {
    if (!std::isfinite(coefficient)) {
      throw InputError("distortion", "holds a value that is not finite");
    }
  }
}

// Every pixel needs a bearing; of a fisheye the middle half, since its corners may lie outside the
// image circle.
void CheckCoversImage(const CameraModel& model) {
  const CameraIntrinsics& intrinsics = model.intrinsics();
  const int margin = intrinsics.model == CameraModelType::kPinhole ? 0 : 2;
  constexpr int kSteps = 8;
  for (int row = margin; row <= kSteps - margin; ++row) {
    for (int column = margin; column <= kSteps - margin; ++column) {
      const Eigen::Vector2d pixel((intrinsics.width - 1) * column / double{kSteps},
                                  (intrinsics.height - 1) * row / double{kSteps});
      if (!model.Unproject(pixel)) {
        throw InputError("distortion",
                         Concatenate("the lens model has no bearing for pixel ", pixel.transpose(),
                                     ": the coefficients fold the image; are they of this model?"));
      }
    }
  }
}

}  // namespace

std::unique_ptr<CameraModel> CameraModel::Create(const CameraIntrinsics& intrinsics) {
  CheckIntrinsics(intrinsics);
  std::unique_ptr<CameraModel> model;
  if (intrinsics.model == CameraModelType::kPinhole) {
    model = std::make_unique<Pinhole>(intrinsics);
  } else {
    if (intrinsics.model == CameraModelType::kEquidistant &&
        intrinsics.distortion != std::array<double, 4>{}) {
      throw InputError("distortion",
                       "the equidistant model has none; expected zeros or kannala_brandt");
    }
    model = std::make_unique<Fisheye>(intrinsics);
  }
  CheckCoversImage(*model);
  return model;
}

std::string CameraModelName(CameraModelType type) {
  switch (type) {
    case CameraModelType::kPinhole:
      return "pinhole";
    case CameraModelType::kEquidistant:
      return "equidistant";
    case CameraModelType::kKannalaBrandt:
      return "kannala_brandt";
  }
  return "unknown";
}

std::optional<CameraModelType> CameraModelFromName(const std::string& name) {
  for (const CameraModelType type : {CameraModelType::kPinhole, CameraModelType::kEquidistant,
                                     CameraModelType::kKannalaBrandt}) {
    if (CameraModelName(type) == name) return type;
  }
  return std::nullopt;
}

}  // namespace regolith

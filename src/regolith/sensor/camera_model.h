// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace regolith {

enum class CameraModelType {
  kPinhole,  ///< pinhole with radial–tangential distortion k1 k2 p1 p2 (Brown; OpenCV's first four)
  kEquidistant,    ///< ideal fisheye, radius = focal · angle, no coefficients
  kKannalaBrandt,  ///< fisheye with k1…k4 (Kannala & Brandt 2006; OpenCV's fisheye)
};

/// Intrinsics of one camera. Pixel centres lie at integer coordinates, the origin in the centre of
/// the top left pixel. Camera frame: x right, y down, z forward.
struct CameraIntrinsics {
  CameraModelType model = CameraModelType::kPinhole;
  int width = 0;                                              ///< pixels
  int height = 0;                                             ///< pixels
  Eigen::Vector2d focal = Eigen::Vector2d::Zero();            ///< pixels
  Eigen::Vector2d principal_point = Eigen::Vector2d::Zero();  ///< pixels
  std::array<double, 4> distortion{};  ///< meaning as of the model; 0 where unused
};

/// Maps between points of the camera frame and pixels.
class CameraModel {
 public:
  virtual ~CameraModel() = default;

  virtual const CameraIntrinsics& intrinsics() const = 0;

  /// The pixel of a point (m, camera frame); nothing behind the camera or where the distortion
  /// folds back. The pixel may lie outside the image. `jacobian`, where given, receives d pixel / d
  /// point (2 × 3).
  virtual std::optional<Eigen::Vector2d> Project(
      const Eigen::Vector3d& point_camera,
      Eigen::Matrix<double, 2, 3>* jacobian = nullptr) const = 0;

  /// The unit bearing (camera frame) of a pixel; nothing where no bearing projects there.
  virtual std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& pixel) const = 0;

  /// Throws InputError (without a file name) where intrinsics make no camera: sizes or focal
  /// lengths not positive, principal point outside the image, distortion that folds the image
  /// inside its own frame.
  static std::unique_ptr<CameraModel> Create(const CameraIntrinsics& intrinsics);
};

/// "pinhole", "equidistant", "kannala_brandt".
std::string CameraModelName(CameraModelType type);
std::optional<CameraModelType> CameraModelFromName(const std::string& name);

}  // namespace regolith

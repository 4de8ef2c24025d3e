// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A world for tests of stereo odometry: ground with stones, and what a rectified pair sees of it.

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/random.h"
#include "regolith/geometry/se3.h"
#include "regolith/geometry/so3.h"
#include "regolith/sensor/rectified_camera.h"
#include "regolith/stereo/stereo_features.h"

namespace regolith {

inline const RectifiedCamera kTestCamera{640, 480, 380.0, {319.5, 239.5}, 0.12};

/// A camera at 1.1 m above the ground that looks along `heading` (rad from x) and 15° down; the
/// world's z axis is up.
inline SE3 TestCameraPose(double x, double y, double heading) {
  Eigen::Matrix3d R_level_camera;  // x right, y down, z forward
  R_level_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Quaterniond rotation =
      ExpSo3({0.0, 0.0, heading}) * ExpSo3({0.0, 0.26, 0.0}) * Eigen::Quaterniond(R_level_camera);
  return {rotation.normalized(), {x, y, 1.1}};
}

/// Points in a square of ground, each with a descriptor of its own.
class TestStereoWorld {
 public:
  TestStereoWorld(uint64_t seed, double least_x, double most_x, double half_width,
                  double per_square_metre = 12.0)
      : seed_(seed) {
    Random random(seed);
    const auto count = static_cast<int>((most_x - least_x) * 2.0 * half_width * per_square_metre);
    for (int i = 0; i < count; ++i) {
      points_.emplace_back(random.Uniform(least_x, most_x), random.Uniform(-half_width, half_width),
                           random.Uniform(-0.1, 0.2));
    }
  }

  /// What is seen from a pose: pixels with noise (σ in pixels), of each descriptor a few bits
  /// flipped, and a tenth more features that belong to no point. At most `most` of the points.
  StereoFeatures See(const SE3& T_world_camera, uint64_t image, double sigma = 0.3,
                     size_t most = 700) const {
    Random random(seed_ * 1000003 + image);
    StereoFeatures features;
    features.descriptors.type = DescriptorType::kBinary;
    const SE3 T_camera_world = T_world_camera.Inverse();
    size_t seen = 0;
    for (size_t i = 0; i < points_.size() && seen < most; ++i) {
      const Eigen::Vector3d point = T_camera_world * points_[i];
      if (point.z() < 0.5 || point.z() > 20.0) continue;
      Eigen::Vector3d pixel = kTestCamera.Project(point);
      for (int axis = 0; axis < 3; ++axis) pixel[axis] += random.Gaussian(0.0, sigma);
      if (!kTestCamera.Contains(pixel.head<2>()) || pixel.z() < 0.0) continue;
      ++seen;
      Append(pixel, Scramble(seed_ * 7919 + i), &random, &features);
    }
    for (size_t i = 0; i < seen / 10; ++i) {
      const Eigen::Vector3d pixel(random.Uniform(60, 639), random.Uniform(0, 479), 0.0);
      Append(pixel - Eigen::Vector3d(0.0, 0.0, -pixel.x() + random.Uniform(1, 40)), random.Next(),
             &random, &features);
    }
    return features;
  }

  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  static void Append(const Eigen::Vector3d& pixel, uint64_t key, Random* random,
                     StereoFeatures* features) {
    features->pixels.push_back(pixel.head<2>().cast<float>());
    features->right_columns.push_back(static_cast<float>(pixel.z()));
    features->scales.push_back(1.0F);
    std::vector<uint8_t>& bits = features->descriptors.bits;
    for (int i = 0; i < kBinaryBytes; ++i) {
      bits.push_back(static_cast<uint8_t>(Scramble(key + static_cast<uint64_t>(i)) >> 24));
    }
    for (int flip = 0; flip < 10; ++flip) {
      const uint64_t bit = random->Next() % (8 * kBinaryBytes);
      bits[bits.size() - kBinaryBytes + bit / 8] ^= static_cast<uint8_t>(1U << (bit % 8));
    }
  }

  uint64_t seed_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_rectifier.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

// cos of the angle between an optical axis and its rectified one that images can still bear.
constexpr double kLeastCosine = 0.5;
// Pixels along the edge of what a camera sees, where descriptors would see the edge.
constexpr int kEdge = 4;

cv::Mat ViewOf(const Image& image) {
  return {image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.data.data())};
}

Image NewImage(int width, int height) {
  return {width, height,
          std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height), 0)};
}

/// Axes of the rectified pair in the left camera's frame.
Eigen::Matrix3d RectifiedAxes(const SE3& T_left_right) {
  const Eigen::Vector3d x = T_left_right.translation.normalized();
  const Eigen::Vector3d forward =
      Eigen::Vector3d::UnitZ() + T_left_right.rotation * Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes.col(0) = x;
  axes.col(2) = (forward - x * x.dot(forward)).normalized();
  axes.col(1) = axes.col(2).cross(x);
  return axes;
}

}  // namespace

/// Where each rectified pixel lies in a camera's image.
struct StereoRectifier::Maps {
  cv::Mat places;     // whole pixels
  cv::Mat fractions;  // index of the fraction, as cv::remap has it
  int width = 0;
  int height = 0;

  Maps(const CameraIntrinsics& intrinsics, const Eigen::Matrix3d& R_camera_rectified,
       const RectifiedCamera& rectified)
      : width(intrinsics.width), height(intrinsics.height) {
    const auto model = CameraModel::Create(intrinsics);
    cv::Mat columns(rectified.height, rectified.width, CV_32F);
    cv::Mat rows(rectified.height, rectified.width, CV_32F);
    for (int row = 0; row < rectified.height; ++row) {
      for (int column = 0; column < rectified.width; ++column) {
        const Eigen::Vector3d ray = rectified.PointAt(Eigen::Vector2d(column, row), 1.0);
        const auto pixel = model->Project(R_camera_rectified * ray);
        columns.at<float>(row, column) = pixel ? static_cast<float>(pixel->x()) : -10.0F;
        rows.at<float>(row, column) = pixel ? static_cast<float>(pixel->y()) : -10.0F;
      }
    }
    cv::convertMaps(columns, rows, places, fractions, CV_16SC2);
  }

  Image Rectify(const Image& image, int rectified_width, int rectified_height) const {
    if (image.width != width || image.height != height) {
      throw InputError("stereo pair", Concatenate("an image is ", image.width, " × ", image.height,
                                                  ", the rig says ", width, " × ", height));
    }
    Image rectified = NewImage(rectified_width, rectified_height);
    cv::Mat target = ViewOf(rectified);
    cv::remap(ViewOf(image), target, places, fractions, cv::INTER_LINEAR, cv::BORDER_CONSTANT,
              cv::Scalar(0));
    return rectified;
  }

  Image Mask(const Image* mask, int rectified_width, int rectified_height) const {
    Image whole = NewImage(width, height);
    std::fill(whole.data.begin(), whole.data.end(), uint8_t{255});
    if (mask != nullptr) {
      for (size_t i = 0; i < whole.data.size(); ++i) {
        if (mask->data[i] == 0) whole.data[i] = 0;
      }
    }
    Image rectified = Rectify(whole, rectified_width, rectified_height);
    cv::Mat view = ViewOf(rectified);
    cv::threshold(view, view, 254, 255, cv::THRESH_BINARY);
    const cv::Mat element =
        cv::getStructuringElement(cv::MORPH_RECT, {2 * kEdge + 1, 2 * kEdge + 1});
    cv::Mat eroded;
    cv::erode(view, eroded, element);
    eroded.copyTo(view);
    return rectified;
  }
};

StereoRectifier::StereoRectifier(const CameraIntrinsics& left, const CameraIntrinsics& right,
                                 const SE3& T_left_right) {
  const Eigen::Matrix3d R_left_rectified = RectifiedAxes(T_left_right);
  const Eigen::Matrix3d R_right_rectified =
      T_left_right.rotation.conjugate().toRotationMatrix() * R_left_rectified;
  for (const auto& [name, axes] :
       {std::pair("left", R_left_rectified), std::pair("right", R_right_rectified)}) {
    // The images of cameras that are swapped would stand on their heads.
    if (axes(2, 2) > kLeastCosine && axes(0, 0) > kLeastCosine) continue;
    throw InputError(
        "cameras left and right of the rig",
        Concatenate("the ", name,
                    " camera does not look across the baseline with the other on its "
                    "proper side; T_left_right has the translation ",
                    T_left_right.translation.transpose(),
                    " m, expected mostly +x: check T_imu_camera of `left` and `right`, "
                    "or whether they are swapped"));
  }
  camera_.width = left.width;
  camera_.height = left.height;
  camera_.focal = std::min(left.focal.minCoeff(), right.focal.minCoeff());
  camera_.principal_point = left.principal_point;
  camera_.baseline = T_left_right.translation.norm();
  T_left_rectified_ = SE3(Eigen::Quaterniond(R_left_rectified).normalized(), {0.0, 0.0, 0.0});
  left_ = std::make_unique<Maps>(left, R_left_rectified, camera_);
  right_ = std::make_unique<Maps>(right, R_right_rectified, camera_);
}

StereoRectifier::~StereoRectifier() = default;

Image StereoRectifier::Left(const Image& image) const {
  return left_->Rectify(image, camera_.width, camera_.height);
}

Image StereoRectifier::Right(const Image& image) const {
  return right_->Rectify(image, camera_.width, camera_.height);
}

Image StereoRectifier::LeftMask(const Image* mask) const {
  return left_->Mask(mask, camera_.width, camera_.height);
}

Image StereoRectifier::RightMask() const {
  return right_->Mask(nullptr, camera_.width, camera_.height);
}

}  // namespace regolith

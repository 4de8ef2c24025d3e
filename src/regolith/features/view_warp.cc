// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/view_warp.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/features/magsac_internal.h"
#include "regolith/features/opencv_image_internal.h"

namespace regolith {
namespace {

// Pixels. Stones and slopes stand out of the plane by this much and more, and lie where it says all
// the same.
constexpr double kPlaneTolerance = 8.0;
constexpr int kMinInliers = 10;
constexpr double kConfidence = 0.999;
constexpr int kMaxIterations = 1000;
// Of a pixel's third coordinate, where the inliers' is 1 in the mean: what is less lies so near to
// the horizon of the homography that it is enlarged out of all proportion.
constexpr double kMinDepth = 0.05;

}  // namespace

std::optional<Eigen::Matrix3d> PlaneHomography(const std::vector<Eigen::Vector2f>& first,
                                               const std::vector<Eigen::Vector2f>& second,
                                               const std::vector<uint8_t>& inliers) {
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  for (size_t i = 0; i < inliers.size(); ++i) {
    if (!inliers[i]) continue;
    from.emplace_back(first[i].x(), first[i].y());
    to.emplace_back(second[i].x(), second[i].y());
  }
  if (static_cast<int>(from.size()) < kMinInliers) return std::nullopt;
  cv::Mat mask;
  const cv::Mat found =
      cv::findHomography(from, to, mask, Magsac(kPlaneTolerance, kConfidence, kMaxIterations));
  if (found.rows != 3 || found.cols != 3 || cv::countNonZero(mask) < kMinInliers) {
    return std::nullopt;
  }
  Eigen::Matrix3d H_second_first = ToEigen(found);
  double depth = 0.0;
  for (size_t i = 0; i < from.size(); ++i) {
    if (mask.at<uint8_t>(static_cast<int>(i)) == 0) continue;
    depth += H_second_first.row(2).dot(Eigen::Vector3d(from[i].x, from[i].y, 1.0));
  }
  H_second_first *= cv::countNonZero(mask) / depth;
  if (!H_second_first.allFinite() || H_second_first.determinant() <= 0.0) return std::nullopt;
  return H_second_first;
}

double MedianEnlargement(const Eigen::Matrix3d& homography,
                         const std::vector<Eigen::Vector2f>& places) {
  // The determinant of its derivative is det(H) / depth^3.
  std::vector<double> depths;
  for (const Eigen::Vector2f& place : places) {
    const double depth = homography.row(2).dot(Eigen::Vector3d(place.x(), place.y(), 1.0));
    if (depth >= kMinDepth) depths.push_back(depth);
  }
  if (depths.empty()) return 1.0;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return homography.determinant() / (*middle * *middle * *middle);
}

WarpedView WarpImage(const Image& image, const Eigen::Matrix3d& H_view_image, int width, int height,
                     int border) {
  const size_t size = static_cast<size_t>(width) * static_cast<size_t>(height);
  WarpedView view{{width, height, std::vector<uint8_t>(size)},
                  {width, height, std::vector<uint8_t>(size)}};
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> H_image_view = H_view_image.inverse();
  const cv::Mat sought(3, 3, CV_64F, H_image_view.data());
  cv::Mat shown = ViewOf(view.image);
  cv::warpPerspective(ViewOf(image), shown, sought, shown.size(),
                      cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  cv::Mat inside = cv::Mat::zeros(image.height, image.width, CV_8U);
  const cv::Rect within(border, border, image.width - 2 * border, image.height - 2 * border);
  if (within.width > 0 && within.height > 0) inside(within).setTo(1);
  cv::Mat allowed = ViewOf(view.mask);
  cv::warpPerspective(inside, allowed, sought, allowed.size(),
                      cv::INTER_NEAREST | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT);
  return view;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/absolute_pose.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr double kConfidence = 0.9999;  // of RANSAC, that it has met the best pose
constexpr double kLeastForward = 0.1;   // of a unit bearing

}  // namespace

std::optional<AbsolutePose> EstimateAbsolutePose(Span<const Eigen::Vector3d> points,
                                                 Span<const Eigen::Vector3d> bearings,
                                                 const AbsolutePoseOptions& options) {
  REGOLITH_CHECK(points.size() == bearings.size(), points.size(), " points, ", bearings.size(),
                 " bearings");
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> rays;  // at unit depth
  std::vector<int> rows;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& ray = bearings[i];
    if (ray.z() < kLeastForward) continue;
    objects.emplace_back(points[i].x(), points[i].y(), points[i].z());
    rays.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
    rows.push_back(static_cast<int>(i));
  }
  if (objects.size() < static_cast<size_t>(options.min_inliers)) return std::nullopt;
  cv::Vec3d rotation;
  cv::Vec3d translation;
  std::vector<int> inliers;
  const bool found =
      cv::solvePnPRansac(objects, rays, cv::Matx33d::eye(), cv::noArray(), rotation, translation,
                         false, options.iterations, static_cast<float>(options.angle_error),
                         kConfidence, inliers, cv::SOLVEPNP_EPNP);
  if (!found || inliers.size() < static_cast<size_t>(options.min_inliers)) return std::nullopt;
  std::vector<cv::Point3d> agreeing;
  std::vector<cv::Point2d> agreeing_rays;
  AbsolutePose pose;
  for (const int inlier : inliers) {
    agreeing.push_back(objects[static_cast<size_t>(inlier)]);
    agreeing_rays.push_back(rays[static_cast<size_t>(inlier)]);
    pose.inliers.push_back(rows[static_cast<size_t>(inlier)]);
  }
  cv::solvePnPRefineLM(agreeing, agreeing_rays, cv::Matx33d::eye(), cv::noArray(), rotation,
                       translation);
  pose.T_camera_points = SE3(ExpSo3({rotation[0], rotation[1], rotation[2]}),
                             {translation[0], translation[1], translation[2]});
  if (!pose.T_camera_points.translation.allFinite() ||
      !pose.T_camera_points.rotation.coeffs().allFinite()) {
    return std::nullopt;
  }
  return pose;
}

}  // namespace regolith

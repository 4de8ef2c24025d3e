// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/outlier_rejection.h"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "regolith/core/check.h"
#include "regolith/features/fundamental_matrix.h"
#include "regolith/features/known_rotation.h"
#include "regolith/features/magsac_internal.h"
#include "regolith/features/neighbour_motion.h"
#include "regolith/features/relative_pose.h"

namespace regolith {
namespace {

// Bearings nearer to the image plane's horizon than this (84 degrees off the axis) are judged by
// the essential matrix but do not help to find it: on the plane z = 1 they lie too far out.
constexpr double kMinBearingZ = 0.1;

cv::UsacParams MagsacOf(const OutlierRejectionOptions& options) {
  return Magsac(2.0 * options.epipolar_sigma, options.confidence, options.max_iterations);
}

/// For the essential matrix OpenCV's own refinement costs more than it gains: ours goes further,
/// also from a poor sample, so that ten times the chance of one is as good.
cv::UsacParams MagsacWithoutRefinement(const OutlierRejectionOptions& options) {
  cv::UsacParams params = MagsacOf(options);
  params.loMethod = cv::LOCAL_OPTIM_NULL;
  params.confidence = std::max(0.9, 1.0 - 10.0 * (1.0 - options.confidence));
  return params;
}

std::vector<size_t> InlierRows(const std::vector<uint8_t>& inliers) {
  std::vector<size_t> rows;
  for (size_t i = 0; i < inliers.size(); ++i) {
    if (inliers[i]) rows.push_back(i);
  }
  return rows;
}

/// Clears `inliers` that are far from their epipolar lines. False: no model was found.
bool ApplyFundamental(const Correspondences& matches, const OutlierRejectionOptions& options,
                      std::vector<uint8_t>* inliers) {
  std::vector<Eigen::Vector2d> first;
  std::vector<Eigen::Vector2d> second;
  const std::vector<size_t> rows = InlierRows(*inliers);
  for (const size_t row : rows) {
    first.push_back(matches.first[row].cast<double>());
    second.push_back(matches.second[row].cast<double>());
  }
  const int size = static_cast<int>(rows.size());
  cv::Mat mask;
  const cv::Mat found =
      cv::findFundamentalMat(cv::Mat(size, 1, CV_64FC2, first.data()),
                             cv::Mat(size, 1, CV_64FC2, second.data()), mask, MagsacOf(options));
  if (found.rows != 3 || found.cols != 3) return false;
  const double threshold = 2.0 * options.epipolar_sigma;
  const Eigen::Matrix3d F_second_first =
      RefineFundamental(first, second, ToEigen(found), threshold);
  for (size_t i = 0; i < rows.size(); ++i) {
    const double square = SquareLineDistance(F_second_first, first[i], second[i]);
    (*inliers)[rows[i]] = square <= threshold * threshold ? 1 : 0;
  }
  return true;
}

/// Clears `inliers` that do not agree with one direction of translation.
void ApplyTranslation(const RotatedBearings& bearings, const std::vector<size_t>& rows,
                      const Eigen::Vector3d& direction, double threshold,
                      std::vector<uint8_t>* inliers) {
  const std::vector<uint8_t> agree = AgreeWithTranslation(bearings, direction, threshold);
  for (size_t i = 0; i < rows.size(); ++i) (*inliers)[rows[i]] = agree[i];
}

/// Rows that are still inliers, with their bearings in the second camera's frame.
RotatedBearings Rotate(const Correspondences& matches, const Eigen::Matrix3d& R_second_first,
                       const std::vector<size_t>& rows) {
  RotatedBearings bearings;
  for (const size_t row : rows) {
    bearings.first.push_back(R_second_first * matches.first_bearings[row]);
    bearings.second.push_back(matches.second_bearings[row]);
  }
  return bearings;
}

void ApplyRotation(const Correspondences& matches, double threshold,
                   const Eigen::Quaterniond& R_second_first, const OutlierRejectionOptions& options,
                   std::vector<uint8_t>* inliers) {
  const std::vector<size_t> rows = InlierRows(*inliers);
  const RotatedBearings bearings =
      Rotate(matches, R_second_first.normalized().toRotationMatrix(), rows);
  const Eigen::Vector3d direction =
      FindTranslation(bearings, {threshold, options.confidence, options.max_iterations});
  ApplyTranslation(bearings, rows, direction, threshold, inliers);
}

/// False: no model was found.
bool ApplyEssential(const Correspondences& matches, double focal, double threshold,
                    const OutlierRejectionOptions& options, std::vector<uint8_t>* inliers) {
  std::vector<cv::Point2d> first;
  std::vector<cv::Point2d> second;
  const std::vector<size_t> rows = InlierRows(*inliers);
  for (const size_t row : rows) {
    const Eigen::Vector3d& bearing_first = matches.first_bearings[row];
    const Eigen::Vector3d& bearing_second = matches.second_bearings[row];
    if (std::min(bearing_first.z(), bearing_second.z()) < kMinBearingZ) continue;
    first.emplace_back(focal * bearing_first.x() / bearing_first.z(),
                       focal * bearing_first.y() / bearing_first.z());
    second.emplace_back(focal * bearing_second.x() / bearing_second.z(),
                        focal * bearing_second.y() / bearing_second.z());
  }
  if (static_cast<int>(first.size()) < options.min_matches) return false;
  const cv::Mat camera = (cv::Mat_<double>(3, 3) << focal, 0, 0, 0, focal, 0, 0, 0, 1);
  cv::Mat mask;
  const cv::Mat found = cv::findEssentialMat(first, second, camera, camera, cv::noArray(),
                                             cv::noArray(), mask, MagsacWithoutRefinement(options));
  if (found.rows != 3 || found.cols != 3) return false;
  const RotatedBearings bearings = Rotate(matches, Eigen::Matrix3d::Identity(), rows);
  // OpenCV's matrix is a fit of few matches and leaves a tenth of the true ones outside.
  const RelativePose pose =
      RefineRelativePose(bearings, PoseOfEssential(bearings, ToEigen(found), threshold), threshold);
  ApplyTranslation(Rotate(matches, pose.R_second_first, rows), rows, pose.direction, threshold,
                   inliers);
  return true;
}

/// Clears rows that no model can judge.
void DropUnusable(const Correspondences& matches, std::vector<uint8_t>* inliers) {
  const bool has_bearings = !matches.first_bearings.empty();
  const auto usable = [](const Eigen::Vector3d& bearing) {
    return bearing.allFinite() && bearing.z() > 0.0;
  };
  for (size_t i = 0; i < inliers->size(); ++i) {
    if (!matches.first[i].allFinite() || !matches.second[i].allFinite() ||
        (has_bearings &&
         !(usable(matches.first_bearings[i]) && usable(matches.second_bearings[i])))) {
      (*inliers)[i] = 0;
    }
  }
}

}  // namespace

OutlierRejection RejectOutliers(const Correspondences& matches, double focal,
                                const std::optional<Eigen::Quaterniond>& R_second_first,
                                const OutlierRejectionOptions& options) {
  options.Check();
  const size_t size = matches.first.size();
  const bool has_bearings = !matches.first_bearings.empty();
  REGOLITH_CHECK(matches.second.size() == size, size, " and ", matches.second.size());
  REGOLITH_CHECK(!has_bearings || matches.first_bearings.size() == size,
                 matches.first_bearings.size(), " bearings for ", size);
  REGOLITH_CHECK(matches.second_bearings.size() == matches.first_bearings.size(),
                 matches.first_bearings.size(), " and ", matches.second_bearings.size());
  REGOLITH_CHECK(!has_bearings || focal > 0.0, "focal=", focal);

  OutlierRejection result;
  result.inliers.assign(size, 1);
  DropUnusable(matches, &result.inliers);
  const auto usable = std::count(result.inliers.begin(), result.inliers.end(), uint8_t{1});
  if (usable >= options.min_matches) {
    const double threshold = 2.0 * options.epipolar_sigma / focal;
    if (!has_bearings) {
      if (ApplyFundamental(matches, options, &result.inliers)) result.model = "fundamental";
    } else if (R_second_first) {
      ApplyRotation(matches, threshold, *R_second_first, options, &result.inliers);
      result.model = "rotation";
    } else if (ApplyEssential(matches, focal, threshold, options, &result.inliers)) {
      result.model = "essential";
    }
  }
  RejectAgainstNeighbours(matches.first, matches.second, options, &result.inliers);
  result.inlier_count =
      static_cast<int>(std::count(result.inliers.begin(), result.inliers.end(), uint8_t{1}));
  return result;
}

}  // namespace regolith

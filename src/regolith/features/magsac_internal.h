// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/calib3d.hpp>

namespace regolith {

/// OpenCV's MAGSAC (Barath et al. 2019) with its local optimisation, the same matches giving the
/// same model always; `threshold` in the unit of the points.
inline cv::UsacParams Magsac(double threshold, double confidence, int max_iterations) {
  cv::UsacParams params;
  params.score = cv::SCORE_METHOD_MAGSAC;
  params.loMethod = cv::LOCAL_OPTIM_SIGMA;
  params.sampler = cv::SAMPLING_UNIFORM;
  params.randomGeneratorState = 1;
  params.isParallel = false;  // so that results do not depend on threads
  params.confidence = confidence;
  params.maxIterations = max_iterations;
  params.loSampleSize = 14;
  params.loIterations = 10;
  params.threshold = threshold;
  return params;
}

/// A model that was found, 3 × 3 of doubles.
inline Eigen::Matrix3d ToEigen(const cv::Mat& model) {
  Eigen::Matrix3d result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result(row, column) = model.at<double>(row, column);
  }
  return result;
}

}  // namespace regolith

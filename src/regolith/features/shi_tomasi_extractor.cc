// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/shi_tomasi_extractor.h"

#include <algorithm>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/core/check.h"
#include "regolith/features/corner.h"
#include "regolith/features/free_pixels.h"
#include "regolith/features/keypoint_grid.h"
#include "regolith/features/opencv_image_internal.h"

namespace regolith {
namespace {

// Of the gradients; the eigenvalue's neighbourhood comes on top.
constexpr int kSobelSize = 3;

// Of equal neighbours the first in reading order is the maximum, so that a plateau gives one
// corner.
bool IsLocalMaximum(const cv::Mat& response, int row, int column) {
  const float value = response.at<float>(row, column);
  for (int dy = -1; dy <= 1; ++dy) {
    const float* line = response.ptr<float>(row + dy) + column;
    for (int dx = -1; dx <= 1; ++dx) {
      const bool before = dy < 0 || (dy == 0 && dx < 0);
      if (before ? line[dx] >= value : line[dx] > value) return false;
    }
  }
  return true;
}

class ShiTomasiExtractor final : public FeatureExtractor {
 public:
  explicit ShiTomasiExtractor(const FeatureOptions& options) : options_(options) {}

  void Extract(const Image& image, const Image* mask, int max_keypoints,
               FeatureSet* features) override {
    Stopwatch stopwatch;
    *features = FeatureSet();
    status_ = DetectionStatus();
    const KeypointGrid grid(image.width, image.height, options_.adaptive.cell_size);
    free_.Reset(image.width, image.height, mask, options_.border);
    // A local maximum needs neighbours on every side.
    if (image.width >= 3 && image.height >= 3) {
      cv::cornerMinEigenVal(ViewOf(image), response_, options_.shi_tomasi.block, kSobelSize);
      FindCorners();
      stopwatch.Lap("detect");
      Select(grid, max_keypoints, features);
    }
    stopwatch.Lap("select");
    grid.CountFilled(features->pixels, &status_);
    stages_ = stopwatch.stages();
  }

  Descriptors Describe(const std::vector<Eigen::Vector2f>& /*pixels*/) const override { return {}; }
  const DetectionStatus& status() const override { return status_; }
  const std::vector<StageTime>& stages() const override { return stages_; }
  void Reset() override {}

 private:
  void FindCorners() {
    strongest_ = 0.0F;
    for (int row = 0; row < response_.rows; ++row) {
      const float* line = response_.ptr<float>(row);
      const uint8_t* free =
          free_.image().data.data() + static_cast<ptrdiff_t>(row) * response_.cols;
      for (int column = 0; column < response_.cols; ++column) {
        if (free[column] != 0) strongest_ = std::max(strongest_, line[column]);
      }
    }
    corners_.clear();
    const float least = strongest_ * static_cast<float>(options_.shi_tomasi.quality);
    status_.threshold_min = status_.threshold_median = status_.threshold_max =
        options_.shi_tomasi.quality;
    if (strongest_ <= 0.0F) return;
    for (int row = 1; row + 1 < response_.rows; ++row) {
      const float* line = response_.ptr<float>(row);
      const uint8_t* free =
          free_.image().data.data() + static_cast<ptrdiff_t>(row) * response_.cols;
      for (int column = 1; column + 1 < response_.cols; ++column) {
        if (free[column] != 0 && line[column] >= least && IsLocalMaximum(response_, row, column)) {
          corners_.push_back({line[column], column, row});
        }
      }
    }
    std::sort(corners_.begin(), corners_.end(), Stronger);
  }

  void Select(const KeypointGrid& grid, int max_keypoints, FeatureSet* features) {
    candidates_.clear();
    candidate_scores_.clear();
    for (const Corner& corner : corners_) {
      const Eigen::Vector2f pixel(static_cast<float>(corner.column),
                                  static_cast<float>(corner.row));
      if (!free_.IsFree(pixel)) continue;
      free_.Take(pixel, options_.min_distance);
      candidates_.push_back(pixel);
      candidate_scores_.push_back(corner.response / strongest_);
    }
    selection_.Select(grid, {}, candidates_, max_keypoints, &rows_);
    for (const int row : rows_) {
      features->pixels.push_back(candidates_[static_cast<size_t>(row)]);
      features->scores.push_back(candidate_scores_[static_cast<size_t>(row)]);
    }
  }

  FeatureOptions options_;
  DetectionStatus status_;
  std::vector<StageTime> stages_;
  FreePixels free_;
  EvenSelection selection_;
  cv::Mat response_;
  float strongest_ = 0.0F;
  std::vector<Corner> corners_;
  std::vector<Eigen::Vector2f> candidates_;
  std::vector<float> candidate_scores_;
  std::vector<int> rows_;
};

}  // namespace

std::unique_ptr<FeatureExtractor> CreateShiTomasiExtractor(const FeatureOptions& options) {
  options.Check();
  return std::make_unique<ShiTomasiExtractor>(options);
}

}  // namespace regolith

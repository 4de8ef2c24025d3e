// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/orb_extractor.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/core/check.h"
#include "regolith/features/corner.h"
#include "regolith/features/free_pixels.h"
#include "regolith/features/harris_corner.h"
#include "regolith/features/keypoint_grid.h"
#include "regolith/features/opencv_image_internal.h"

namespace regolith {
namespace {

// The turned pattern of the descriptor reaches 19 pixels from the keypoint (13 √2).
constexpr int kMargin = 19;
static_assert(kMargin >= kPatchReach && kMargin >= kHarrisReach);
// Of a level's own pixels: the cells that FAST is asked again in.
constexpr int kDetectionCell = 35;
// Corners of such a cell that are ranked by Harris' measure, which costs more than FAST.
constexpr int kMostInCell = 10;
// FAST looks at a circle of radius 3; one pixel more, so that the maximum is decided as in the
// whole image.
constexpr int kFastReach = 4;
// Pixels: corners of several levels at one place count once, for descriptors of both would be so
// alike that the ratio test refused both. (On simulated pairs 3 pixels cost a third of the right
// matches.)
constexpr int kSameCorner = 1;
constexpr double kRadiansToDegrees = 57.29577951308232;

/// One scale of the image.
struct Level {
  cv::Mat image;
  float columns_scale = 1.0F;  ///< pixels of the image a pixel of the level
  float rows_scale = 1.0F;
  std::vector<Corner> corners;
  std::vector<Corner> chosen;

  PixelView View() const { return {image.data, static_cast<ptrdiff_t>(image.step)}; }
  /// Pixel centres lie at integers in both, so the scale acts about the corner at (−½, −½).
  Eigen::Vector2f InImage(const Corner& corner) const {
    return {(static_cast<float>(corner.column) + 0.5F) * columns_scale - 0.5F,
            (static_cast<float>(corner.row) + 0.5F) * rows_scale - 0.5F};
  }
};

class OrbExtractor final : public FeatureExtractor {
 public:
  explicit OrbExtractor(const FeatureOptions& options)
      : options_(options),
        // One level, no border: the pyramid and the places are ours.
        descriptor_(cv::ORB::create(1, static_cast<float>(options.orb.scale_factor), 1, 0)) {}

  void Extract(const Image& image, const Image* mask, int max_keypoints,
               FeatureSet* features) override {
    Stopwatch stopwatch;
    *features = FeatureSet();
    features->descriptors.type = DescriptorType::kBinary;
    status_ = DetectionStatus();
    thresholds_.clear();
    free_.Reset(image.width, image.height, mask, options_.border);
    const KeypointGrid grid(image.width, image.height, options_.adaptive.cell_size);
    BuildPyramid(image);
    stopwatch.Lap("pyramid");
    for (size_t i = 0; i < level_count_; ++i) FindCorners(&levels_[i]);
    stopwatch.Lap("detect");
    Choose(grid, max_keypoints);
    stopwatch.Lap("select");
    Describe(features);
    stopwatch.Lap("describe");
    FillStatus(grid, *features);
    stages_ = stopwatch.stages();
  }

  Descriptors Describe(const std::vector<Eigen::Vector2f>& /*pixels*/) const override { return {}; }
  const DetectionStatus& status() const override { return status_; }
  const std::vector<StageTime>& stages() const override { return stages_; }
  void Reset() override {}

 private:
  /// Levels that are too small for a keypoint are left out.
  void BuildPyramid(const Image& image) {
    levels_.resize(static_cast<size_t>(options_.orb.levels));
    level_count_ = 0;
    for (Level& level : levels_) {
      const double scale = std::pow(options_.orb.scale_factor, static_cast<double>(level_count_));
      const cv::Size size(static_cast<int>(std::lround(image.width / scale)),
                          static_cast<int>(std::lround(image.height / scale)));
      if (std::min(size.width, size.height) <= 2 * kMargin) break;
      if (level_count_ == 0) {
        level.image = ViewOf(image);
      } else {
        cv::resize(levels_[level_count_ - 1].image, level.image, size, 0.0, 0.0,
                   cv::INTER_LINEAR_EXACT);
      }
      level.columns_scale = static_cast<float>(image.width) / static_cast<float>(size.width);
      level.rows_scale = static_cast<float>(image.height) / static_cast<float>(size.height);
      ++level_count_;
    }
  }

  void FindCorners(Level* level) {
    const cv::Mat& image = level->image;
    const cv::Rect inner(kMargin, kMargin, image.cols - 2 * kMargin, image.rows - 2 * kMargin);
    const KeypointGrid cells(inner.width, inner.height, kDetectionCell);
    in_cell_.assign(static_cast<size_t>(cells.cells()), 0);
    level->corners.clear();
    AddFastCorners(inner, options_.orb.fast_threshold, cells, level);
    for (int row = 0; row < cells.rows(); ++row) {
      for (int column = 0; column < cells.columns(); ++column) {
        const bool empty = in_cell_[static_cast<size_t>(row * cells.columns() + column)] == 0;
        thresholds_.push_back(empty ? options_.orb.fast_floor : options_.orb.fast_threshold);
        if (!empty) continue;
        const int left = inner.width * column / cells.columns();
        const int top = inner.height * row / cells.rows();
        const int right = inner.width * (column + 1) / cells.columns();
        const int bottom = inner.height * (row + 1) / cells.rows();
        AddFastCorners({inner.x + left, inner.y + top, right - left, bottom - top},
                       options_.orb.fast_floor, cells, level);
      }
    }
    std::sort(level->corners.begin(), level->corners.end(), Stronger);
  }

  /// Adds the corners whose pixel lies in `area` and is free, of each cell those that FAST thinks
  /// best.
  void AddFastCorners(const cv::Rect& area, int threshold, const KeypointGrid& cells,
                      Level* level) {
    const cv::Point origin(area.x - kFastReach, area.y - kFastReach);
    const cv::Rect seen(origin, area.size() + cv::Size(2 * kFastReach, 2 * kFastReach));
    cv::FAST(level->image(seen), fast_corners_, threshold, true);
    fast_candidates_.clear();
    for (const cv::KeyPoint& found : fast_corners_) {
      const Corner corner{found.response, static_cast<int>(found.pt.x) + origin.x,
                          static_cast<int>(found.pt.y) + origin.y};
      if (!area.contains({corner.column, corner.row})) continue;
      if (free_.IsFree(level->InImage(corner))) fast_candidates_.push_back(corner);
    }
    std::sort(fast_candidates_.begin(), fast_candidates_.end(), Stronger);
    for (const Corner& corner : fast_candidates_) {
      int& count =
          in_cell_[static_cast<size_t>(cells.CellOf({static_cast<float>(corner.column - kMargin),
                                                     static_cast<float>(corner.row - kMargin)}))];
      if (count == kMostInCell) continue;
      ++count;
      const float response = HarrisResponse(level->View(), corner.column, corner.row);
      if (response <= 0.0F) continue;  // an edge
      level->corners.push_back({response, corner.column, corner.row});
    }
  }

  /// Each level gives a share of the number asked for as large as its share of the pixels, fine
  /// ones first, since they say the place of a corner best; what they lack falls to the coarser.
  void Choose(const KeypointGrid& grid, int max_keypoints) {
    double weight = 0.0;
    for (size_t i = 0; i < level_count_; ++i) weight += Weight(i);
    int left = max_keypoints;
    chosen_pixels_.clear();
    for (size_t i = 0; i < level_count_; ++i) {
      Level& level = levels_[i];
      const int share = static_cast<int>(std::lround(left * Weight(i) / weight));
      weight -= Weight(i);
      candidates_.clear();
      size_t kept = 0;
      for (const Corner& corner : level.corners) {
        const Eigen::Vector2f pixel = level.InImage(corner);
        if (!free_.IsFree(pixel)) continue;
        level.corners[kept++] = corner;
        candidates_.push_back(pixel);
      }
      level.corners.resize(kept);
      selection_.Select(grid, chosen_pixels_, candidates_, share, &rows_);
      level.chosen.clear();
      for (const int row : rows_) {
        const Eigen::Vector2f& pixel = candidates_[static_cast<size_t>(row)];
        level.chosen.push_back(level.corners[static_cast<size_t>(row)]);
        chosen_pixels_.push_back(pixel);
        free_.Take(pixel, kSameCorner);
      }
      left -= static_cast<int>(rows_.size());
    }
  }

  double Weight(size_t level) const {
    return std::pow(options_.orb.scale_factor, -2.0 * static_cast<double>(level));
  }

  void Describe(FeatureSet* features) {
    unsorted_ = FeatureSet();
    unsorted_.descriptors.type = DescriptorType::kBinary;
    for (size_t i = 0; i < level_count_; ++i) DescribeLevel(levels_[i]);
    rows_.resize(unsorted_.size());
    for (size_t i = 0; i < rows_.size(); ++i) rows_[i] = static_cast<int>(i);
    std::stable_sort(rows_.begin(), rows_.end(), [this](int a, int b) {
      return unsorted_.scores[static_cast<size_t>(a)] > unsorted_.scores[static_cast<size_t>(b)];
    });
    for (const int row : rows_) {
      const auto index = static_cast<size_t>(row);
      features->pixels.push_back(unsorted_.pixels[index]);
      features->scores.push_back(unsorted_.scores[index]);
      features->scales.push_back(unsorted_.scales[index]);
      features->descriptors.Append(unsorted_.descriptors, index);
    }
  }

  void DescribeLevel(const Level& level) {
    if (level.chosen.empty()) return;
    keypoints_.clear();
    for (const Corner& corner : level.chosen) {
      const double angle = PatchAngle(level.View(), corner.column, corner.row) * kRadiansToDegrees;
      keypoints_.emplace_back(static_cast<float>(corner.column), static_cast<float>(corner.row),
                              31.0F, static_cast<float>(angle), corner.response, 0);
      unsorted_.pixels.push_back(level.InImage(corner));
      unsorted_.scores.push_back(corner.response);
      unsorted_.scales.push_back(level.columns_scale);
    }
    descriptor_->compute(level.image, keypoints_, described_);
    REGOLITH_CHECK(described_.rows == static_cast<int>(level.chosen.size()) &&
                       described_.cols == kBinaryBytes && described_.isContinuous(),
                   "descriptors ", described_.rows, " × ", described_.cols);
    unsorted_.descriptors.bits.insert(unsorted_.descriptors.bits.end(), described_.datastart,
                                      described_.dataend);
  }

  void FillStatus(const KeypointGrid& grid, const FeatureSet& features) {
    grid.CountFilled(features.pixels, &status_);
    if (thresholds_.empty()) return;
    const auto middle = thresholds_.begin() + static_cast<std::ptrdiff_t>(thresholds_.size() / 2);
    std::nth_element(thresholds_.begin(), middle, thresholds_.end());
    status_.threshold_median = *middle;
    const auto [least, most] = std::minmax_element(thresholds_.begin(), thresholds_.end());
    status_.threshold_min = *least;
    status_.threshold_max = *most;
    status_.rounds = *least < options_.orb.fast_threshold ? 1 : 0;
  }

  FeatureOptions options_;
  cv::Ptr<cv::ORB> descriptor_;
  DetectionStatus status_;
  std::vector<StageTime> stages_;
  FreePixels free_;
  EvenSelection selection_;
  std::vector<Level> levels_;
  size_t level_count_ = 0;
  std::vector<int> thresholds_;
  std::vector<cv::KeyPoint> fast_corners_;
  std::vector<Corner> fast_candidates_;
  std::vector<int> in_cell_;
  std::vector<Eigen::Vector2f> candidates_;
  std::vector<Eigen::Vector2f> chosen_pixels_;
  std::vector<int> rows_;
  std::vector<cv::KeyPoint> keypoints_;
  cv::Mat described_;
  FeatureSet unsorted_;
};

}  // namespace

std::unique_ptr<FeatureExtractor> CreateOrbExtractor(const FeatureOptions& options) {
  options.Check();
  return std::make_unique<OrbExtractor>(options);
}

}  // namespace regolith

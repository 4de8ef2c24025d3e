// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/epipolar_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/features/descriptor_similarity.h"

namespace regolith {
namespace {

// The patches are compared in one of these halvings of the images, that which is nearest to the
// level in which the keypoint was found.
constexpr int kHalvings = 3;
constexpr int kHalfPatch = 5;  // pixels of that image
constexpr int kReach = 5;      // pixels of it, to either side of the descriptors' match
constexpr int kSide = 2 * kHalfPatch + 1;
constexpr int kPixels = kSide * kSide;
// Grey levels², of a patch that has no texture.
constexpr double kLeastVariance = 1.0;

cv::Mat ViewOf(const Image& image) {
  return {image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.data.data())};
}

float ScaleOf(const FeatureSet& set, size_t index) {
  return set.scales.empty() ? 1.0F : set.scales[index];
}

/// Correlation of the patch around `left` with that around `right`, both inside their images; -1
/// for one without texture.
double Correlation(const cv::Mat& left_image, const cv::Point& left, const cv::Mat& right_image,
                   const cv::Point& right) {
  int sum_left = 0;
  int sum_right = 0;
  int squares_left = 0;
  int squares_right = 0;
  int products = 0;
  for (int row = -kHalfPatch; row <= kHalfPatch; ++row) {
    const uint8_t* a = left_image.ptr<uint8_t>(left.y + row) + left.x - kHalfPatch;
    const uint8_t* b = right_image.ptr<uint8_t>(right.y + row) + right.x - kHalfPatch;
    for (int i = 0; i < kSide; ++i) {
      sum_left += a[i];
      sum_right += b[i];
      squares_left += a[i] * a[i];
      squares_right += b[i] * b[i];
      products += a[i] * b[i];
    }
  }
  const double mean_left = static_cast<double>(sum_left) / kPixels;
  const double mean_right = static_cast<double>(sum_right) / kPixels;
  const double variance_left = static_cast<double>(squares_left) / kPixels - mean_left * mean_left;
  const double variance_right =
      static_cast<double>(squares_right) / kPixels - mean_right * mean_right;
  if (variance_left < kLeastVariance || variance_right < kLeastVariance) return -1.0;
  return (static_cast<double>(products) / kPixels - mean_left * mean_right) /
         std::sqrt(variance_left * variance_right);
}

bool HoldsPatch(const cv::Mat& image, const cv::Point& centre) {
  return centre.x >= kHalfPatch && centre.y >= kHalfPatch && centre.x + kHalfPatch < image.cols &&
         centre.y + kHalfPatch < image.rows;
}

}  // namespace

/// cv::pyrDown keeps the even pixels: a place halves with each step.
struct EpipolarMatcher::Pyramids {
  std::array<cv::Mat, kHalvings> left;
  std::array<cv::Mat, kHalvings> right;

  static void Build(const Image& image, std::array<cv::Mat, kHalvings>* levels) {
    (*levels)[0] = ViewOf(image);
    for (size_t i = 1; i < kHalvings; ++i) cv::pyrDown((*levels)[i - 1], (*levels)[i]);
  }
};

EpipolarMatcher::EpipolarMatcher(const EpipolarMatcherOptions& options,
                                 const RectifiedCamera& camera)
    : options_(options), camera_(camera), pyramids_(std::make_unique<Pyramids>()) {
  options_.Check();
}

EpipolarMatcher::~EpipolarMatcher() = default;

void EpipolarMatcher::SortByRow(const FeatureSet& right) {
  rows_.assign(static_cast<size_t>(camera_.height), {});
  for (size_t i = 0; i < right.size(); ++i) {
    const long row = std::lround(right.pixels[i].y());
    if (row >= 0 && row < camera_.height)
      rows_[static_cast<size_t>(row)].push_back(static_cast<int>(i));
  }
}

int EpipolarMatcher::FindPartner(const FeatureSet& left, size_t index, const FeatureSet& right,
                                 float least, float most) const {
  const Eigen::Vector2f& pixel = left.pixels[index];
  const float scale = ScaleOf(left, index);
  const auto tolerance = static_cast<float>(options_.row_tolerance) * scale;
  const int first = std::max(0, static_cast<int>(std::ceil(pixel.y() - tolerance)));
  const int last =
      std::min(camera_.height - 1, static_cast<int>(std::floor(pixel.y() + tolerance)));
  const auto ratio = static_cast<float>(options_.max_scale_ratio);
  float best = left.descriptors.type == DescriptorType::kBinary
                   ? SimilarityOfHamming(options_.max_hamming)
                   : static_cast<float>(options_.min_similarity);
  int partner = -1;
  for (int row = first; row <= last; ++row) {
    for (const int candidate : rows_[static_cast<size_t>(row)]) {
      const auto other = static_cast<size_t>(candidate);
      const float disparity = pixel.x() - right.pixels[other].x();
      if (disparity < least || disparity > most) continue;
      const float other_scale = ScaleOf(right, other);
      if (other_scale > ratio * scale || scale > ratio * other_scale) continue;
      const float similarity =
          DescriptorSimilarity(left.descriptors, index, right.descriptors, other);
      if (similarity <= best) continue;
      best = similarity;
      partner = candidate;
    }
  }
  return partner;
}

float EpipolarMatcher::Refine(const Eigen::Vector2f& left, float right_column, float scale) const {
  const size_t level = scale < 1.5F ? 0 : scale < 3.0F ? 1 : 2;
  const auto factor = static_cast<float>(1 << level);
  const cv::Mat& left_image = pyramids_->left[level];
  const cv::Mat& right_image = pyramids_->right[level];
  const cv::Point centre(static_cast<int>(std::lround(left.x() / factor)),
                         static_cast<int>(std::lround(left.y() / factor)));
  const cv::Point guess(static_cast<int>(std::lround(right_column / factor)), centre.y);
  const cv::Point reach(kReach, 0);
  if (!HoldsPatch(left_image, centre) || !HoldsPatch(right_image, guess - reach) ||
      !HoldsPatch(right_image, guess + reach)) {
    return StereoFeatures::kNotSeen;
  }
  std::array<double, 2 * kReach + 1> correlations{};
  size_t best = 0;
  for (size_t i = 0; i < correlations.size(); ++i) {
    const cv::Point shift(static_cast<int>(i) - kReach, 0);
    correlations[i] = Correlation(left_image, centre, right_image, guess + shift);
    if (correlations[i] > correlations[best]) best = i;
  }
  if (best == 0 || best + 1 == correlations.size() ||
      correlations[best] < options_.min_correlation) {
    return StereoFeatures::kNotSeen;
  }
  const double before = correlations[best - 1];
  const double after = correlations[best + 1];
  const double bend = before - 2.0 * correlations[best] + after;
  const double fraction = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
  const double place = guess.x + static_cast<double>(best) - kReach + fraction;
  return left.x() - static_cast<float>(centre.x - place) * factor;
}

StereoFeatures EpipolarMatcher::Match(const Image& left_image, const Image& right_image,
                                      const FeatureSet& left, const FeatureSet& right) {
  StereoFeatures features;
  features.pixels = left.pixels;
  features.scales = left.scales;
  features.scales.resize(left.size(), 1.0F);
  features.has_scales = !left.scales.empty();
  features.descriptors = left.descriptors;
  features.right_columns.assign(left.size(), StereoFeatures::kNotSeen);
  Pyramids::Build(left_image, &pyramids_->left);
  Pyramids::Build(right_image, &pyramids_->right);
  SortByRow(right);
  const auto most = static_cast<float>(camera_.focal * camera_.baseline / options_.nearest);
  const auto least = static_cast<float>(options_.min_disparity);
  for (size_t i = 0; i < left.size(); ++i) {
    const int partner = FindPartner(left, i, right, 0.0F, most);
    if (partner < 0) continue;
    const float column =
        Refine(left.pixels[i], right.pixels[static_cast<size_t>(partner)].x(), features.scales[i]);
    const float disparity = left.pixels[i].x() - column;
    if (column == StereoFeatures::kNotSeen || disparity < least || disparity > most) continue;
    features.right_columns[i] = column;
  }
  return features;
}

int EpipolarMatcher::CountReversed(const FeatureSet& left, const FeatureSet& right) {
  const auto most = static_cast<float>(camera_.focal * camera_.baseline / options_.nearest);
  int count = 0;
  for (size_t i = 0; i < left.size(); ++i) {
    const int partner =
        FindPartner(left, i, right, -most, -static_cast<float>(options_.min_disparity));
    if (partner < 0) continue;
    const float column =
        Refine(left.pixels[i], right.pixels[static_cast<size_t>(partner)].x(), ScaleOf(left, i));
    if (column > left.pixels[i].x() + static_cast<float>(options_.min_disparity)) ++count;
  }
  return count;
}

}  // namespace regolith

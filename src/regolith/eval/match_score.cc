// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/match_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Dense>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr double kHalfPixel = 0.5;  // an image reaches this far beyond the centres of its pixels

bool IsInside(const Eigen::Vector2d& pixel, ImageSize size) {
  return pixel.x() >= -kHalfPixel && pixel.x() <= size.width - kHalfPixel &&
         pixel.y() >= -kHalfPixel && pixel.y() <= size.height - kHalfPixel;
}

size_t IndexOf(int column, int row, ImageSize size) {
  return static_cast<size_t>(row) * static_cast<size_t>(size.width) + static_cast<size_t>(column);
}

/// Nothing on or behind the horizon.
std::optional<Eigen::Vector2d> Transfer(const Eigen::Matrix3d& homography,
                                        const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d homogeneous = homography * pixel.homogeneous();
  if (!(homogeneous.z() > 0.0)) return std::nullopt;
  return homogeneous.hnormalized();
}

/// The sign of a homography is free; this one is positive in the middle of the image that it takes
/// points from.
Eigen::Matrix3d WithPositiveDepth(const Eigen::Matrix3d& homography, ImageSize from) {
  const Eigen::Vector3d middle((from.width - 1) / 2.0, (from.height - 1) / 2.0, 1.0);
  return homography.row(2).dot(middle) < 0.0 ? Eigen::Matrix3d(-homography) : homography;
}

/// The grid's pixels around a point that have weight in bilinear interpolation.
struct Neighbours {
  struct Neighbour {
    size_t index;
    double weight;
  };
  std::array<Neighbour, 4> items;
  size_t count = 0;
};

Neighbours NeighboursOf(const Eigen::Vector2d& pixel, ImageSize size) {
  const double x = std::clamp(pixel.x(), 0.0, size.width - 1.0);
  const double y = std::clamp(pixel.y(), 0.0, size.height - 1.0);
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const double right = x - column;
  const double below = y - row;
  Neighbours neighbours;
  for (int i = 0; i < 4; ++i) {
    const double weight = (i % 2 == 0 ? 1.0 - right : right) * (i < 2 ? 1.0 - below : below);
    if (weight == 0.0) continue;
    neighbours.items[neighbours.count++] = {IndexOf(column + i % 2, row + i / 2, size), weight};
  }
  return neighbours;
}

void Count(MatchVerdict verdict, MatchCounts* counts) {
  ++counts->matches;
  counts->known += verdict != MatchVerdict::kUnknown ? 1 : 0;
  counts->correct += verdict == MatchVerdict::kCorrect ? 1 : 0;
}

}  // namespace

PixelTruth PixelTruth::FromHomography(const Eigen::Matrix3d& H_second_first, ImageSize first,
                                      ImageSize second) {
  REGOLITH_CHECK(H_second_first.allFinite() && H_second_first.determinant() != 0.0, H_second_first);
  PixelTruth truth(first, second);
  truth.H_second_first_ = WithPositiveDepth(H_second_first, first);
  // Points before the horizon on the way there are so on the way back: H x = w x' with w > 0.
  truth.H_first_second_ = truth.H_second_first_->inverse();
  return truth;
}

PixelTruth PixelTruth::FromCorrespondences(std::vector<float> x, std::vector<float> y,
                                           ImageSize first, ImageSize second) {
  const size_t pixels = static_cast<size_t>(first.width) * static_cast<size_t>(first.height);
  REGOLITH_CHECK(x.size() == pixels && y.size() == pixels, x.size(), " and ", y.size(),
                 " places for ", first.width, " x ", first.height, " pixels");
  PixelTruth truth(first, second);
  truth.x_ = std::move(x);
  truth.y_ = std::move(y);
  truth.MarkSeen();
  return truth;
}

void PixelTruth::MarkSeen() {
  seen_.assign(static_cast<size_t>(second_.width) * static_cast<size_t>(second_.height), 0);
  for (size_t i = 0; i < x_.size(); ++i) {
    if (std::isnan(x_[i]) || std::isnan(y_[i])) continue;
    // The four pixels around it, so that a surface seen from twice as near has no holes.
    if (!IsInside({x_[i], y_[i]}, second_)) continue;
    const int left = static_cast<int>(std::floor(x_[i]));
    const int top = static_cast<int>(std::floor(y_[i]));
    for (int row = std::max(top, 0); row <= std::min(top + 1, second_.height - 1); ++row) {
      for (int column = std::max(left, 0); column <= std::min(left + 1, second_.width - 1);
           ++column) {
        seen_[IndexOf(column, row, second_)] = 1;
      }
    }
  }
}

TruePlace PixelTruth::Find(const Eigen::Vector2d& pixel_first) const {
  if (H_second_first_) {
    const auto place = Transfer(*H_second_first_, pixel_first);
    if (!place) return {TruePlace::Kind::kAbsent, {}};
    return {TruePlace::Kind::kKnown, *place};
  }
  const Neighbours around = NeighboursOf(pixel_first, first_);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  size_t valid = 0;
  for (size_t k = 0; k < around.count; ++k) {
    const auto& [index, weight] = around.items[k];
    const Eigen::Vector2d place(x_[index], y_[index]);
    if (!place.allFinite()) continue;
    ++valid;
    sum += weight * place;
    low = low.min(place.array());
    high = high.max(place.array());
  }
  if (valid == 0) return {TruePlace::Kind::kAbsent, {}};
  if (valid < around.count || (high - low).maxCoeff() > kTear) return {};
  return {TruePlace::Kind::kKnown, sum};
}

std::vector<Eigen::Vector2d> PixelTruth::PossiblePlaces(const Eigen::Vector2d& pixel_first) const {
  const TruePlace place = Find(pixel_first);
  if (place.kind == TruePlace::Kind::kKnown) return {place.pixel};
  std::vector<Eigen::Vector2d> places;
  if (place.kind == TruePlace::Kind::kAbsent) return places;
  const Neighbours around = NeighboursOf(pixel_first, first_);
  for (size_t k = 0; k < around.count; ++k) {
    const Eigen::Vector2d neighbour(x_[around.items[k].index], y_[around.items[k].index]);
    if (neighbour.allFinite()) places.push_back(neighbour);
  }
  return places;
}

bool PixelTruth::IsInSecond(const Eigen::Vector2d& pixel_second) const {
  return IsInside(pixel_second, second_);
}

bool PixelTruth::IsSeenInFirst(const Eigen::Vector2d& pixel_second) const {
  if (H_first_second_) {
    const auto place = Transfer(*H_first_second_, pixel_second);
    return place && IsInside(*place, first_);
  }
  if (!IsInside(pixel_second, second_)) return false;
  const int column =
      std::clamp(static_cast<int>(std::lround(pixel_second.x())), 0, second_.width - 1);
  const int row =
      std::clamp(static_cast<int>(std::lround(pixel_second.y())), 0, second_.height - 1);
  return seen_[IndexOf(column, row, second_)] != 0;
}

std::optional<double> MatchCounts::Precision() const {
  if (known == 0) return std::nullopt;
  return static_cast<double>(correct) / known;
}

MatchScore ScoreMatches(Span<const ScoredMatch> matches, const PixelTruth& truth,
                        double tolerance) {
  REGOLITH_CHECK(tolerance >= 0.0, tolerance);
  MatchScore score;
  for (const ScoredMatch& match : matches) {
    const TruePlace place = truth.Find(match.first);
    const double error = place.kind == TruePlace::Kind::kKnown
                             ? (match.second - place.pixel).norm()
                             : std::numeric_limits<double>::quiet_NaN();
    MatchVerdict verdict = error <= tolerance ? MatchVerdict::kCorrect : MatchVerdict::kWrong;
    if (place.kind == TruePlace::Kind::kUnknown) verdict = MatchVerdict::kUnknown;
    score.verdicts.push_back(verdict);
    score.errors.push_back(error);
    Count(verdict, &score.all);
    if (match.inlier) Count(verdict, &score.inliers);
  }
  return score;
}

std::optional<double> Repeatability(Span<const Eigen::Vector2d> first,
                                    Span<const Eigen::Vector2d> second, const PixelTruth& truth,
                                    double radius) {
  const auto has_neighbour = [&](const Eigen::Vector2d& place, const auto& candidates) {
    return std::any_of(candidates.begin(), candidates.end(), [&](const Eigen::Vector2d& other) {
      return (other - place).squaredNorm() <= radius * radius;
    });
  };
  // Places just outside image 2 are partners of keypoints at its border.
  std::vector<Eigen::Vector2d> places;
  int shown = 0;
  int repeated = 0;
  for (const Eigen::Vector2d& keypoint : first) {
    const std::vector<Eigen::Vector2d> possible = truth.PossiblePlaces(keypoint);
    places.insert(places.end(), possible.begin(), possible.end());
    const TruePlace place = truth.Find(keypoint);
    if (place.kind != TruePlace::Kind::kKnown || !truth.IsInSecond(place.pixel)) continue;
    ++shown;
    repeated += has_neighbour(place.pixel, second) ? 1 : 0;
  }
  for (const Eigen::Vector2d& keypoint : second) {
    if (!truth.IsSeenInFirst(keypoint)) continue;
    ++shown;
    repeated += has_neighbour(keypoint, places) ? 1 : 0;
  }
  if (shown == 0) return std::nullopt;
  return static_cast<double>(repeated) / shown;
}

}  // namespace regolith

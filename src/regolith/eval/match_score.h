// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"

namespace regolith {

struct ImageSize {
  int width = 0;
  int height = 0;
};

/// Where a pixel of image 1 truly lies in image 2.
struct TruePlace {
  enum class Kind {
    kKnown,
    kAbsent,  ///< known not to be in image 2: occluded, sky, outside
    kUnknown,
  };
  Kind kind = Kind::kUnknown;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< where kKnown; may lie outside image 2
};

/// True correspondence of two images: pixel of the first to pixel of the second. Pixel centres lie
/// at integer coordinates.
class PixelTruth {
 public:
  /// A homography, homogeneous pixels of image 1 to image 2: known everywhere before its horizon.
  static PixelTruth FromHomography(const Eigen::Matrix3d& H_second_first, ImageSize first,
                                   ImageSize second);

  /// x and y in image 2 of every pixel of image 1, row by row; NaN where it is not seen there.
  /// Between pixels they are interpolated. A place is unknown where some of the neighbours are NaN,
  /// or land further apart than `kTear`: there a depth edge lies between them, and nobody can say
  /// on which side of it the point is. All neighbours NaN: the place is absent.
  static PixelTruth FromCorrespondences(std::vector<float> x, std::vector<float> y, ImageSize first,
                                        ImageSize second);

  /// Pixels in image 2 between neighbours of image 1; a surface comes four times nearer before it
  /// is taken for an edge.
  static constexpr double kTear = 4.0;

  TruePlace Find(const Eigen::Vector2d& pixel_first) const;
  /// Where it may lie: its place where that is known, at an edge that of each neighbour that has
  /// one.
  std::vector<Eigen::Vector2d> PossiblePlaces(const Eigen::Vector2d& pixel_first) const;
  /// Inside image 2.
  bool IsInSecond(const Eigen::Vector2d& pixel_second) const;
  /// Whether image 1 shows what image 2 shows there; to about a pixel.
  bool IsSeenInFirst(const Eigen::Vector2d& pixel_second) const;

 private:
  PixelTruth(ImageSize first, ImageSize second) : first_(first), second_(second) {}
  void MarkSeen();

  ImageSize first_;
  ImageSize second_;
  std::optional<Eigen::Matrix3d> H_second_first_;
  std::optional<Eigen::Matrix3d> H_first_second_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<uint8_t> seen_;  ///< pixels of image 2 next to one that a pixel of image 1 lands on
};

struct ScoredMatch {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Vector2d second = Eigen::Vector2d::Zero();
  bool inlier = true;
};

enum class MatchVerdict {
  kCorrect,
  kWrong,    ///< further from the true place than the tolerance, or image 2 does not show it
  kUnknown,  ///< truth does not say
};

/// Counts of some matches against truth.
struct MatchCounts {
  int matches = 0;
  int known = 0;  ///< of them correct or wrong
  int correct = 0;

  /// Share of those known; nothing where there are none.
  std::optional<double> Precision() const;
};

struct MatchScore {
  std::vector<MatchVerdict> verdicts;  ///< one a match
  std::vector<double> errors;          ///< pixels, one a match; NaN where there is no true place
  MatchCounts all;
  MatchCounts inliers;
};

/// Compares matches with the truth; within `tolerance` pixels of the true place one is correct.
MatchScore ScoreMatches(Span<const ScoredMatch> matches, const PixelTruth& truth, double tolerance);

/// Share of the keypoints whose place both images show that have a keypoint of the other image
/// within `radius` pixels of it: those of both images counted together (as DeTone et al. 2018), all
/// distances in image 2. Keypoints of image 1 whose place is unknown are partners of others, but
/// are not counted themselves. Nothing where no keypoint is shown twice.
std::optional<double> Repeatability(Span<const Eigen::Vector2d> first,
                                    Span<const Eigen::Vector2d> second, const PixelTruth& truth,
                                    double radius);

}  // namespace regolith

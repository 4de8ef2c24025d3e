// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_frontend.h"

#include <algorithm>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

// Pairs in a row that fit only the wrong way round, before that is said to be the cause.
constexpr int kReversedPairs = 5;
constexpr int kLeastReversed = 40;  // keypoints
constexpr int kReversedShare = 3;   // times as many as fit the right way round

/// Both eyes infer at the same time and share the threads.
FeatureOptions ForOneEye(FeatureOptions options) {
  if (options.frontend == "st_lk") {
    throw InputError(
        "features.frontend",
        "`st_lk` has no descriptors, which stereo matching needs; expected orb, ghost, "
        "ghost_paper or superpoint");
  }
  options.network.threads = std::max(1, options.network.threads / 2);
  return options;
}

}  // namespace

StereoFrontend::StereoFrontend(const FeatureOptions& features,
                               const std::optional<ModelManifest>& model,
                               const StereoOptions& options, const CameraIntrinsics& left,
                               const CameraIntrinsics& right, const SE3& T_left_right,
                               const std::optional<Image>& mask, ThreadPool* threads)
    : rectifier_(left, right, T_left_right),
      left_mask_(rectifier_.LeftMask(mask ? &*mask : nullptr)),
      right_mask_(rectifier_.RightMask()),
      max_keypoints_(features.max_keypoints),
      cuts_patches_(options.alignment.enabled),
      left_(FeatureExtractor::Create(ForOneEye(features), model)),
      right_(FeatureExtractor::Create(ForOneEye(features), model)),
      matcher_(options.epipolar, rectifier_.camera()),
      threads_(threads) {}

StereoObservation StereoFrontend::Observe(const Image& left, const Image& right) {
  Stopwatch stopwatch;
  Image left_image;
  Image right_image;
  FeatureSet left_set;
  FeatureSet right_set;
  threads_->ParallelFor(2, 1, [&](size_t begin, size_t, size_t) {
    if (begin == 0) {
      left_image = rectifier_.Left(left);
      left_->Extract(left_image, &left_mask_, max_keypoints_, &left_set);
    } else {
      right_image = rectifier_.Right(right);
      right_->Extract(right_image, &right_mask_, max_keypoints_, &right_set);
    }
  });
  stopwatch.Lap("stereo_features");
  StereoObservation observation;
  observation.features = matcher_.Match(left_image, right_image, left_set, right_set);
  if (cuts_patches_ && !observation.features.has_scales) {
    for (const Eigen::Vector2f& pixel : observation.features.pixels) {
      observation.features.patches.push_back(CutPatch(left_image, pixel));
    }
  }
  observation.left_keypoints = static_cast<int>(left_set.size());
  observation.right_keypoints = static_cast<int>(right_set.size());
  for (size_t i = 0; i < observation.features.size(); ++i) {
    observation.with_distance += observation.features.HasRight(i) ? 1 : 0;
  }
  observation.detection = left_->status();
  CheckOrder(left_set, right_set, observation.with_distance);
  stopwatch.Lap("stereo_match");
  observation.stages = stopwatch.stages();
  return observation;
}

void StereoFrontend::CheckOrder(const FeatureSet& left, const FeatureSet& right,
                                int with_distance) {
  if (with_distance >= kLeastReversed) {
    reversed_pairs_ = 0;
    return;
  }
  const int reversed = matcher_.CountReversed(left, right);
  const bool is_reversed = reversed >= kLeastReversed && reversed >= kReversedShare * with_distance;
  reversed_pairs_ = is_reversed ? reversed_pairs_ + 1 : 0;
  if (reversed_pairs_ < kReversedPairs) return;
  throw InputError(
      "stereo pair",
      Concatenate(reversed, " keypoints fit with left and right exchanged, ", with_distance,
                  " as they are: the images are swapped; exchange the topics of `left` and "
                  "`right` in the rig"));
}

}  // namespace regolith

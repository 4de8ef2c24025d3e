// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/matching_frontend.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "regolith/features/neighbour_motion.h"
#include "regolith/features/outlier_rejection.h"
#include "regolith/features/track_stream.h"
#include "regolith/features/view_warp.h"

namespace regolith {
namespace {

DescriptorMatcherOptions GuidedOptions(DescriptorMatcherOptions options) {
  options.ratio = options.guided_ratio;
  options.min_similarity = options.guided_similarity;
  return options;
}

class MatchingFrontend final : public FeatureFrontend {
 public:
  MatchingFrontend(const FeatureOptions& options, const CameraModel* camera,
                   std::unique_ptr<FeatureExtractor> extractor)
      : options_(options),
        extractor_(std::move(extractor)),
        matcher_(options.matcher),
        guided_matcher_(GuidedOptions(options.matcher)),
        stream_(options, camera) {}

  TrackedFrame Track(const FrontendInput& input) override {
    const bool follows = stream_.Begin(input);
    TrackedFrame frame;
    Stopwatch stopwatch;
    Detect(*input.image, input.mask, &keypoints_, &bearings_);
    stopwatch.Lap("extract");
    AppendStages("features_extract", *extractor_, stopwatch.stages().back().milliseconds,
                 &frame.stages);
    matches_.clear();
    if (follows) MatchTracks();
    stopwatch.Lap("features_match");
    const int rejected = RejectMatches();
    stopwatch.Lap("features_reject");
    ContinueTracks();
    stream_.Finish(extractor_->status(), &frame);
    frame.status.detected = detected_;
    frame.status.rejected = rejected;
    stopwatch.Lap("features_track");
    frame.stages.insert(frame.stages.end(), stopwatch.stages().begin() + 1,
                        stopwatch.stages().end());
    return frame;
  }

  PairMatches MatchPair(const Image& first, const Image& second) override;

  void Reset() override {
    stream_.Reset();
    extractor_->Reset();
  }

 private:
  /// Keypoints with their bearings; those without one are dropped.
  void Detect(const Image& image, const Image* mask, FeatureSet* keypoints,
              std::vector<Eigen::Vector3d>* bearings);
  void FindBearings(FeatureSet* keypoints, std::vector<Eigen::Vector3d>* bearings) const;
  void MatchTracks();
  /// Leaves the inliers in matches_; says how many were not.
  int RejectMatches();
  void ContinueTracks();
  /// Matches a pair's keypoints and rejects outliers for a first time. `bearings` are those of the
  /// keypoints.
  void MatchFirst(const Correspondences& bearings, PairMatches* pair);
  /// Looks at the farther image again as from where the nearer one was taken; what is found so
  /// takes the place of `pair` and `bearings` if more of it agrees.
  void LookAgain(const Image& first, const Image& second, Correspondences* bearings,
                 PairMatches* pair);
  /// The places and bearings of the pair's matches.
  Correspondences Matched(const PairMatches& pair, const Correspondences& bearings) const;
  /// Matches a pair again, near where its inliers lead.
  void MatchGuided(const Correspondences& bearings, PairMatches* pair);

  Observation Observed(size_t keypoint) const {
    return {keypoints_.pixels[keypoint], bearings_[keypoint], &keypoints_.descriptors, keypoint};
  }

  FeatureOptions options_;
  std::unique_ptr<FeatureExtractor> extractor_;
  DescriptorMatcher matcher_;
  DescriptorMatcher guided_matcher_;
  TrackStream stream_;

  FeatureSet keypoints_;
  std::vector<Eigen::Vector3d> bearings_;
  int detected_ = 0;
  MatchGuide guide_;
  std::vector<FeatureMatch> matches_;
  Correspondences correspondences_;
  std::vector<uint8_t> claimed_;  ///< 1 for keypoints that belong to a track
  std::vector<size_t> left_;      ///< keypoints that do not
  std::vector<Eigen::Vector2f> left_pixels_;
  Descriptors left_descriptors_;
  std::vector<RecoveredTrack> recovered_;
};

void MatchingFrontend::Detect(const Image& image, const Image* mask, FeatureSet* keypoints,
                              std::vector<Eigen::Vector3d>* bearings) {
  extractor_->Extract(image, mask, options_.max_keypoints, keypoints);
  detected_ = static_cast<int>(keypoints->size());
  FindBearings(keypoints, bearings);
}

void MatchingFrontend::FindBearings(FeatureSet* keypoints,
                                    std::vector<Eigen::Vector3d>* bearings) const {
  bearings->clear();
  std::vector<size_t> blind;
  for (size_t i = 0; i < keypoints->size(); ++i) {
    const auto bearing = stream_.geometry().Bearing(keypoints->pixels[i]);
    if (!bearing) blind.push_back(i);
    bearings->push_back(bearing.value_or(Eigen::Vector3d::Zero()));
  }
  if (blind.empty()) return;
  FeatureSet seen;
  seen.descriptors.ResetLike(keypoints->descriptors);
  std::vector<Eigen::Vector3d> seen_bearings;
  for (size_t i = 0; i < keypoints->size(); ++i) {
    if (std::binary_search(blind.begin(), blind.end(), i)) continue;
    seen.pixels.push_back(keypoints->pixels[i]);
    seen.scores.push_back(keypoints->scores[i]);
    seen.descriptors.Append(keypoints->descriptors, i);
    seen_bearings.push_back((*bearings)[i]);
  }
  *keypoints = std::move(seen);
  *bearings = std::move(seen_bearings);
}

void MatchingFrontend::MatchTracks() {
  if (stream_.tracks().empty() || keypoints_.size() == 0) return;
  guide_.predicted = stream_.predicted();
  guide_.radii.assign(guide_.predicted.size(), static_cast<float>(options_.memory.search_radius));
  matcher_.MatchGuided(stream_.descriptors(), keypoints_.descriptors, guide_, keypoints_.pixels,
                       &matches_);
}

int MatchingFrontend::RejectMatches() {
  correspondences_ = Correspondences();
  for (const FeatureMatch& match : matches_) {
    const TrackedFeature& track = stream_.tracks()[static_cast<size_t>(match.first)];
    const auto keypoint = static_cast<size_t>(match.second);
    stream_.geometry().Append({track.pixel, track.bearing},
                              {keypoints_.pixels[keypoint], bearings_[keypoint]},
                              &correspondences_);
  }
  return KeepInliers(stream_.Inliers(correspondences_, options_.rejection), &matches_);
}

void MatchingFrontend::ContinueTracks() {
  claimed_.assign(keypoints_.size(), 0);
  for (const FeatureMatch& match : matches_) {
    claimed_[static_cast<size_t>(match.second)] = 1;
    stream_.Continue(static_cast<size_t>(match.first), Observed(static_cast<size_t>(match.second)));
  }
  stream_.EndContinuing();
  left_.clear();
  left_pixels_.clear();
  left_descriptors_.ResetLike(keypoints_.descriptors);
  for (size_t i = 0; i < keypoints_.size(); ++i) {
    if (claimed_[i] != 0) continue;
    left_.push_back(i);
    left_pixels_.push_back(keypoints_.pixels[i]);
    left_descriptors_.Append(keypoints_.descriptors, i);
  }
  // Before the tracks lost in this frame are remembered: their matches have just been refused.
  stream_.Recover(left_pixels_, left_descriptors_, &recovered_);
  stream_.RememberUnseen({});
  for (const RecoveredTrack& track : recovered_) {
    const size_t keypoint = left_[static_cast<size_t>(track.keypoint)];
    claimed_[keypoint] = 1;
    stream_.Resume(track.feature, Observed(keypoint));
  }
  for (const size_t keypoint : left_) {
    if (claimed_[keypoint] == 0) stream_.Start(keypoints_.scores[keypoint], Observed(keypoint));
  }
}

PairMatches MatchingFrontend::MatchPair(const Image& first, const Image& second) {
  const TrackGeometry& geometry = stream_.geometry();
  geometry.CheckImage(first);
  geometry.CheckImage(second);
  PairMatches pair;
  // The stream's thresholds are forgotten, so that a pair does not depend on what came before.
  extractor_->Reset();
  Stopwatch stopwatch;
  Correspondences bearings;
  Detect(first, nullptr, &pair.first, &bearings.first_bearings);
  stopwatch.Lap("extract");
  AppendStages("extract_1", *extractor_, stopwatch.stages().back().milliseconds, &pair.stages);
  pair.first_status = extractor_->status();
  Stopwatch second_stopwatch;
  Detect(second, nullptr, &pair.second, &bearings.second_bearings);
  second_stopwatch.Lap("extract");
  AppendStages("extract_2", *extractor_, second_stopwatch.stages().back().milliseconds,
               &pair.stages);
  pair.second_status = extractor_->status();
  Stopwatch rest;
  MatchFirst(bearings, &pair);
  rest.Lap("match_first");
  if (options_.matcher.second_look) {
    LookAgain(first, second, &bearings, &pair);
    rest.Lap("look_again");
  }
  // Where bits are compared, the guided time brings more wrong ones than right ones.
  if (options_.matcher.guided && pair.first.descriptors.type == DescriptorType::kFloat) {
    MatchGuided(bearings, &pair);
  }
  FinishPair(Matched(pair, bearings), geometry, options_.rejection, &rest, &pair);
  return pair;
}

void MatchingFrontend::MatchFirst(const Correspondences& bearings, PairMatches* pair) {
  pair->matches.clear();
  if (pair->first.size() > 0 && pair->second.size() > 0) {
    matcher_.Match(pair->first.descriptors, pair->second.descriptors, &pair->matches);
  }
  OutlierRejection rejection = RejectOutliers(Matched(*pair, bearings), stream_.geometry().focal(),
                                              std::nullopt, options_.rejection);
  pair->inliers = std::move(rejection.inliers);
}

void MatchingFrontend::LookAgain(const Image& first, const Image& second, Correspondences* bearings,
                                 PairMatches* pair) {
  const Correspondences matched = Matched(*pair, *bearings);
  const auto H_second_first = PlaneHomography(matched.first, matched.second, pair->inliers);
  if (!H_second_first) return;
  // The farther one is enlarged: the other way round, details would be lost.
  const bool first_is_farther = MedianEnlargement(*H_second_first, matched.first) >= 1.0;
  const Image& farther = first_is_farther ? first : second;
  const Image& nearer = first_is_farther ? second : first;
  const Eigen::Matrix3d H_near_far =
      first_is_farther ? *H_second_first : Eigen::Matrix3d(H_second_first->inverse());
  const WarpedView view =
      WarpImage(farther, H_near_far, nearer.width, nearer.height, options_.border);
  PairMatches again = *pair;
  Correspondences again_bearings = *bearings;
  FeatureSet* keypoints = first_is_farther ? &again.first : &again.second;
  extractor_->Reset();
  extractor_->Extract(view.image, &view.mask, options_.max_keypoints, keypoints);
  const Eigen::Matrix3d H_far_near = H_near_far.inverse();
  keypoints->scales.clear();  // they would be the view's
  for (Eigen::Vector2f& pixel : keypoints->pixels) {
    pixel = (H_far_near * pixel.cast<double>().homogeneous()).hnormalized().cast<float>();
  }
  FindBearings(keypoints,
               first_is_farther ? &again_bearings.first_bearings : &again_bearings.second_bearings);
  MatchFirst(again_bearings, &again);
  const auto agreeing = [](const PairMatches& one) {
    return std::count(one.inliers.begin(), one.inliers.end(), uint8_t{1});
  };
  if (agreeing(again) <= agreeing(*pair)) return;
  again.looked_again = first_is_farther ? 1 : 2;
  *pair = std::move(again);
  *bearings = std::move(again_bearings);
}

Correspondences MatchingFrontend::Matched(const PairMatches& pair,
                                          const Correspondences& bearings) const {
  Correspondences matched;
  for (const FeatureMatch& match : pair.matches) {
    const auto one = static_cast<size_t>(match.first);
    const auto other = static_cast<size_t>(match.second);
    stream_.geometry().Append({pair.first.pixels[one], bearings.first_bearings[one]},
                              {pair.second.pixels[other], bearings.second_bearings[other]},
                              &matched);
  }
  return matched;
}

void MatchingFrontend::MatchGuided(const Correspondences& bearings, PairMatches* pair) {
  const Correspondences matched = Matched(*pair, bearings);
  if (!PredictFromNeighbours(matched.first, matched.second, pair->inliers, pair->first.pixels,
                             options_.rejection, &guide_)) {
    return;
  }
  guided_matcher_.MatchGuided(pair->first.descriptors, pair->second.descriptors, guide_,
                              pair->second.pixels, &pair->matches);
}

}  // namespace

std::unique_ptr<FeatureFrontend> CreateMatchingFrontend(
    const FeatureOptions& options, const CameraModel* camera,
    std::unique_ptr<FeatureExtractor> extractor) {
  return std::make_unique<MatchingFrontend>(options, camera, std::move(extractor));
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/lk_frontend.h"

#include <algorithm>
#include <numeric>

#include "regolith/features/free_pixels.h"
#include "regolith/features/optical_flow.h"
#include "regolith/features/outlier_rejection.h"
#include "regolith/features/track_stream.h"

namespace regolith {
namespace {

// Grey levels: a flow's error at which its patches have nothing in common.
constexpr float kGreyRange = 255.0F;

class LkFrontend final : public FeatureFrontend {
 public:
  LkFrontend(const FeatureOptions& options, const CameraModel* camera,
             std::unique_ptr<FeatureExtractor> extractor)
      : options_(options),
        extractor_(std::move(extractor)),
        flow_(options.optical_flow),
        pair_flow_(options.optical_flow),
        stream_(options, camera) {}

  TrackedFrame Track(const FrontendInput& input) override;
  PairMatches MatchPair(const Image& first, const Image& second) override;

  void Reset() override {
    stream_.Reset();
    flow_.Reset();
    extractor_->Reset();
  }

 private:
  /// What the flow found of a track.
  struct Survivor {
    size_t track = 0;
    Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
    Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  };

  void FollowTracks();
  /// Leaves the inliers among the survivors; says how many were not.
  int RejectSurvivors();
  /// Where two tracks have met, the longer stays.
  void KeepApart();
  void DescribeSurvivors();
  void ContinueTracks();
  void AddTracks();

  FeatureOptions options_;
  std::unique_ptr<FeatureExtractor> extractor_;
  OpticalFlow flow_;
  OpticalFlow pair_flow_;
  TrackStream stream_;
  FreePixels free_;
  EvenSelection selection_;

  FlowResult flow_result_;
  std::vector<Eigen::Vector2f> points_;
  std::vector<Survivor> survivors_;
  std::vector<uint8_t> merged_;  ///< 1 for tracks that met a longer one
  Correspondences correspondences_;
  Descriptors survivor_descriptors_;  ///< anew; empty where the extractor was not asked
  FeatureSet found_;
  std::vector<RecoveredTrack> recovered_;
  FeatureSet apart_;
  std::vector<Eigen::Vector3d> apart_bearings_;
  std::vector<size_t> order_;
  std::vector<int> rows_;
};

TrackedFrame LkFrontend::Track(const FrontendInput& input) {
  const bool follows = stream_.Begin(input);
  if (!follows) flow_.Reset();
  TrackedFrame frame;
  Stopwatch stopwatch;
  const Image& image = *input.image;
  flow_.Advance(image);
  free_.Reset(image.width, image.height, input.mask, options_.border);
  FollowTracks();
  stopwatch.Lap("features_track");
  const int rejected = RejectSurvivors();
  KeepApart();
  stopwatch.Lap("features_reject");
  frame.stages = stopwatch.stages();
  found_ = FeatureSet();
  survivor_descriptors_ = Descriptors();
  DetectionStatus detection;
  const double enough = options_.redetect_share * options_.max_keypoints;
  if (static_cast<double>(survivors_.size()) < enough) {
    extractor_->Extract(image, &free_.image(), options_.max_keypoints, &found_);
    detection = extractor_->status();
    DescribeSurvivors();
    stopwatch.Lap("extract");
    AppendStages("features_extract", *extractor_, stopwatch.stages().back().milliseconds,
                 &frame.stages);
  }
  ContinueTracks();
  AddTracks();
  stream_.Finish(detection, &frame);
  frame.status.detected = static_cast<int>(found_.size());
  frame.status.rejected = rejected;
  stopwatch.Lap("features_match");
  frame.stages.push_back(stopwatch.stages().back());
  return frame;
}

void LkFrontend::FollowTracks() {
  survivors_.clear();
  if (stream_.tracks().empty()) return;
  points_.clear();
  for (const TrackedFeature& track : stream_.tracks()) points_.push_back(track.pixel);
  flow_.Track(points_, stream_.predicted(), &flow_result_);
  for (size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2f& pixel = flow_result_.pixels[i];
    if (flow_result_.found[i] == 0 || !free_.IsFree(pixel)) continue;
    const std::optional<Eigen::Vector3d> bearing = stream_.geometry().Bearing(pixel);
    if (bearing) survivors_.push_back({i, pixel, *bearing});
  }
}

int LkFrontend::RejectSurvivors() {
  correspondences_ = Correspondences();
  for (const Survivor& survivor : survivors_) {
    const TrackedFeature& track = stream_.tracks()[survivor.track];
    stream_.geometry().Append({track.pixel, track.bearing}, {survivor.pixel, survivor.bearing},
                              &correspondences_);
  }
  return KeepInliers(stream_.Inliers(correspondences_, options_.rejection), &survivors_);
}

void LkFrontend::KeepApart() {
  const std::vector<TrackedFeature>& tracks = stream_.tracks();
  merged_.assign(tracks.size(), 0);
  order_.resize(survivors_.size());
  std::iota(order_.begin(), order_.end(), size_t{0});
  std::sort(order_.begin(), order_.end(), [&](size_t a, size_t b) {
    const TrackedFeature& first = tracks[survivors_[a].track];
    const TrackedFeature& second = tracks[survivors_[b].track];
    return first.age != second.age ? first.age > second.age : first.id < second.id;
  });
  for (const size_t index : order_) {
    const Survivor& survivor = survivors_[index];
    // Half the distance that new points keep: flows of neighbours differ a little.
    if (free_.IsFree(survivor.pixel)) {
      free_.Take(survivor.pixel, std::max(1, options_.min_distance / 2));
    } else {
      merged_[survivor.track] = 1;
    }
  }
  survivors_.erase(std::remove_if(survivors_.begin(), survivors_.end(),
                                  [this](const Survivor& s) { return merged_[s.track] != 0; }),
                   survivors_.end());
  for (const Survivor& survivor : survivors_) free_.Take(survivor.pixel, options_.min_distance);
}

void LkFrontend::DescribeSurvivors() {
  points_.clear();
  for (const Survivor& survivor : survivors_) points_.push_back(survivor.pixel);
  survivor_descriptors_ = extractor_->Describe(points_);
}

void LkFrontend::ContinueTracks() {
  const bool described = !survivors_.empty() && survivor_descriptors_.size() == survivors_.size();
  for (size_t i = 0; i < survivors_.size(); ++i) {
    const Survivor& survivor = survivors_[i];
    stream_.Continue(survivor.track, {survivor.pixel, survivor.bearing,
                                      described ? &survivor_descriptors_ : &stream_.descriptors(),
                                      described ? i : survivor.track});
  }
  stream_.EndContinuing();
}

void LkFrontend::AddTracks() {
  const auto most = static_cast<size_t>(options_.max_keypoints);
  // All that were found are asked, for more of them may be lost tracks than there is room for new
  // ones.
  recovered_.clear();
  if (found_.descriptors.size() > 0) {
    stream_.Recover(found_.pixels, found_.descriptors, &recovered_);
  }
  stream_.RememberUnseen(merged_);
  const auto observe = [&](const FeatureSet& set, size_t row, const Eigen::Vector3d& bearing) {
    return Observation{set.pixels[row], bearing, &set.descriptors, row};
  };
  for (const RecoveredTrack& track : recovered_) {
    const auto row = static_cast<size_t>(track.keypoint);
    const auto bearing = stream_.geometry().Bearing(found_.pixels[row]);
    if (!bearing || !free_.IsFree(found_.pixels[row]) || stream_.pixels().size() >= most) continue;
    free_.Take(found_.pixels[row], options_.min_distance);
    stream_.Resume(track.feature, observe(found_, row, *bearing));
  }
  apart_ = FeatureSet();
  apart_.descriptors.ResetLike(found_.descriptors);
  apart_bearings_.clear();
  for (size_t row = 0; row < found_.size(); ++row) {
    const auto bearing = stream_.geometry().Bearing(found_.pixels[row]);
    if (!bearing || !free_.IsFree(found_.pixels[row])) continue;
    free_.Take(found_.pixels[row], options_.min_distance);
    apart_.pixels.push_back(found_.pixels[row]);
    apart_.scores.push_back(found_.scores[row]);
    apart_.descriptors.Append(found_.descriptors, row);
    apart_bearings_.push_back(*bearing);
  }
  const size_t room = most - std::min(most, stream_.pixels().size());
  selection_.Select(stream_.grid(), stream_.pixels(), apart_.pixels, static_cast<int>(room),
                    &rows_);
  for (const int selected : rows_) {
    const auto row = static_cast<size_t>(selected);
    stream_.Start(apart_.scores[row], observe(apart_, row, apart_bearings_[row]));
  }
}

PairMatches LkFrontend::MatchPair(const Image& first, const Image& second) {
  const TrackGeometry& geometry = stream_.geometry();
  geometry.CheckImage(first);
  geometry.CheckImage(second);
  PairMatches pair;
  // The stream's thresholds are forgotten, so that a pair does not depend on what came before.
  extractor_->Reset();
  pair_flow_.Reset();
  Stopwatch stopwatch;
  extractor_->Extract(first, nullptr, options_.max_keypoints, &pair.first);
  stopwatch.Lap("extract");
  AppendStages("extract_1", *extractor_, stopwatch.stages().back().milliseconds, &pair.stages);
  pair.first_status = extractor_->status();
  Stopwatch rest;
  pair_flow_.Advance(first);
  pair_flow_.Advance(second);
  FlowResult flow;
  if (pair.first.size() > 0) pair_flow_.Track(pair.first.pixels, {}, &flow);
  Correspondences matched;
  for (size_t i = 0; i < flow.pixels.size(); ++i) {
    const auto one = geometry.Bearing(pair.first.pixels[i]);
    const auto other = geometry.Bearing(flow.pixels[i]);
    if (flow.found[i] == 0 || !one || !other) continue;
    pair.matches.push_back({static_cast<int>(i), static_cast<int>(pair.second.size()),
                            1.0F - flow.errors[i] / kGreyRange});
    pair.second.pixels.push_back(flow.pixels[i]);
    pair.second.scores.push_back(pair.first.scores[i]);
    geometry.Append({pair.first.pixels[i], *one}, {flow.pixels[i], *other}, &matched);
  }
  FinishPair(matched, geometry, options_.rejection, &rest, &pair);
  return pair;
}

}  // namespace

std::unique_ptr<FeatureFrontend> CreateLkFrontend(const FeatureOptions& options,
                                                  const CameraModel* camera,
                                                  std::unique_ptr<FeatureExtractor> extractor) {
  return std::make_unique<LkFrontend>(options, camera, std::move(extractor));
}

}  // namespace regolith

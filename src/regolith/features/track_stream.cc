// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/track_stream.h"

#include <algorithm>
#include <numeric>

#include "regolith/core/check.h"

namespace regolith {

TrackStream::TrackStream(const FeatureOptions& options, const CameraModel* camera)
    : geometry_(camera),
      cell_size_(options.adaptive.cell_size),
      // As many lost tracks as can be followed: matching them costs no more than matching those.
      memory_(options.memory, options.matcher, options.max_keypoints) {}

bool TrackStream::Begin(const FrontendInput& input) {
  REGOLITH_CHECK(input.image != nullptr, "no image");
  const Image& image = *input.image;
  geometry_.CheckImage(image);
  const bool follows =
      has_last_ && input.time > last_time_ && image.width == width_ && image.height == height_;
  if (!follows) Reset();
  if (image.width != width_ || image.height != height_) {
    grid_ = KeypointGrid(image.width, image.height, cell_size_);
  }
  seconds_ = follows ? SecondsBetween(last_time_, input.time) : 0.0;
  has_last_ = true;
  last_time_ = input.time;
  width_ = image.width;
  height_ = image.height;
  R_current_previous_.reset();
  if (follows && input.R_previous_current) {
    R_current_previous_ = input.R_previous_current->conjugate();
  }
  predicted_.clear();
  for (const TrackedFeature& track : tracks_) {
    predicted_.push_back(geometry_.Rotated(track.pixel, track.bearing, R_current_previous_));
  }
  seen_.assign(tracks_.size(), 0);
  flow_pixels_.clear();
  flows_.clear();
  features_.clear();
  pixels_.clear();
  status_ = FrontendStatus();
  return follows;
}

void TrackStream::Append(const TrackedFeature& feature, const Observation& observation) {
  if (features_.empty()) feature_descriptors_.ResetLike(*observation.descriptors);
  features_.push_back(feature);
  features_.back().pixel = observation.pixel;
  features_.back().bearing = observation.bearing;
  pixels_.push_back(observation.pixel);
  feature_descriptors_.Append(*observation.descriptors, observation.row);
}

std::vector<uint8_t> TrackStream::Inliers(const Correspondences& matches,
                                          const OutlierRejectionOptions& options) const {
  if (matches.first.empty()) return {};
  return RejectOutliers(matches, geometry_.focal(), R_current_previous_, options).inliers;
}

void TrackStream::Continue(size_t track, const Observation& observation) {
  TrackedFeature feature = tracks_[track];
  feature.velocity = (observation.pixel - feature.pixel).cast<double>() / seconds_;
  ++feature.age;
  feature.recovered = false;
  seen_[track] = 1;
  ++status_.tracked;
  flow_pixels_.push_back(tracks_[track].pixel);
  flows_.emplace_back(observation.pixel - predicted_[track]);
  Append(feature, observation);
}

void TrackStream::EndContinuing() {
  flow_.Estimate(grid_, flow_pixels_, flows_);
  memory_.Advance(geometry_, R_current_previous_, flow_);
}

void TrackStream::Recover(const std::vector<Eigen::Vector2f>& pixels,
                          const Descriptors& descriptors, std::vector<RecoveredTrack>* recovered) {
  memory_.Recover(pixels, descriptors, recovered);
}

void TrackStream::RememberUnseen(const std::vector<uint8_t>& forget) {
  if (descriptors_.type == DescriptorType::kNone) return;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (seen_[i] != 0 || (!forget.empty() && forget[i] != 0)) continue;
    TrackedFeature feature = tracks_[i];
    if (MoveUnseen(geometry_, R_current_previous_, flow_, &feature)) {
      memory_.Add(feature, descriptors_, i);
    }
  }
  memory_.Trim();
}

void TrackStream::Resume(const TrackedFeature& lost, const Observation& observation) {
  TrackedFeature feature = lost;
  feature.velocity.setZero();  // the frame before did not see it
  ++feature.age;
  feature.recovered = true;
  ++status_.recovered;
  Append(feature, observation);
}

void TrackStream::Start(float score, const Observation& observation) {
  TrackedFeature feature;
  feature.id = next_id_++;
  feature.score = score;
  ++status_.started;
  Append(feature, observation);
}

void TrackStream::Finish(const DetectionStatus& detection, TrackedFrame* frame) {
  order_.resize(features_.size());
  std::iota(order_.begin(), order_.end(), size_t{0});
  std::sort(order_.begin(), order_.end(),
            [this](size_t a, size_t b) { return features_[a].id < features_[b].id; });
  tracks_.clear();
  descriptors_.ResetLike(features_.empty() ? Descriptors() : feature_descriptors_);
  double ages = 0.0;
  for (const size_t index : order_) {
    tracks_.push_back(features_[index]);
    descriptors_.Append(feature_descriptors_, index);
    ages += features_[index].age;
  }
  frame->time = last_time_;
  frame->features = tracks_;
  frame->descriptors = descriptors_;
  frame->status = status_;
  frame->status.detection = detection;
  frame->status.mean_age = tracks_.empty() ? 0.0 : ages / static_cast<double>(tracks_.size());
  grid_.CountFilled(pixels_, &frame->status.detection);
}

void TrackStream::Reset() {
  has_last_ = false;
  tracks_.clear();
  descriptors_ = Descriptors();
  memory_.Clear();
}

void FinishPair(const Correspondences& matched, const TrackGeometry& geometry,
                const OutlierRejectionOptions& options, Stopwatch* stopwatch, PairMatches* pair) {
  stopwatch->Lap("match");
  OutlierRejection rejection = RejectOutliers(matched, geometry.focal(), std::nullopt, options);
  pair->inliers = std::move(rejection.inliers);
  pair->rejection_model = rejection.model;
  stopwatch->Lap("reject");
  pair->stages.insert(pair->stages.end(), stopwatch->stages().begin(), stopwatch->stages().end());
}

void AppendStages(const std::string& prefix, const FeatureExtractor& extractor, double milliseconds,
                  std::vector<StageTime>* stages) {
  if (extractor.stages().empty()) stages->push_back({prefix, milliseconds});
  for (const StageTime& stage : extractor.stages()) {
    stages->push_back({prefix + "_" + stage.name, stage.milliseconds});
  }
}

}  // namespace regolith

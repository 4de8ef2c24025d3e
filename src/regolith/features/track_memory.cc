// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/track_memory.h"

#include <algorithm>
#include <numeric>

namespace regolith {
namespace {

// What is lost may be hidden for ever, so that its nearest neighbour is something else: a match
// needs more than one of frame after frame.
constexpr double kRatioShare = 0.9;
constexpr double kSimilarityShare = 0.25;  // of what min_similarity leaves to 1
constexpr double kHammingShare = 0.75;
// A frame more, a larger error of the predicted place.
constexpr float kRadiusGrowth = 0.2F;

DescriptorMatcherOptions Stricter(DescriptorMatcherOptions options) {
  options.ratio *= kRatioShare;
  options.min_similarity += kSimilarityShare * (1.0 - options.min_similarity);
  options.max_hamming = static_cast<int>(options.max_hamming * kHammingShare);
  options.mutual = true;
  return options;
}

}  // namespace

bool MoveUnseen(const TrackGeometry& geometry,
                const std::optional<Eigen::Quaterniond>& R_current_previous, const FlowField& flow,
                TrackedFeature* feature) {
  const Eigen::Vector2f rotated =
      geometry.Rotated(feature->pixel, feature->bearing, R_current_previous);
  feature->pixel = rotated + flow.At(feature->pixel);
  const std::optional<Eigen::Vector3d> bearing = geometry.Bearing(feature->pixel);
  if (bearing) feature->bearing = *bearing;
  return bearing.has_value();
}

TrackMemory::TrackMemory(const TrackMemoryOptions& options, const DescriptorMatcherOptions& matcher,
                         int capacity)
    : options_(options), capacity_(static_cast<size_t>(capacity)), matcher_(Stricter(matcher)) {}

void TrackMemory::Clear() {
  tracks_.clear();
  descriptors_.values.clear();
  descriptors_.bits.clear();
}

void TrackMemory::Advance(const TrackGeometry& geometry,
                          const std::optional<Eigen::Quaterniond>& R_current_previous,
                          const FlowField& flow) {
  kept_.assign(tracks_.size(), 1);
  for (size_t i = 0; i < tracks_.size(); ++i) {
    LostTrack& track = tracks_[i];
    ++track.frames_lost;
    const bool visible = MoveUnseen(geometry, R_current_previous, flow, &track.feature);
    kept_[i] = visible && track.frames_lost <= options_.frames ? 1 : 0;
  }
  Keep(kept_);
}

void TrackMemory::Recover(Span<const Eigen::Vector2f> pixels, const Descriptors& descriptors,
                          std::vector<RecoveredTrack>* recovered) {
  recovered->clear();
  if (tracks_.empty() || pixels.empty()) return;
  guide_.predicted.clear();
  guide_.radii.clear();
  for (const LostTrack& track : tracks_) {
    guide_.predicted.push_back(track.feature.pixel);
    guide_.radii.push_back(static_cast<float>(options_.search_radius) *
                           (1.0F + kRadiusGrowth * static_cast<float>(track.frames_lost)));
  }
  keypoint_pixels_.assign(pixels.begin(), pixels.end());
  matcher_.MatchGuided(descriptors_, descriptors, guide_, keypoint_pixels_, &matches_);
  kept_.assign(tracks_.size(), 1);
  for (const FeatureMatch& match : matches_) {
    const auto track = static_cast<size_t>(match.first);
    recovered->push_back({tracks_[track].feature, match.second});
    kept_[track] = 0;
  }
  std::sort(recovered->begin(), recovered->end(),
            [](const auto& a, const auto& b) { return a.keypoint < b.keypoint; });
  Keep(kept_);
}

void TrackMemory::Add(const TrackedFeature& feature, const Descriptors& descriptors, size_t row) {
  if (options_.frames == 0) return;
  if (tracks_.empty()) descriptors_.ResetLike(descriptors);
  tracks_.push_back({feature, 0});
  descriptors_.Append(descriptors, row);
}

void TrackMemory::Trim() {
  if (tracks_.size() <= capacity_) return;
  order_.resize(tracks_.size());
  std::iota(order_.begin(), order_.end(), size_t{0});
  const auto worthier = [this](size_t a, size_t b) {
    const LostTrack& first = tracks_[a];
    const LostTrack& second = tracks_[b];
    if (first.feature.age != second.feature.age) return first.feature.age > second.feature.age;
    if (first.frames_lost != second.frames_lost) return first.frames_lost < second.frames_lost;
    return first.feature.id < second.feature.id;
  };
  std::nth_element(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(capacity_),
                   order_.end(), worthier);
  kept_.assign(tracks_.size(), 0);
  for (size_t i = 0; i < capacity_; ++i) kept_[order_[i]] = 1;
  Keep(kept_);
}

void TrackMemory::Keep(const std::vector<uint8_t>& kept) {
  if (std::find(kept.begin(), kept.end(), uint8_t{0}) == kept.end()) return;
  kept_descriptors_.ResetLike(descriptors_);
  size_t count = 0;
  for (size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] == 0) continue;
    kept_descriptors_.Append(descriptors_, i);
    tracks_[count++] = tracks_[i];
  }
  tracks_.resize(count);
  std::swap(descriptors_, kept_descriptors_);
}

}  // namespace regolith

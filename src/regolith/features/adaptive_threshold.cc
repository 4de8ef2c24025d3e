// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/adaptive_threshold.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regolith {

AdaptiveThreshold::AdaptiveThreshold(const AdaptiveThresholdOptions& options) : options_(options) {
  options.Check();
}

void AdaptiveThreshold::Reset() { thresholds_.clear(); }

void AdaptiveThreshold::Select(int width, int height, int count,
                               std::vector<Candidate>* candidates) {
  status_ = DetectionStatus();
  SetGrid(width, height);
  if (!options_.enabled) {
    const auto fixed = static_cast<float>(options_.initial);
    const auto weak = std::find_if(candidates->begin(), candidates->end(),
                                   [&](const Candidate& one) { return one.score < fixed; });
    candidates->erase(weak, candidates->end());
    if (candidates->size() > static_cast<size_t>(count))
      candidates->resize(static_cast<size_t>(count));
    thresholds_.assign(members_.size(), fixed);
  } else {
    SortIntoCells(*candidates);
    MoveThresholds(*candidates, count);
    Keep(count, candidates);
  }
  Describe(*candidates);
}

void AdaptiveThreshold::SetGrid(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  grid_ = KeypointGrid(width, height, options_.cell_size);
  members_.resize(static_cast<size_t>(grid_.cells()));
  thresholds_.clear();
}

size_t AdaptiveThreshold::CellOf(const Candidate& candidate) const {
  return static_cast<size_t>(
      grid_.CellOf({static_cast<float>(candidate.column), static_cast<float>(candidate.row)}));
}

void AdaptiveThreshold::SortIntoCells(const std::vector<Candidate>& candidates) {
  for (std::vector<int>& cell : members_) cell.clear();
  for (size_t i = 0; i < candidates.size(); ++i) {
    members_[CellOf(candidates[i])].push_back(static_cast<int>(i));
  }
}

void AdaptiveThreshold::MoveThresholds(const std::vector<Candidate>& candidates, int count) {
  const auto floor = static_cast<float>(options_.floor);
  const auto score_at = [&](size_t index) { return std::max(candidates[index].score, floor); };
  const auto filled = std::count_if(members_.begin(), members_.end(),
                                    [](const std::vector<int>& cell) { return !cell.empty(); });
  if (filled == 0) return;
  const size_t share = static_cast<size_t>(std::max<int64_t>(1, count / filled));
  const float global = candidates.size() >= static_cast<size_t>(count)
                           ? score_at(static_cast<size_t>(count) - 1)
                           : floor;
  // The first image has no last one to remember.
  const double memory = thresholds_.empty() ? 0.0 : options_.memory;
  thresholds_.resize(members_.size(), floor);
  for (size_t i = 0; i < members_.size(); ++i) {
    const std::vector<int>& cell = members_[i];
    const float even =
        cell.size() >= share ? score_at(static_cast<size_t>(cell[share - 1])) : floor;
    const double target =
        options_.evenness * std::log(even) + (1.0 - options_.evenness) * std::log(global);
    const double moved = memory * std::log(thresholds_[i]) + (1.0 - memory) * target;
    thresholds_[i] = static_cast<float>(std::exp(moved));
  }
}

void AdaptiveThreshold::Keep(int count, std::vector<Candidate>* candidates) {
  rank_.clear();
  int above = 0;
  for (size_t i = 0; i < members_.size(); ++i) {
    for (const int member : members_[i]) {
      const float ratio = (*candidates)[static_cast<size_t>(member)].score / thresholds_[i];
      if (ratio >= 1.0F) ++above;
      // The strongest of a cell comes before everything but its like.
      const bool strongest = member == members_[i].front();
      rank_.emplace_back(strongest ? ratio + 1e6F : ratio, member);
    }
  }
  const auto wanted = std::min(rank_.size(), static_cast<size_t>(count));
  const auto stronger = [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  };
  if (wanted == 0) {
    candidates->clear();
    return;
  }
  std::nth_element(rank_.begin(), rank_.begin() + static_cast<std::ptrdiff_t>(wanted - 1),
                   rank_.end(), stronger);
  status_.rounds = above == static_cast<int>(wanted) ? 0 : 1;
  kept_.assign(candidates->size(), 0);
  for (size_t i = 0; i < wanted; ++i) kept_[static_cast<size_t>(rank_[i].second)] = 1;
  const float weakest = rank_[wanted - 1].first;
  // The factor that brings the thresholds to what was kept; where all candidates were, the
  // thresholds say how weak they are.
  if (weakest < 1e5F) {
    for (float& threshold : thresholds_) {
      threshold = std::max(threshold * weakest, static_cast<float>(options_.floor));
    }
  }
  size_t next = 0;
  for (size_t i = 0; i < candidates->size(); ++i) {
    if (kept_[i] != 0) (*candidates)[next++] = (*candidates)[i];
  }
  candidates->resize(next);
}

void AdaptiveThreshold::Describe(const std::vector<Candidate>& kept) {
  status_.cells = static_cast<int>(members_.size());
  kept_.assign(members_.size(), 0);
  for (const Candidate& candidate : kept) kept_[CellOf(candidate)] = 1;
  status_.cells_filled = static_cast<int>(std::count(kept_.begin(), kept_.end(), 1));
  if (thresholds_.empty()) return;
  std::vector<float> sorted = thresholds_;
  std::sort(sorted.begin(), sorted.end());
  status_.threshold_min = sorted.front();
  status_.threshold_median = sorted[sorted.size() / 2];
  status_.threshold_max = sorted.back();
}

}  // namespace regolith

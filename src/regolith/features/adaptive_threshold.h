// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/features/feature_extractor.h"
#include "regolith/features/feature_options.h"
#include "regolith/features/keypoint_grid.h"
#include "regolith/features/score_map.h"

namespace regolith {

/// Chooses among the candidates of an image: the paper's dynamic thresholds, spelled out. Each cell
/// of a grid has a threshold; a candidate counts by its score over that of its cell. From frame to
/// frame a cell's threshold moves, by its logarithm, towards the score that would give it its even
/// share of the keypoints asked for (a cell that has fewer candidates: towards the floor), and by
/// 1 − evenness towards the one threshold that would give that number from the whole image. Within
/// a frame all thresholds are multiplied by one factor until the number is met, and the strongest
/// candidate of every cell is always kept. The floor is the candidates' own: what lies below it
/// never was one.
class AdaptiveThreshold {
 public:
  explicit AdaptiveThreshold(const AdaptiveThresholdOptions& options);

  /// Keeps at most `count` candidates, which come and stay in order of falling score, of an image
  /// of that size.
  void Select(int width, int height, int count, std::vector<Candidate>* candidates);

  const DetectionStatus& status() const { return status_; }
  void Reset();

 private:
  void SetGrid(int width, int height);
  void SortIntoCells(const std::vector<Candidate>& candidates);
  void MoveThresholds(const std::vector<Candidate>& candidates, int count);
  void Keep(int count, std::vector<Candidate>* candidates);
  void Describe(const std::vector<Candidate>& kept);
  size_t CellOf(const Candidate& candidate) const;

  AdaptiveThresholdOptions options_;
  int width_ = 0;
  int height_ = 0;
  KeypointGrid grid_;
  std::vector<float> thresholds_;            // a cell; empty before the first image
  std::vector<std::vector<int>> members_;    // a cell: its candidates, strongest first
  std::vector<std::pair<float, int>> rank_;  // ratio to the threshold, candidate
  std::vector<uint8_t> kept_;
  DetectionStatus status_;
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/features/feature_network.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// How likely each pixel is a keypoint, rows one after the other.
struct ScoreMap {
  int width = 0;
  int height = 0;
  std::vector<float> scores;  ///< height × width, 0 to 1
};

/// Softmax over the 65 channels of each cell, its 64 pixels laid out in the image (SuperPoint's
/// detector head, DeTone et al. 2018). The map is as large as the image; what the network was
/// padded by is cut off.
void MakeScoreMap(const NetworkOutput& output, int width, int height, ScoreMap* map);

/// The scores of the 3 × 3 pixels around each pixel, added: how likely a keypoint lies there to a
/// pixel. Networks share a keypoint between pixels among them, so that this says how strong it is,
/// wherever it lies.
void AddNeighbours(const ScoreMap& map, ScoreMap* sums);

/// A local maximum of a score map.
struct Candidate {
  int column = 0;
  int row = 0;
  float score = 0.0F;
};

struct SuppressionOptions {
  int radius = 4;      ///< pixels; no two candidates are nearer along both axes
  int border = 4;      ///< pixels along the edge without candidates
  float floor = 0.0F;  ///< scores up to this are noise
};

/// Greedy non-maximum suppression, exact: strongest first, each takes the square of `radius` around
/// it. Of equal scores the upper, then the left one is first. A pixel that is first in its own
/// square is taken whatever lies beyond, so those are found by scanning, and only what no square of
/// theirs covers is sorted. Keeps its buffers.
class NonMaximumSuppression {
 public:
  /// Candidates by falling score. `mask`, where given, is as large as the map and 0 where none may
  /// lie; such pixels suppress nobody.
  void Run(const ScoreMap& map, const Image* mask, const SuppressionOptions& options,
           std::vector<Candidate>* candidates);

 private:
  void Prepare(const ScoreMap& map, const Image* mask, int border, float floor);
  void TakeLocalMaxima(const ScoreMap& map, int radius);
  void RaiseAlongRow(size_t window, size_t width);
  bool HasEqualBefore(const ScoreMap& map, int row, int column, int radius) const;
  bool IsFirstAround(const ScoreMap& map, size_t place, int radius) const;
  void ListRest();
  void TakeRound(const ScoreMap& map, int radius);
  void TakeSorted(const ScoreMap& map, int radius);
  void Take(const ScoreMap& map, size_t place, int radius);

  std::vector<float> left_;  // scores of the pixels that no square covers yet; 0 for the others
  std::vector<float> column_highest_;
  std::vector<float> row_highest_;
  std::vector<size_t> found_;
  std::vector<size_t> rest_;
  std::vector<uint64_t> order_;
  std::vector<uint64_t> keys_;
};

/// The centre of mass of the scores in the 5 × 5 pixels around a candidate: its place to a fraction
/// of a pixel.
Eigen::Vector2f RefinePixel(const ScoreMap& map, const Candidate& candidate);

}  // namespace regolith

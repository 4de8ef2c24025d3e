// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/score_map.h"

#include <algorithm>
#include <cstring>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr int kCell = 8;
constexpr int kPixels = kCell * kCell;
constexpr int kChannels = kPixels + 1;

using CellScores = Eigen::Array<float, kPixels, 1>;

CellScores Softmax(const float* logits) {
  const Eigen::Map<const CellScores> pixels(logits);
  const float none = logits[kPixels];
  const float highest = std::max(pixels.maxCoeff(), none);
  const CellScores powers = (pixels - highest).exp();
  return powers / (powers.sum() + std::exp(none - highest));
}

// Positive floats are ordered as their bits are, so a key of the inverted bits and the place sorts
// by falling score and then from the top left.
uint64_t SortKey(float score, size_t place) {
  uint32_t bits = 0;
  std::memcpy(&bits, &score, sizeof(bits));
  return (static_cast<uint64_t>(~bits) << 32U) | place;
}

}  // namespace

void MakeScoreMap(const NetworkOutput& output, int width, int height, ScoreMap* map) {
  REGOLITH_CHECK(width <= output.columns * kCell && height <= output.rows * kCell, "width=", width,
                 " height=", height);
  map->width = width;
  map->height = height;
  map->scores.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
  const float* logits = output.logits;
  for (int top = 0; top < output.rows * kCell; top += kCell) {
    for (int left = 0; left < output.columns * kCell; left += kCell, logits += kChannels) {
      const CellScores scores = Softmax(logits);
      const int shown_rows = std::min(kCell, height - top);
      const auto shown_columns = static_cast<size_t>(std::min(kCell, width - left));
      for (int row = 0; row < shown_rows; ++row) {
        std::memcpy(map->scores.data() +
                        static_cast<size_t>(top + row) * static_cast<size_t>(width) +
                        static_cast<size_t>(left),
                    scores.data() + row * kCell, shown_columns * sizeof(float));
      }
    }
  }
}

void NonMaximumSuppression::Run(const ScoreMap& map, const Image* mask,
                                const SuppressionOptions& options,
                                std::vector<Candidate>* candidates) {
  candidates->clear();
  order_.clear();
  const auto width = static_cast<size_t>(map.width);
  // Centres of mass need a pixel on each side.
  const int border = std::max(options.border, 1);
  for (int row = border; row < map.height - border; ++row) {
    const size_t first = static_cast<size_t>(row) * width;
    for (size_t place = first + static_cast<size_t>(border);
         place + static_cast<size_t>(border) < first + width; ++place) {
      if (map.scores[place] <= options.floor) continue;
      if (mask != nullptr && mask->data[place] == 0) continue;
      order_.push_back(SortKey(map.scores[place], place));
    }
  }
  std::sort(order_.begin(), order_.end());
  taken_.assign(map.scores.size(), 0);
  for (const uint64_t key : order_) {
    const size_t place = key & 0xffffffffU;
    if (taken_[place] != 0) continue;
    const int row = static_cast<int>(place / width);
    const int column = static_cast<int>(place % width);
    candidates->push_back({column, row, map.scores[place]});
    const int left = std::max(0, column - options.radius);
    const int right = std::min(map.width - 1, column + options.radius);
    for (int y = std::max(0, row - options.radius);
         y <= std::min(map.height - 1, row + options.radius); ++y) {
      std::memset(taken_.data() + static_cast<size_t>(y) * width + static_cast<size_t>(left), 1,
                  static_cast<size_t>(right - left + 1));
    }
  }
}

Eigen::Vector2f RefinePixel(const ScoreMap& map, const Candidate& candidate) {
  Eigen::Vector2f moment = Eigen::Vector2f::Zero();
  float total = 0.0F;
  for (int dy = -1; dy <= 1; ++dy) {
    const float* row = map.scores.data() +
                       static_cast<size_t>(candidate.row + dy) * static_cast<size_t>(map.width) +
                       static_cast<size_t>(candidate.column);
    for (int dx = -1; dx <= 1; ++dx) {
      moment += row[dx] * Eigen::Vector2f(static_cast<float>(dx), static_cast<float>(dy));
      total += row[dx];
    }
  }
  return Eigen::Vector2f(static_cast<float>(candidate.column), static_cast<float>(candidate.row)) +
         moment / total;
}

}  // namespace regolith

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
// So many pixels are sorted in less time than their local maxima are looked for.
constexpr size_t kSorted = 4096;

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

size_t Place(const ScoreMap& map, int row, int column) {
  return static_cast<size_t>(row) * static_cast<size_t>(map.width) + static_cast<size_t>(column);
}

void Raise(const float* values, size_t count, float* highest) {
  for (size_t i = 0; i < count; ++i) highest[i] = values[i] > highest[i] ? values[i] : highest[i];
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
  keys_.clear();
  candidates->clear();
  // Centres of mass need a pixel on each side.
  const int border = std::max(options.border, 1);
  if (map.width <= 2 * border || map.height <= 2 * border) return;
  Prepare(map, mask, border, options.floor);
  while (CountLeft() > kSorted) TakeLocalMaxima(map, options.radius);
  TakeRest(map, options.radius);
  std::sort(keys_.begin(), keys_.end());
  for (const uint64_t key : keys_) {
    const size_t place = key & 0xffffffffU;
    const auto width = static_cast<size_t>(map.width);
    candidates->push_back(
        {static_cast<int>(place % width), static_cast<int>(place / width), map.scores[place]});
  }
}

void NonMaximumSuppression::Prepare(const ScoreMap& map, const Image* mask, int border,
                                    float floor) {
  left_.assign(map.scores.size(), 0.0F);
  const auto count = static_cast<size_t>(map.width - 2 * border);
  for (int row = border; row < map.height - border; ++row) {
    const size_t first = Place(map, row, border);
    const float* scores = map.scores.data() + first;
    float* left = left_.data() + first;
    for (size_t i = 0; i < count; ++i) left[i] = scores[i] > floor ? scores[i] : 0.0F;
    if (mask == nullptr) continue;
    for (size_t i = 0; i < count; ++i) left[i] = mask->data[first + i] != 0 ? left[i] : 0.0F;
  }
}

size_t NonMaximumSuppression::CountLeft() const {
  int count = 0;
  for (const float score : left_) count += score > 0.0F ? 1 : 0;
  return static_cast<size_t>(count);
}

void NonMaximumSuppression::TakeLocalMaxima(const ScoreMap& map, int radius) {
  const auto width = static_cast<size_t>(map.width);
  const int padded = map.width + 2 * radius;
  column_highest_.assign(static_cast<size_t>(padded), 0.0F);
  found_.clear();
  for (int row = 0; row < map.height; ++row) {
    // Highest of each column's 2 radius + 1 pixels around this row, then along the row.
    float* columns = column_highest_.data() + radius;
    std::fill(columns, columns + width, 0.0F);
    const int last = std::min(map.height - 1, row + radius);
    for (int y = std::max(0, row - radius); y <= last; ++y)
      Raise(left_.data() + Place(map, y, 0), width, columns);
    row_highest_.assign(width, 0.0F);
    for (int shift = 0; shift <= 2 * radius; ++shift) {
      Raise(column_highest_.data() + shift, width, row_highest_.data());
    }
    const float* scores = left_.data() + Place(map, row, 0);
    for (size_t x = 0; x < width; ++x) {
      if (scores[x] > 0.0F && scores[x] >= row_highest_[x] &&
          IsFirstAround(map, row, static_cast<int>(x), radius)) {
        found_.push_back(Place(map, row, static_cast<int>(x)));
      }
    }
  }
  for (const size_t place : found_) Take(map, place, radius);
}

bool NonMaximumSuppression::IsFirstAround(const ScoreMap& map, int row, int column,
                                          int radius) const {
  const size_t place = Place(map, row, column);
  for (int y = std::max(0, row - radius); y <= row; ++y) {
    for (int x = std::max(0, column - radius); x <= std::min(map.width - 1, column + radius); ++x) {
      const size_t other = Place(map, y, x);
      if (other < place && left_[other] == left_[place]) return false;
    }
  }
  return true;
}

void NonMaximumSuppression::TakeRest(const ScoreMap& map, int radius) {
  order_.clear();
  for (size_t place = 0; place < left_.size(); ++place) {
    if (left_[place] > 0.0F) order_.push_back(SortKey(left_[place], place));
  }
  std::sort(order_.begin(), order_.end());
  for (const uint64_t key : order_) {
    const size_t place = key & 0xffffffffU;
    if (left_[place] > 0.0F) Take(map, place, radius);
  }
}

void NonMaximumSuppression::Take(const ScoreMap& map, size_t place, int radius) {
  keys_.push_back(SortKey(left_[place], place));
  const int row = static_cast<int>(place / static_cast<size_t>(map.width));
  const int column = static_cast<int>(place % static_cast<size_t>(map.width));
  const int first = std::max(0, column - radius);
  const int last = std::min(map.width - 1, column + radius);
  for (int y = std::max(0, row - radius); y <= std::min(map.height - 1, row + radius); ++y) {
    std::fill(left_.data() + Place(map, y, first), left_.data() + Place(map, y, last) + 1, 0.0F);
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

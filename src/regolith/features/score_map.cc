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
constexpr int kCentreRadius = 2;  // pixels, of the square whose centre of mass a keypoint is
// After which what is left is sorted: a ramp has one local maximum a round.
constexpr int kRounds = 8;

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

// No early exit: nine values are compared sooner than nine branches are taken.
bool AnyAbove(const float* values, size_t count, float score) {
  int found = 0;
  for (size_t i = 0; i < count; ++i) found |= values[i] > score ? 1 : 0;
  return found != 0;
}

bool AnyAtLeast(const float* values, size_t count, float score) {
  int found = 0;
  for (size_t i = 0; i < count; ++i) found |= values[i] >= score ? 1 : 0;
  return found != 0;
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

void AddNeighbours(const ScoreMap& map, ScoreMap* sums) {
  sums->width = map.width;
  sums->height = map.height;
  sums->scores.resize(map.scores.size());
  const auto width = static_cast<size_t>(map.width);
  std::vector<float> columns(width + 2, 0.0F);  // a row's, a 0 on each side
  float* inner = columns.data() + 1;
  for (int row = 0; row < map.height; ++row) {
    std::memcpy(inner, map.scores.data() + Place(map, row, 0), width * sizeof(float));
    for (const int other : {row - 1, row + 1}) {
      if (other < 0 || other >= map.height) continue;
      const float* scores = map.scores.data() + Place(map, other, 0);
      for (size_t x = 0; x < width; ++x) inner[x] += scores[x];
    }
    float* target = sums->scores.data() + Place(map, row, 0);
    for (size_t x = 0; x < width; ++x) target[x] = columns[x] + columns[x + 1] + columns[x + 2];
  }
}

void NonMaximumSuppression::Run(const ScoreMap& map, const Image* mask,
                                const SuppressionOptions& options,
                                std::vector<Candidate>* candidates) {
  keys_.clear();
  candidates->clear();
  // Centres of mass need pixels on each side.
  const int border = std::max(options.border, kCentreRadius);
  if (map.width <= 2 * border || map.height <= 2 * border) return;
  Prepare(map, mask, border, options.floor);
  TakeLocalMaxima(map, options.radius);
  ListRest();
  for (int round = 0; round < kRounds && !rest_.empty(); ++round) TakeRound(map, options.radius);
  TakeSorted(map, options.radius);
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

void NonMaximumSuppression::TakeLocalMaxima(const ScoreMap& map, int radius) {
  const auto width = static_cast<size_t>(map.width);
  const int padded = map.width + 2 * radius;
  column_highest_.assign(static_cast<size_t>(padded), 0.0F);
  found_.clear();
  for (int row = 0; row < map.height; ++row) {
    // Highest of each column's 2 radius + 1 pixels around this row, then along the row.
    float* columns = column_highest_.data() + radius;
    std::fill(column_highest_.begin(), column_highest_.end(), 0.0F);
    const int last = std::min(map.height - 1, row + radius);
    for (int y = std::max(0, row - radius); y <= last; ++y)
      Raise(left_.data() + Place(map, y, 0), width, columns);
    RaiseAlongRow(2 * static_cast<size_t>(radius) + 1, width);
    const float* scores = left_.data() + Place(map, row, 0);
    for (size_t x = 0; x < width; ++x) {
      if (scores[x] == 0.0F || scores[x] < row_highest_[x]) continue;
      const size_t place = Place(map, row, static_cast<int>(x));
      // Nothing around is stronger; an equal one before it would be first.
      if (!HasEqualBefore(map, row, static_cast<int>(x), radius)) found_.push_back(place);
    }
  }
  for (const size_t place : found_) Take(map, place, radius);
}

void NonMaximumSuppression::RaiseAlongRow(size_t window, size_t width) {
  // The highest of `covered` values from each place on; twice as many a step.
  size_t covered = 1;
  for (; 2 * covered <= window; covered *= 2) {
    const size_t count = column_highest_.size() - covered;
    row_highest_ = column_highest_;
    Raise(column_highest_.data() + covered, count, row_highest_.data());
    std::swap(row_highest_, column_highest_);
  }
  row_highest_ = column_highest_;
  Raise(column_highest_.data() + window - covered, width, row_highest_.data());
}

bool NonMaximumSuppression::HasEqualBefore(const ScoreMap& map, int row, int column,
                                           int radius) const {
  const int first = std::max(0, column - radius);
  const auto count = static_cast<size_t>(std::min(map.width - 1, column + radius) - first + 1);
  const float* own = left_.data() + Place(map, row, first);
  const float score = left_[Place(map, row, column)];
  bool found = AnyAtLeast(own, static_cast<size_t>(column - first), score);
  for (int step = 1; step <= std::min(radius, row); ++step) {
    found |= AnyAtLeast(own - Place(map, step, 0), count, score);
  }
  return found;
}

bool NonMaximumSuppression::IsFirstAround(const ScoreMap& map, size_t place, int radius) const {
  const int row = static_cast<int>(place / static_cast<size_t>(map.width));
  const int column = static_cast<int>(place % static_cast<size_t>(map.width));
  const int first = std::max(0, column - radius);
  const auto count = static_cast<size_t>(std::min(map.width - 1, column + radius) - first + 1);
  const float score = left_[place];
  const auto before = static_cast<size_t>(column - first);
  const float* own = left_.data() + Place(map, row, first);
  if (AnyAtLeast(own, before, score)) return false;
  if (AnyAbove(own + before + 1, count - before - 1, score)) return false;
  // Nearest rows first: a stronger pixel is mostly a neighbour.
  for (int step = 1; step <= radius; ++step) {
    if (row - step >= 0 && AnyAtLeast(own - Place(map, step, 0), count, score)) return false;
    if (row + step < map.height && AnyAbove(own + Place(map, step, 0), count, score)) return false;
  }
  return true;
}

void NonMaximumSuppression::ListRest() {
  constexpr size_t kBlock = 32;
  rest_.clear();
  for (size_t first = 0; first < left_.size(); first += kBlock) {
    const size_t end = std::min(first + kBlock, left_.size());
    // Most blocks hold nothing any more.
    int count = 0;
    for (size_t place = first; place < end; ++place) count += left_[place] > 0.0F ? 1 : 0;
    for (size_t place = first; count > 0; ++place) {
      if (left_[place] == 0.0F) continue;
      rest_.push_back(place);
      --count;
    }
  }
}

void NonMaximumSuppression::TakeRound(const ScoreMap& map, int radius) {
  found_.clear();
  for (const size_t place : rest_) {
    if (IsFirstAround(map, place, radius)) found_.push_back(place);
  }
  for (const size_t place : found_) Take(map, place, radius);
  rest_.erase(std::remove_if(rest_.begin(), rest_.end(),
                             [this](size_t place) { return left_[place] == 0.0F; }),
              rest_.end());
}

void NonMaximumSuppression::TakeSorted(const ScoreMap& map, int radius) {
  order_.clear();
  for (const size_t place : rest_) order_.push_back(SortKey(left_[place], place));
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
  for (int dy = -kCentreRadius; dy <= kCentreRadius; ++dy) {
    const float* row = map.scores.data() +
                       static_cast<size_t>(candidate.row + dy) * static_cast<size_t>(map.width) +
                       static_cast<size_t>(candidate.column);
    for (int dx = -kCentreRadius; dx <= kCentreRadius; ++dx) {
      moment += row[dx] * Eigen::Vector2f(static_cast<float>(dx), static_cast<float>(dy));
      total += row[dx];
    }
  }
  return Eigen::Vector2f(static_cast<float>(candidate.column), static_cast<float>(candidate.row)) +
         moment / total;
}

}  // namespace regolith

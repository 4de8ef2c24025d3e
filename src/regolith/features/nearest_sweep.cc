// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/nearest_sweep.h"

#include <algorithm>
#include <cstring>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace regolith {
namespace {

using Nearest = DescriptorMatcher::Nearest;

constexpr size_t kLanes = 8;
// 6 x 2 sums, two panels and one broadcast fill 15 of AVX2's 16 registers, and eight loads feed
// twelve products.
constexpr size_t kTileRows = 6;
constexpr size_t kTilePanels = 2;
constexpr size_t kTileColumns = kTilePanels * kLanes;

/// Eight 32-bit integers. Both versions compute the same.
#if defined(__AVX2__)
using Lanes = __m256i;
Lanes Load(const void* from) { return _mm256_loadu_si256(static_cast<const __m256i*>(from)); }
void Store(Lanes lanes, void* to) { _mm256_storeu_si256(static_cast<__m256i*>(to), lanes); }
Lanes Broadcast(int32_t value) { return _mm256_set1_epi32(value); }
Lanes Max(Lanes a, Lanes b) { return _mm256_max_epi32(a, b); }
Lanes Min(Lanes a, Lanes b) { return _mm256_min_epi32(a, b); }
Lanes SelectGreater(Lanes a, Lanes b, Lanes if_greater, Lanes otherwise) {
  return _mm256_blendv_epi8(otherwise, if_greater, _mm256_cmpgt_epi32(a, b));
}
/// Adds the products of both 16-bit halves of each lane.
Lanes AddProducts(Lanes a, Lanes b, Lanes sum) {
  return _mm256_add_epi32(sum, _mm256_madd_epi16(a, b));
}
#else
struct Lanes {
  int32_t values[kLanes];
};
template <typename Function>
Lanes EachLane(const Function& function) {
  Lanes result;
  for (size_t i = 0; i < kLanes; ++i) result.values[i] = function(i);
  return result;
}
Lanes Load(const void* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}
void Store(const Lanes& lanes, void* to) { std::memcpy(to, &lanes, sizeof(lanes)); }
Lanes Broadcast(int32_t value) {
  return EachLane([&](size_t) { return value; });
}
Lanes Max(const Lanes& a, const Lanes& b) {
  return EachLane([&](size_t i) { return std::max(a.values[i], b.values[i]); });
}
Lanes Min(const Lanes& a, const Lanes& b) {
  return EachLane([&](size_t i) { return std::min(a.values[i], b.values[i]); });
}
Lanes SelectGreater(const Lanes& a, const Lanes& b, const Lanes& if_greater,
                    const Lanes& otherwise) {
  return EachLane([&](size_t i) {
    return a.values[i] > b.values[i] ? if_greater.values[i] : otherwise.values[i];
  });
}
/// Adds the products of both 16-bit halves of each lane.
Lanes AddProducts(const Lanes& a, const Lanes& b, const Lanes& sum) {
  return EachLane([&](size_t i) {
    int16_t x[2];
    int16_t y[2];
    std::memcpy(x, &a.values[i], sizeof(x));
    std::memcpy(y, &b.values[i], sizeof(y));
    return sum.values[i] + x[0] * y[0] + x[1] * y[1];
  });
}
#endif

/// The nearest of eight columns, or of one row among the columns of each lane.
struct LaneNearest {
  Lanes best = Broadcast(INT32_MIN);
  Lanes second = Broadcast(INT32_MIN);
  Lanes index = Broadcast(-1);

  /// Indices come in ascending order, so that an equal value keeps the lower one.
  void Consider(const Lanes& value, const Lanes& value_index) {
    second = Max(second, Min(best, value));
    index = SelectGreater(value, best, value_index, index);
    best = Max(best, value);
  }
};

constexpr size_t kLaneState = 3 * kLanes;

LaneNearest LoadState(const int32_t* state) {
  LaneNearest nearest;
  nearest.best = Load(state);
  nearest.second = Load(state + kLanes);
  nearest.index = Load(state + 2 * kLanes);
  return nearest;
}

void StoreState(const LaneNearest& nearest, int32_t* state) {
  Store(nearest.best, state);
  Store(nearest.second, state + kLanes);
  Store(nearest.index, state + 2 * kLanes);
}

/// `tile` (kTileRows x kTileColumns) = rows times panels.
void MultiplyTile(const int16_t* rows, const int16_t* panels, size_t stride, int32_t* tile) {
  Lanes sums[kTileRows][kTilePanels];
  for (auto& row : sums) {
    for (Lanes& sum : row) sum = Broadcast(0);
  }
  for (size_t i = 0; i < stride; i += 2) {
    const Lanes left = Load(panels + i * kLanes);
    const Lanes right = Load(panels + (stride + i) * kLanes);
    for (size_t row = 0; row < kTileRows; ++row) {
      int32_t pair;
      std::memcpy(&pair, rows + row * stride + i, sizeof(pair));
      const Lanes values = Broadcast(pair);
      sums[row][0] = AddProducts(values, left, sums[row][0]);
      sums[row][1] = AddProducts(values, right, sums[row][1]);
    }
  }
  for (size_t row = 0; row < kTileRows; ++row) {
    for (size_t panel = 0; panel < kTilePanels; ++panel) {
      Store(sums[row][panel], tile + row * kTileColumns + panel * kLanes);
    }
  }
}

/// The nearest of a row from its lanes; an index there counts panels.
Nearest MergeLanes(const int32_t* state) {
  Nearest nearest;
  for (size_t lane = 0; lane < kLanes; ++lane) {
    const int32_t best = state[lane];
    if (best == INT32_MIN) continue;
    const int32_t index =
        state[2 * kLanes + lane] * static_cast<int32_t>(kLanes) + static_cast<int32_t>(lane);
    int32_t runner_up = best;
    if (best > nearest.best || (best == nearest.best && index < nearest.index)) {
      runner_up = nearest.best;
      nearest.best = best;
      nearest.index = index;
    }
    nearest.second = std::max({nearest.second, runner_up, state[kLanes + lane]});
  }
  return nearest;
}

}  // namespace

size_t FixedStride(int dimension) { return (static_cast<size_t>(dimension) + 15) / 16 * 16; }

size_t PaddedRows(size_t rows) { return (rows + kTileRows - 1) / kTileRows * kTileRows; }

size_t PaddedColumns(size_t columns) {
  return (columns + kTileColumns - 1) / kTileColumns * kTileColumns;
}

void InterleavePanels(const std::vector<int16_t>& rows, size_t stride,
                      std::vector<int16_t>* panels) {
  panels->resize(rows.size());
  for (size_t row = 0; row < rows.size() / stride; ++row) {
    const int16_t* from = rows.data() + row * stride;
    int16_t* to = panels->data() + row / kLanes * kLanes * stride + row % kLanes * 2;
    for (size_t i = 0; i < stride; i += 2) {
      std::memcpy(to + i * kLanes, from + i, 2 * sizeof(int16_t));
    }
  }
}

void SweepNearest(const std::vector<int16_t>& first_rows, const std::vector<int16_t>& second_panels,
                  size_t stride, std::vector<int32_t>* lanes, std::vector<Nearest>* first_nearest,
                  std::vector<Nearest>* second_nearest) {
  const size_t rows = first_nearest->size();
  const size_t columns = second_nearest->size();
  lanes->resize(rows * kLaneState);
  for (size_t row = 0; row < rows; ++row) StoreState({}, lanes->data() + row * kLaneState);
  // Two panels stay in the first-level cache while all rows pass.
  for (size_t start = 0; start < columns; start += kTileColumns) {
    int32_t limit_values[kTileColumns];  // padding counts as no similarity at all
    for (size_t i = 0; i < kTileColumns; ++i) {
      limit_values[i] = start + i < columns ? INT32_MAX : INT32_MIN;
    }
    LaneNearest column_nearest[kTilePanels];
    for (size_t row = 0; row < rows; row += kTileRows) {
      int32_t tile[kTileRows * kTileColumns];
      MultiplyTile(first_rows.data() + row * stride, second_panels.data() + start * stride, stride,
                   tile);
      for (size_t i = row; i < std::min(rows, row + kTileRows); ++i) {
        LaneNearest row_nearest = LoadState(lanes->data() + i * kLaneState);
        for (size_t panel = 0; panel < kTilePanels; ++panel) {
          const Lanes value = Min(Load(tile + (i - row) * kTileColumns + panel * kLanes),
                                  Load(limit_values + panel * kLanes));
          column_nearest[panel].Consider(value, Broadcast(static_cast<int32_t>(i)));
          row_nearest.Consider(value, Broadcast(static_cast<int32_t>(start / kLanes + panel)));
        }
        StoreState(row_nearest, lanes->data() + i * kLaneState);
      }
    }
    for (size_t panel = 0; panel < kTilePanels; ++panel) {
      int32_t state[kLaneState];
      StoreState(column_nearest[panel], state);
      for (size_t lane = 0; lane < kLanes; ++lane) {
        const size_t column = start + panel * kLanes + lane;
        if (column >= columns) break;
        (*second_nearest)[column] = {state[lane], state[kLanes + lane], state[2 * kLanes + lane]};
      }
    }
  }
  for (size_t row = 0; row < rows; ++row) {
    (*first_nearest)[row] = MergeLanes(lanes->data() + row * kLaneState);
  }
}

}  // namespace regolith

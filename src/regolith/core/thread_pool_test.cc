// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/thread_pool.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <vector>

namespace regolith {
namespace {

TEST(ThreadPool, VisitsEveryIndexOnce) {
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const size_t count : {size_t{0}, size_t{1}, size_t{63}, size_t{1000}}) {
      std::vector<int> visits(count, 0);
      pool.ParallelFor(count, 64, [&](size_t begin, size_t end, size_t) {
        for (size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), size_t{0}), count);
      for (const int visit : visits) EXPECT_EQ(visit, 1);
    }
  }
}

TEST(ThreadPool, ChunksDoNotDependOnTheNumberOfThreads) {
  const auto chunk_sums = [](int threads) {
    ThreadPool pool(threads);
    std::vector<double> sums(ChunkCount(1000, 7));
    pool.ParallelFor(1000, 7, [&](size_t begin, size_t end, size_t chunk) {
      for (size_t i = begin; i < end; ++i) sums[chunk] += 1.0 / static_cast<double>(i + 1);
    });
    return sums;
  };
  EXPECT_EQ(chunk_sums(1), chunk_sums(3));
}

TEST(ThreadPool, ThrowsWhatABodyThrows) {
  ThreadPool pool(2);
  const auto throwing = [](size_t, size_t, size_t chunk) {
    if (chunk == 3) throw std::runtime_error("chunk 3");
  };
  EXPECT_THROW(pool.ParallelFor(10, 1, throwing), std::runtime_error);
  int visits = 0;
  pool.ParallelFor(1, 1, [&](size_t, size_t, size_t) { ++visits; });
  EXPECT_EQ(visits, 1);
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace regolith {

/// Threads that share out loops. Chunks depend on the loop alone, never on the number of threads,
/// so results that are reduced chunk by chunk in order are the same bytes for any number of
/// threads.
class ThreadPool {
 public:
  /// `threads` in total, the calling one counted; 0 means one for each core.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const;

  /// Calls body(begin, end, chunk) for [0, count) cut into pieces of `chunk_size`; returns when all
  /// are done. The first exception that a body throws is thrown here. Several threads may call it
  /// at once, but not from inside a body.
  void ParallelFor(size_t count, size_t chunk_size,
                   const std::function<void(size_t begin, size_t end, size_t chunk)>& body);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Number of pieces that ParallelFor cuts [0, count) into.
inline size_t ChunkCount(size_t count, size_t chunk_size) {
  return (count + chunk_size - 1) / chunk_size;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "regolith/core/check.h"

namespace regolith {

class ThreadPool::Implementation {
 public:
  explicit Implementation(int helpers) {
    for (int i = 0; i < helpers; ++i) helpers_.emplace_back([this] { HelperLoop(); });
  }

  ~Implementation() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }

  void Run(size_t count, size_t chunk_size,
           const std::function<void(size_t, size_t, size_t)>& body) {
    // While another caller's loop has the helpers, this one is worked off by its caller alone.
    const std::unique_lock callers(callers_, std::try_to_lock);
    if (!callers) {
      for (size_t begin = 0; begin < count; begin += chunk_size) {
        body(begin, std::min(begin + chunk_size, count), begin / chunk_size);
      }
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      count_ = count;
      chunk_size_ = chunk_size;
      body_ = &body;
      next_chunk_ = 0;
      error_ = nullptr;
      busy_helpers_ = helpers_.size();
      ++generation_;
    }
    wake_.notify_all();
    WorkOff();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_helpers_ == 0; });
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void HelperLoop() {
    uint64_t seen = 0;
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [&] { return stopping_ || generation_ != seen; });
      if (stopping_) return;
      seen = generation_;
      lock.unlock();
      WorkOff();
      lock.lock();
      if (--busy_helpers_ == 0) done_.notify_one();
    }
  }

  void WorkOff() {
    const size_t chunks = ChunkCount(count_, chunk_size_);
    for (size_t chunk = next_chunk_++; chunk < chunks; chunk = next_chunk_++) {
      const size_t begin = chunk * chunk_size_;
      try {
        (*body_)(begin, std::min(begin + chunk_size_, count_), chunk);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
  }

  std::vector<std::thread> helpers_;
  std::mutex callers_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  bool stopping_ = false;
  uint64_t generation_ = 0;
  size_t busy_helpers_ = 0;
  size_t count_ = 0;
  size_t chunk_size_ = 1;
  const std::function<void(size_t, size_t, size_t)>* body_ = nullptr;
  std::atomic<size_t> next_chunk_{0};
  std::exception_ptr error_;
};

ThreadPool::ThreadPool(int threads) {
  REGOLITH_CHECK(threads >= 0 && threads <= 1024, "threads=", threads);
  const int total =
      threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  implementation_ = std::make_unique<Implementation>(total - 1);
}

ThreadPool::~ThreadPool() = default;

int ThreadPool::threads() const { return implementation_->threads(); }

void ThreadPool::ParallelFor(size_t count, size_t chunk_size,
                             const std::function<void(size_t, size_t, size_t)>& body) {
  REGOLITH_CHECK(chunk_size > 0, "chunk_size=", chunk_size);
  if (count == 0) return;
  implementation_->Run(count, chunk_size, body);
}

}  // namespace regolith

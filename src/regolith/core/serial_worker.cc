// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/serial_worker.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace regolith {

class SerialWorker::Implementation {
 public:
  explicit Implementation(size_t capacity) : capacity_(capacity) {
    if (capacity > 0) thread_ = std::thread([this] { Loop(); });
  }

  ~Implementation() {
    Stop();
    if (thread_.joinable()) thread_.join();
  }

  void Stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_all();
  }

  void Post(std::function<void()> task) {
    RethrowFailure();
    if (capacity_ == 0) {
      ++posted_;
      Work(task);
      RethrowFailure();
      return;
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return tasks_.size() < capacity_ || stopping_; });
    tasks_.push_back(std::move(task));
    ++posted_;
    lock.unlock();
    changed_.notify_all();
  }

  size_t posted() const {
    const std::lock_guard lock(mutex_);
    return posted_;
  }

  size_t done() const {
    const std::lock_guard lock(mutex_);
    return done_;
  }

  void WaitFor(size_t count) const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done_ >= count || stopping_; });
  }

  void RethrowFailure() const {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void Loop() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (stopping_) return;
      const std::function<void()> task = std::move(tasks_.front());
      tasks_.pop_front();
      const bool has_failed = failure_ != nullptr;
      lock.unlock();
      if (has_failed) {
        CountDone();
      } else {
        Work(task);
      }
      lock.lock();
    }
  }

  void Work(const std::function<void()>& task) {
    try {
      task();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
    CountDone();
  }

  void CountDone() {
    {
      const std::lock_guard lock(mutex_);
      ++done_;
    }
    changed_.notify_all();
  }

  const size_t capacity_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  size_t posted_ = 0;
  size_t done_ = 0;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

SerialWorker::SerialWorker(size_t capacity)
    : implementation_(std::make_unique<Implementation>(capacity)) {}

SerialWorker::~SerialWorker() = default;

void SerialWorker::Post(std::function<void()> task) { implementation_->Post(std::move(task)); }

size_t SerialWorker::posted() const { return implementation_->posted(); }

size_t SerialWorker::done() const { return implementation_->done(); }

void SerialWorker::WaitFor(size_t count) const { implementation_->WaitFor(count); }

void SerialWorker::Stop() { implementation_->Stop(); }

void SerialWorker::RethrowFailure() const { implementation_->RethrowFailure(); }

}  // namespace regolith

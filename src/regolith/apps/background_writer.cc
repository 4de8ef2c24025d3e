// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/background_writer.h"

#include <utility>

namespace regolith {
namespace {

constexpr size_t kMostOutstanding = 256;  // of 30 images a second and 350 small messages

}  // namespace

BackgroundWriter::BackgroundWriter(BagWriter* bag) : bag_(bag), thread_([this] { WriteAll(); }) {}

BackgroundWriter::~BackgroundWriter() { Stop(true); }

void BackgroundWriter::Put(SensorEvent event) { Enqueue(std::move(event)); }

void BackgroundWriter::PutTruth(const StampedPose& pose) { Enqueue(pose); }

void BackgroundWriter::Enqueue(Item item) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return items_.size() < kMostOutstanding || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  items_.push_back(std::move(item));
  changed_.notify_all();
}

void BackgroundWriter::Finish() {
  Stop(false);
  if (failure_) std::rethrow_exception(failure_);
}

void BackgroundWriter::Stop(bool drop) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (drop) items_.clear();
    stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void BackgroundWriter::WriteAll() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !items_.empty() || stopping_; });
    if (items_.empty()) return;
    const Item item = std::move(items_.front());
    items_.pop_front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (const auto* pose = std::get_if<StampedPose>(&item)) {
        bag_->WriteTruth(*pose);
      } else {
        bag_->Write(std::get<SensorEvent>(item));
      }
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) {
      failure_ = failure;
      items_.clear();
    }
    changed_.notify_all();
    if (failure) return;
  }
}

}  // namespace regolith

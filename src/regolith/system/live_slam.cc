// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/live_slam.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "regolith/imu/propagation.h"

namespace regolith {
namespace {

/// s; a prediction over a longer time would be a guess.
constexpr double kLongestPrediction = 2.0;

bool IsScan(const SensorEvent& event) { return std::holds_alternative<LidarScan>(event); }
bool IsImage(const SensorEvent& event) { return std::holds_alternative<CameraFrame>(event); }

}  // namespace

LiveSlam::LiveSlam(Factory factory, size_t topics, double gravity, const LiveOptions& options,
                   Listener listener, ResetListener reset_listener)
    : factory_(std::move(factory)),
      options_(options),
      gravity_world_(0.0, 0.0, -gravity),
      listener_(std::move(listener)),
      reset_listener_(std::move(reset_listener)),
      system_(factory_()),
      merger_(topics, options.merger) {
  options.Check();
  worker_ = std::thread([this] { Run(); });
}

LiveSlam::~LiveSlam() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  worker_.join();
}

void LiveSlam::Push(size_t topic, SensorEvent event) {
  if (const auto* sample = std::get_if<ImuSample>(&event)) AddImu(*sample);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (merger_.Add(topic, std::move(event))) {
      ++status_.time_jumps;
      AskForReset("time jumped to another place");
    }
    Enqueue(merger_.TakeReady());
  }
  wake_.notify_all();
}

void LiveSlam::Enqueue(std::vector<SensorEvent> events) {
  for (SensorEvent& event : events) {
    newest_ = EventTime(event);
    scans_ += IsScan(event) ? 1 : 0;
    images_ += IsImage(event) ? 1 : 0;
    queue_.push_back(std::move(event));
    DropOldest();
  }
}

/// The kind that there are too many of loses its oldest one.
void LiveSlam::DropOldest() {
  const auto drop = [this](const auto& is_one) {
    queue_.erase(std::find_if(queue_.begin(), queue_.end(), is_one));
  };
  if (scans_ > options_.max_scans) {
    drop(IsScan);
    --scans_;
    ++status_.dropped_scans;
  }
  if (images_ > options_.max_images) {
    drop(IsImage);
    --images_;
    ++status_.dropped_images;
  }
  const auto others = static_cast<int>(queue_.size()) - scans_ - images_;
  if (others > options_.max_imu) {
    drop([](const SensorEvent& event) { return !IsScan(event) && !IsImage(event); });
    ++status_.dropped_imu;
  }
}

void LiveSlam::AskForReset(const std::string& reason) {
  reset_ = reason;
  queue_.clear();
  scans_ = images_ = 0;
}

void LiveSlam::Reset(const std::string& reason) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    AskForReset(reason);
  }
  wake_.notify_all();
}

void LiveSlam::Ask(const Task& task) {
  Request request{&task, nullptr};
  std::unique_lock<std::mutex> lock(mutex_);
  if (stop_) return;
  requests_.push_back(&request);
  wake_.notify_all();
  answered_.wait(lock, [&] { return request.done; });
  if (request.error) std::rethrow_exception(request.error);
}

LiveStatus LiveSlam::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  LiveStatus status = status_;
  status.waiting = queue_.size() + merger_.waiting();
  if (!queue_.empty()) status.behind = SecondsBetween(EventTime(queue_.front()), newest_);
  return status;
}

EventMerger::Dropped LiveSlam::dropped(size_t topic) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return merger_.dropped(topic);
}

bool LiveSlam::idle() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return queue_.empty() && merger_.waiting() == 0 && !working_ && !reset_;
}

void LiveSlam::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto idle = std::chrono::duration<double>(options_.idle);
  while (!stop_) {
    const bool woken = wake_.wait_for(
        lock, idle, [this] { return stop_ || reset_ || !requests_.empty() || !queue_.empty(); });
    if (stop_) break;
    if (!woken) {
      Enqueue(merger_.TakeAll());
      if (queue_.empty() && !settled_) Settle(&lock);
    }
    if (reset_) BeginAnew(&lock);
    if (!AnswerRequests(&lock) && !queue_.empty()) WorkOff(&lock);
  }
  for (Request* request : requests_) request->done = true;
  answered_.notify_all();
}

bool LiveSlam::AnswerRequests(std::unique_lock<std::mutex>* lock) {
  if (requests_.empty()) return false;
  Request* const request = requests_.front();
  requests_.pop_front();
  Settle(lock);
  lock->unlock();
  try {
    (*request->task)(*system_);
  } catch (...) {
    request->error = std::current_exception();
  }
  lock->lock();
  request->done = true;
  answered_.notify_all();
  return true;
}

void LiveSlam::BeginAnew(std::unique_lock<std::mutex>* lock) {
  const std::string reason = *std::exchange(reset_, std::nullopt);
  ++status_.resets;
  working_ = true;
  lock->unlock();
  system_ = factory_();
  Rebase(std::nullopt);
  if (reset_listener_) reset_listener_(reason);
  lock->lock();
  working_ = false;
}

/// Until all that was given to the system is worked off.
void LiveSlam::Settle(std::unique_lock<std::mutex>* lock) {
  working_ = settled_ = true;
  lock->unlock();
  const std::vector<FrameReport> reports = system_->Settle();
  Rebase(system_->live());
  if (listener_ && !reports.empty()) listener_(*system_, nullptr, reports);
  lock->lock();
  working_ = false;
}

void LiveSlam::WorkOff(std::unique_lock<std::mutex>* lock) {
  const SensorEvent event = std::move(queue_.front());
  queue_.pop_front();
  scans_ -= IsScan(event) ? 1 : 0;
  images_ -= IsImage(event) ? 1 : 0;
  const bool was_last = queue_.empty();
  working_ = true;
  settled_ = false;
  lock->unlock();
  std::string failure;
  try {
    const std::vector<FrameReport> reports = system_->Process(event);
    // Often enough: while measurements still wait, better states come at once.
    if (was_last || !reports.empty()) Rebase(system_->live());
    if (listener_) listener_(*system_, &event, reports);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  lock->lock();
  ++status_.processed;
  working_ = false;
  if (failure.empty()) return;
  status_.failure = failure;
  AskForReset("the estimator failed: " + failure);
}

/// Carries the prediction one sample on.
void LiveSlam::AddImu(const ImuSample& sample) {
  const std::lock_guard<std::mutex> lock(state_mutex_);
  if (!samples_.empty()) {
    const double step = SecondsBetween(samples_.back().time, sample.time);
    if (step <= 0.0 && step >= -options_.merger.max_behind) return;
    // Another time, or a stamp that is wrong: the estimator's next state will tell.
    if (std::abs(step) > kLongestPrediction) {
      samples_.clear();
      predicted_.reset();
    }
  }
  if (predicted_ && !samples_.empty()) {
    predicted_ = Propagate(*predicted_, samples_.back(), sample, gravity_world_);
  }
  samples_.push_back(sample);
  while (SecondsBetween(samples_.front().time, sample.time) > kLongestPrediction) {
    samples_.pop_front();
  }
}

/// Begins the prediction at the estimator's own state.
void LiveSlam::Rebase(const std::optional<NavState>& state) {
  const std::lock_guard<std::mutex> lock(state_mutex_);
  predicted_ = state;
  if (!state) return;
  // The sample that the state stands at, or the last one before, stays.
  while (samples_.size() > 1 && samples_[1].time <= state->time) samples_.pop_front();
  if (samples_.empty() || samples_.back().time <= state->time) return;
  if (SecondsBetween(state->time, samples_.front().time) > kLongestPrediction) {
    predicted_.reset();
    return;
  }
  const std::vector<ImuSample> samples(samples_.begin(), samples_.end());
  predicted_ = PropagateTo(*state, samples, samples_.back().time, gravity_world_);
}

std::optional<NavState> LiveSlam::Predicted() const {
  const std::lock_guard<std::mutex> lock(state_mutex_);
  return predicted_;
}

}  // namespace regolith

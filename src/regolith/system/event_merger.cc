// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/event_merger.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

/// More are not held, whatever their stamps say.
constexpr size_t kMostWaiting = 20000;
constexpr size_t kMostAstray = 2000;

}  // namespace

EventMerger::EventMerger(size_t topics, const EventMergerOptions& options)
    : options_(options), topics_(topics) {
  options.Check();
}

bool EventMerger::Add(size_t topic, SensorEvent event) {
  const TimeNs stamp = EventTime(event);
  if (stamp <= 0) {
    ++topics_.at(topic).dropped.no_stamp;
    return false;
  }
  if (newest_ && IsAstray(topics_.at(topic).last, stamp)) {
    return AddAstray(topic, std::move(event));
  }
  DropAstray();
  Insert(topic, std::move(event));
  return false;
}

/// A topic that goes on from its own last measurement is right, however far the others have fallen
/// behind or gone ahead.
bool EventMerger::IsAstray(const std::optional<TimeNs>& last, TimeNs stamp) const {
  const double ahead = SecondsBetween(*newest_, stamp);
  if (ahead < -options_.max_behind) return last && stamp <= *last;
  return ahead > options_.max_ahead &&
         !(last && SecondsBetween(*last, stamp) <= options_.max_ahead);
}

/// One wrong clock among others never gets so far: their measurements come in between.
bool EventMerger::AddAstray(size_t topic, SensorEvent event) {
  const TimeNs stamp = EventTime(event);
  const bool elsewhere =
      !astray_.empty() &&
      std::abs(SecondsBetween(EventTime(astray_.back().second), stamp)) > options_.max_ahead;
  if (elsewhere || astray_.size() >= kMostAstray) DropAstray();
  astray_.emplace_back(topic, std::move(event));
  const auto earlier = [](const auto& a, const auto& b) {
    return EventTime(a.second) < EventTime(b.second);
  };
  const auto [low, high] = std::minmax_element(astray_.begin(), astray_.end(), earlier);
  const TimeNs start = EventTime(low->second);
  if (SecondsBetween(start, EventTime(high->second)) < options_.jump_evidence) return false;
  const double gap = SecondsBetween(*newest_, start);
  const bool another_time = gap < 0.0 || gap > options_.max_gap;
  if (another_time) {
    waiting_.clear();
    first_ = newest_ = passed_on_ = std::nullopt;
    for (Topic& each : topics_) each.last.reset();
  }
  for (auto& [of_topic, found] : std::exchange(astray_, {})) Insert(of_topic, std::move(found));
  return another_time;
}

void EventMerger::DropAstray() {
  for (const auto& [topic, event] : astray_) ++topics_[topic].dropped.astray;
  astray_.clear();
}

void EventMerger::Insert(size_t topic, SensorEvent event) {
  const TimeNs stamp = EventTime(event);
  Topic& own = topics_.at(topic);
  if (own.last && stamp <= *own.last) {
    ++own.dropped.repeated;
    return;
  }
  own.last = stamp;
  if (!first_) first_ = stamp;
  newest_ = newest_ ? std::max(*newest_, stamp) : stamp;
  if (passed_on_ && stamp < *passed_on_) {
    ++own.dropped.late;
    return;
  }
  waiting_.emplace(Key(stamp, topic), std::move(event));
}

bool EventMerger::IsReady(TimeNs stamp) const {
  if (SecondsBetween(stamp, *newest_) >= options_.hold || waiting_.size() > kMostWaiting) {
    return true;
  }
  return std::all_of(topics_.begin(), topics_.end(), [&](const Topic& topic) {
    if (topic.last && *topic.last >= stamp) return true;
    // One that never spoke is waited for as long as one that has fallen silent.
    return SecondsBetween(topic.last.value_or(*first_), *newest_) > options_.silence;
  });
}

SensorEvent EventMerger::PopFirst() {
  const auto first = waiting_.begin();
  passed_on_ = first->first.first;
  SensorEvent event = std::move(first->second);
  waiting_.erase(first);
  return event;
}

std::vector<SensorEvent> EventMerger::TakeReady() {
  std::vector<SensorEvent> ready;
  while (!waiting_.empty() && IsReady(waiting_.begin()->first.first)) ready.push_back(PopFirst());
  return ready;
}

std::vector<SensorEvent> EventMerger::TakeAll() {
  std::vector<SensorEvent> all;
  while (!waiting_.empty()) all.push_back(PopFirst());
  return all;
}

}  // namespace regolith

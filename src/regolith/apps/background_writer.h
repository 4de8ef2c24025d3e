// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <variant>

#include "regolith/geometry/trajectory.h"
#include "regolith/io/bag_writer.h"
#include "regolith/sensor/sensor_event.h"

namespace regolith {

/// Writes to a bag from a thread of its own, in the order of Put: images are encoded while the next
/// ones are rendered.
class BackgroundWriter {
 public:
  explicit BackgroundWriter(BagWriter* bag);
  /// Drops what has not been written yet.
  ~BackgroundWriter();
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;

  /// Waits while too much is outstanding. Throws what the bag has thrown since.
  void Put(SensorEvent event);
  void PutTruth(const StampedPose& pose);
  /// Waits until all is written. Throws what the bag has thrown since.
  void Finish();

 private:
  using Item = std::variant<SensorEvent, StampedPose>;

  void Enqueue(Item item);
  void WriteAll();
  void Stop(bool drop);

  BagWriter* bag_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace regolith

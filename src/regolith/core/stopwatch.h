// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace regolith {

/// What one stage of the work on one frame took.
struct StageTime {
  std::string name;
  double milliseconds = 0.0;
};

/// Wall-clock time of consecutive stages. It informs; nothing that is computed depends on it.
class Stopwatch {
 public:
  Stopwatch() : last_(Clock::now()) {}

  /// Ends a stage: the time since the last one ended goes under `name`.
  void Lap(const std::string& name) {
    const Clock::time_point now = Clock::now();
    stages_.push_back({name, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
  }

  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
  std::vector<StageTime> stages_;
};

}  // namespace regolith

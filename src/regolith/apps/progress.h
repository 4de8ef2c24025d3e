// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace regolith {

/// A progress bar on standard error with the rate and the time left, for anything longer than two
/// seconds. On a terminal it is redrawn in place; elsewhere a line appears now and then.
class Progress {
 public:
  /// `total`: the work in any unit (seconds of a recording); `unit` names it. 0 where it is not
  /// known.
  Progress(std::string task, double total, bool quiet, std::string unit = "s");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Update(double done);
  /// Clears the bar.
  void Finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string task_;
  double total_;
  bool quiet_;
  std::string unit_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point last_draw_;
};

}  // namespace regolith

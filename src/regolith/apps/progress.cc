// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace regolith {
namespace {

constexpr double kSilentSeconds = 2.0;
constexpr double kTerminalInterval = 0.2;
constexpr double kPlainInterval = 20.0;
constexpr int kBarWidth = 30;

double Seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Progress::Progress(std::string task, double total, bool quiet, std::string unit)
    : task_(std::move(task)),
      total_(total),
      quiet_(quiet),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_draw_(start_) {}

Progress::~Progress() { Finish(); }

void Progress::Update(double done) {
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const double elapsed = Seconds(now - start_);
  const double interval = terminal_ ? kTerminalInterval : kPlainInterval;
  if (elapsed < kSilentSeconds || Seconds(now - last_draw_) < interval) return;
  last_draw_ = now;
  const double rate = done / elapsed;
  if (total_ <= 0.0) {
    std::fprintf(stderr, "%s%s  %.1f %s, %.2f %s/s%s", terminal_ ? "\r" : "", task_.c_str(), done,
                 unit_.c_str(), rate, unit_.c_str(), terminal_ ? "\033[K" : "\n");
  } else {
    const double share = std::clamp(done / total_, 0.0, 1.0);
    const auto filled = static_cast<size_t>(share * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    const double left = rate > 0.0 ? std::max(0.0, total_ - done) / rate : 0.0;
    std::fprintf(stderr, "%s%s [%s] %3.0f %%  %.1f of %.1f %s, %.2f %s/s, %.0f s left%s",
                 terminal_ ? "\r" : "", task_.c_str(), bar.c_str(), 100.0 * share, done, total_,
                 unit_.c_str(), rate, unit_.c_str(), left, terminal_ ? "\033[K" : "\n");
  }
  drawn_ = true;
}

void Progress::Finish() {
  if (drawn_ && terminal_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace regolith

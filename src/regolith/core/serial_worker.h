// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace regolith {

/// Works off tasks one after the other, in their order: on a thread of its own, or without one in
/// the caller's. What tasks see of each other is the same either way, as long as each waits for
/// what it needs (WaitFor). One thread posts.
class SerialWorker {
 public:
  /// `capacity`: tasks that may wait; who posts more is held up. 0: no thread, Post works at once.
  explicit SerialWorker(size_t capacity);
  ~SerialWorker();  ///< as Stop(), and waits for the task at work
  SerialWorker(const SerialWorker&) = delete;
  SerialWorker& operator=(const SerialWorker&) = delete;

  /// Throws what an earlier task threw. After that no task is worked off, but all count as done, so
  /// that nobody waits for ever.
  void Post(std::function<void()> task);

  size_t posted() const;
  size_t done() const;
  /// Until so many tasks are done; they have been posted or will be. Does not throw. Returns early
  /// after Stop().
  void WaitFor(size_t count) const;
  /// Leaves tasks that still wait, and those who wait for them.
  void Stop();
  /// Throws what a task threw, if one did.
  void RethrowFailure() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "regolith/system/event_merger.h"
#include "regolith/system/live_options.h"
#include "regolith/system/slam_system.h"

namespace regolith {

/// How a live run does.
struct LiveStatus {
  size_t processed = 0;       ///< measurements
  size_t waiting = 0;         ///< for others, or to be worked off
  size_t dropped_scans = 0;   ///< since they came faster than they could be worked off
  size_t dropped_images = 0;  ///< likewise
  size_t dropped_imu = 0;     ///< likewise, IMU and wheels
  double behind = 0.0;        ///< s, from what is worked off to the newest measurement
  size_t time_jumps = 0;
  size_t resets = 0;    ///< new starts, by jumps, by request or after a failure
  std::string failure;  ///< of the last new start that a failure caused
};

/// A SlamSystem fed by live sensors: brings measurements into order, works them off in a thread of
/// its own, and never falls behind without bound. Where nothing is dropped, it does just what an
/// offline run of the same measurements does.
class LiveSlam {
 public:
  using Factory = std::function<std::unique_ptr<SlamSystem>()>;
  using Task = std::function<void(SlamSystem&)>;
  /// Told, in the worker's thread, of each measurement and of the frames that are completed since;
  /// of frames alone where none comes.
  using Listener =
      std::function<void(SlamSystem&, const SensorEvent*, const std::vector<FrameReport>&)>;
  /// Told, in the worker's thread, that everything begins anew.
  using ResetListener = std::function<void(const std::string& reason)>;

  /// `gravity` (m/s²) is that of the rig. The first system is made at once; its thread pool is to
  /// be used by nobody else.
  LiveSlam(Factory factory, size_t topics, double gravity, const LiveOptions& options,
           Listener listener, ResetListener reset_listener);
  /// Ends without working off what still waits.
  ~LiveSlam();
  LiveSlam(const LiveSlam&) = delete;
  LiveSlam& operator=(const LiveSlam&) = delete;

  /// A measurement just in, on the IMU's clock. Never waits for the estimator.
  void Push(size_t topic, SensorEvent event);

  /// The state at the newest IMU sample pushed: the estimator's, carried on by the samples that it
  /// has not seen yet. Frame `odom`. Nothing before the first estimate.
  std::optional<NavState> Predicted() const;

  /// Runs a task between two measurements, in the worker's thread, on a system that has settled,
  /// and waits for it; what it throws is thrown here.
  void Ask(const Task& task);
  /// Begins anew, as if just started, after what is being worked off.
  void Reset(const std::string& reason);

  LiveStatus status() const;
  EventMerger::Dropped dropped(size_t topic) const;
  /// Whether nothing waits.
  bool idle() const;

 private:
  struct Request {
    const Task* task;
    std::exception_ptr error;
    bool done = false;
  };

  void Run();
  bool AnswerRequests(std::unique_lock<std::mutex>* lock);
  void BeginAnew(std::unique_lock<std::mutex>* lock);
  void WorkOff(std::unique_lock<std::mutex>* lock);
  void Settle(std::unique_lock<std::mutex>* lock);
  void Enqueue(std::vector<SensorEvent> events);
  void DropOldest();
  void AskForReset(const std::string& reason);
  void AddImu(const ImuSample& sample);
  void Rebase(const std::optional<NavState>& state);

  Factory factory_;
  LiveOptions options_;
  Eigen::Vector3d gravity_world_;
  Listener listener_;
  ResetListener reset_listener_;
  std::unique_ptr<SlamSystem> system_;  ///< the worker's alone

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable answered_;
  EventMerger merger_;
  std::deque<SensorEvent> queue_;
  std::deque<Request*> requests_;
  std::optional<std::string> reset_;
  LiveStatus status_;
  int scans_ = 0;   ///< in the queue
  int images_ = 0;  ///< likewise
  TimeNs newest_ = 0;
  bool working_ = false;
  bool stop_ = false;
  bool settled_ = true;

  mutable std::mutex state_mutex_;
  std::deque<ImuSample> samples_;  ///< from the base state's time on
  std::optional<NavState> predicted_;

  std::thread worker_;
};

}  // namespace regolith

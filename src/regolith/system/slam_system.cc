// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/slam_system.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "regolith/core/error.h"

namespace regolith {
namespace {

/// Measurements that may wait for one side: about a second of all sensors.
constexpr size_t kWaitingEvents = 300;
constexpr size_t kWaitingKeyframes = 4;
/// s for which another than the first subsystem has to have led, before a notice says so.
constexpr double kWorthSaying = 1.0;

bool HasVisualOdometry(const PipelineOptions& options, const RigCalibration& rig) {
  return rig.imu && TracksImages(options, rig);
}

/// What a pipeline with a lidar becomes on a rig without one, where the others can go on.
PipelineOptions AdaptedTo(PipelineOptions options, const RigCalibration& rig,
                          std::vector<std::string>* notices) {
  if (options.odometry != OdometryKind::kLio || !options.lio.lidar || rig.lidar) return options;
  if (options.visual && HasVisualOdometry(options, rig)) {
    options.odometry = OdometryKind::kVio;
    notices->push_back("the rig has no lidar: visual–inertial odometry goes alone");
  } else if (options.lio.wheels && rig.wheels && rig.imu) {
    options.lio.lidar = false;
    notices->push_back("the rig has no lidar: IMU and wheels go alone");
  }
  return options;
}

void CheckLidar(const PipelineOptions& options, const RigCalibration& rig) {
  const bool needs_lidar = options.odometry == OdometryKind::kLegoLoam || options.lio.lidar;
  if (!needs_lidar || rig.lidar) return;
  throw InputError("pipeline " + options.name,
                   "needs a lidar, but the rig has none; add `lidar:` to the rig file");
}

/// Without the lidar everything hangs on the other two; where one is absent, what would be left is
/// no such pipeline.
void CheckInertialSensors(const PipelineOptions& options, const RigCalibration& rig) {
  if (options.odometry != OdometryKind::kLio || options.lio.lidar) return;
  const char* lacking = !rig.imu ? "imu" : options.lio.wheels && !rig.wheels ? "wheels" : nullptr;
  if (lacking == nullptr) return;
  throw InputError("pipeline " + options.name,
                   Concatenate("does not use the lidar, and the rig has no ", lacking, "; add `",
                               lacking, ":` to the rig file or set lio.lidar=true"));
}

/// Visual–inertial odometry needs both of its sensors; the lidar's stamps say when poses are
/// wanted.
SensorNeeds VisualNeeds(const PipelineOptions& options, const RigCalibration& rig) {
  const char* lacking = nullptr;
  if (!rig.imu) lacking = "imu";
  if (!TracksImages(options, rig)) lacking = "camera that `tracked_camera` names";
  if (lacking != nullptr) {
    throw InputError("pipeline " + options.name,
                     Concatenate("needs an IMU and a camera, and the rig has no ", lacking,
                                 "; add it to the rig file"));
  }
  SensorNeeds needs;
  needs.imu = true;
  needs.lidar = rig.lidar.has_value();
  needs.wheels = options.vio.wheels && rig.wheels.has_value();
  needs.may_lack_wheels = true;
  needs.cameras.push_back(options.tracked_camera);
  if (options.vio.stereo) needs.cameras.push_back(RightCamera(options, rig));
  return needs;
}

/// The two cameras alone; the lidar's stamps say when poses are wanted.
SensorNeeds StereoNeeds(const PipelineOptions& options, const RigCalibration& rig) {
  SensorNeeds needs;
  needs.lidar = rig.lidar.has_value();
  needs.cameras = {options.tracked_camera, RightCamera(options, rig)};
  return needs;
}

SensorNeeds NeedsOf(const PipelineOptions& options, const RigCalibration& rig) {
  if (options.odometry == OdometryKind::kStereo) return StereoNeeds(options, rig);
  if (options.odometry == OdometryKind::kVio) return VisualNeeds(options, rig);
  CheckLidar(options, rig);
  CheckInertialSensors(options, rig);
  SensorNeeds needs;
  const bool tracks = TracksImages(options, rig);
  const bool is_lio = options.odometry == OdometryKind::kLio;
  needs.imu = is_lio && options.lio.imu && rig.imu.has_value();
  needs.lidar = rig.lidar.has_value();
  const bool is_visual = tracks && options.visual && needs.imu;
  needs.wheels =
      is_lio && (options.lio.wheels || (is_visual && options.vio.wheels)) && rig.wheels.has_value();
  // The trajectory stands without them, unless it is made of them.
  needs.may_lack_cameras = true;
  needs.may_lack_wheels = !is_lio || options.lio.lidar;
  if (tracks) needs.cameras.push_back(options.tracked_camera);
  if (is_visual && options.vio.stereo) needs.cameras.push_back(RightCamera(options, rig));
  return needs;
}

VisualRole RoleOf(const PipelineOptions& options, const RigCalibration& rig) {
  if (options.odometry == OdometryKind::kVio) return VisualRole::kLeads;
  return options.visual && HasVisualOdometry(options, rig) ? VisualRole::kHelps
                                                           : VisualRole::kTracks;
}

std::vector<std::string> LackingSensors(const PipelineOptions& options, const RigCalibration& rig) {
  std::vector<std::string> notices;
  const bool is_visual = options.odometry == OdometryKind::kVio || options.visual;
  if (!rig.wheels && options.vio.wheels && is_visual) {
    notices.push_back("vio.wheels is set, but the rig has no wheels: it goes without");
  }
  if (is_visual && !HasVisualOdometry(options, rig)) {
    notices.push_back(
        Concatenate("visual odometry does not run: the rig has no ",
                    rig.imu ? "camera `" + options.tracked_camera + "`" : std::string("imu")));
  }
  return notices;
}

/// LegoLoam has loops of its own; without the lidar nothing confirms them.
bool HasBackend(const PipelineOptions& options) {
  return options.backend.enabled && options.odometry == OdometryKind::kLio && options.lio.lidar;
}

bool FindsLoopsByImages(const PipelineOptions& options) {
  return options.backend.close_loops && options.visual_loops.enabled;
}

/// The entries of measurements before `end`, in their order.
template <typename Value>
std::vector<Value> TakeBefore(size_t end, std::deque<std::pair<size_t, Value>>* entries) {
  std::vector<Value> taken;
  for (; !entries->empty() && entries->front().first < end; entries->pop_front()) {
    taken.push_back(std::move(entries->front().second));
  }
  return taken;
}

}  // namespace

bool TracksImages(const PipelineOptions& options, const RigCalibration& rig) {
  return rig.cameras.count(options.tracked_camera) > 0;
}

SensorNeeds SensorsNeeded(const PipelineOptions& options, const RigCalibration& rig) {
  std::vector<std::string> notices;
  return NeedsOf(AdaptedTo(options, rig, &notices), rig);
}

SlamSystem::SlamSystem(const PipelineOptions& options, const RigCalibration& rig,
                       ThreadPool* threads, std::optional<Image> camera_mask)
    : options_(AdaptedTo(options, rig, &setup_notices_)),
      needs_(NeedsOf(options_, rig)),
      supervisor_(options.supervisor),
      visual_worker_(threads->threads() > 1 ? kWaitingEvents : 0),
      lidar_worker_(threads->threads() > 1 ? kWaitingEvents : 0) {
  for (std::string& notice : LackingSensors(options_, rig)) {
    setup_notices_.push_back(std::move(notice));
  }
  if (options_.odometry == OdometryKind::kStereo) {
    stereo_ = std::make_unique<StereoPipeline>(options_, rig, RightCamera(options_, rig),
                                               camera_mask, threads);
    return;
  }
  if (HasBackend(options_)) {
    backend_ = std::make_unique<BackendPart>(options_.backend, threads,
                                             threads->threads() > 1 ? kWaitingKeyframes : 0);
  }
  if (options_.odometry != OdometryKind::kVio) {
    LidarPart::KeyframeSink sink;
    if (backend_) {
      sink = [this](KeyframeInput keyframe, std::optional<KeyframeSight> sight) {
        backend_->Add(std::move(keyframe), std::move(sight));
      };
    }
    lidar_ = std::make_unique<LidarPart>(options_, rig, threads, std::move(sink));
  }
  if (backend_ && !needs_.cameras.empty() && FindsLoopsByImages(options_)) {
    backend_->LookForLoops(options_.places,
                           std::make_unique<PlaceObserver>(options_, rig, camera_mask));
    lidar_->CollectSights(options_.tracked_camera, options_.visual_loops.scan_distance);
  }
  if (!needs_.cameras.empty()) {
    visual_ =
        std::make_unique<VisualPart>(options_, rig, RoleOf(options_, rig), std::move(camera_mask));
  }
}

SlamSystem::~SlamSystem() {
  visual_worker_.Stop();
  lidar_worker_.Stop();
  if (backend_) backend_->Stop();
}

/// How many measurements, from the first on, are older by the feedback's delay.
size_t SlamSystem::OlderThanFeedback(TimeNs time) {
  const TimeNs newest = AddSeconds(time, -options_.feedback_delay);
  young_times_.push_back(time);
  while (young_times_.front() <= newest) young_times_.pop_front();
  return count_ + 1 - young_times_.size();
}

/// `known`: measurements of which the lidar's side has to have told first. Without an event the
/// side finishes, which is numbered like one.
void SlamSystem::PostVisual(size_t number, size_t known, std::shared_ptr<const SensorEvent> event) {
  visual_worker_.Post([this, number, known, event = std::move(event)] {
    lidar_worker_.WaitFor(known);
    std::vector<std::shared_ptr<const ScanEstimate>> estimates;
    {
      const std::lock_guard lock(exchange_);
      estimates = TakeBefore(known, &estimates_);
    }
    for (const auto& estimate : estimates) visual_->AddScanEstimate(*estimate);
    std::vector<FrameReport> reports = event ? visual_->Process(*event) : visual_->Finish();
    const std::lock_guard lock(exchange_);
    if (visual_->tracks().stamp != tracks_.stamp) tracks_ = visual_->tracks();
    for (FrameReport& report : reports) visual_reports_.emplace_back(number, std::move(report));
    if (lidar_) {
      velocities_.emplace_back(number, visual_->TakeVelocities());
    } else if (!reports.empty()) {
      newest_ = visual_->Newest();
    }
  });
}

void SlamSystem::PostLidar(size_t number, std::shared_ptr<const SensorEvent> event) {
  lidar_worker_.Post([this, number, event = std::move(event)] {
    std::vector<std::vector<BodyVelocity>> velocities;
    if (visual_) {
      visual_worker_.WaitFor(number + 1);
      const std::lock_guard lock(exchange_);
      velocities = TakeBefore(number + 1, &velocities_);
    }
    for (const auto& group : velocities) {
      for (const BodyVelocity& velocity : group) lidar_->AddVelocity(velocity);
    }
    std::vector<FrameReport> reports = event ? lidar_->Process(*event) : lidar_->Finish();
    std::vector<std::shared_ptr<const ScanEstimate>> estimates = lidar_->TakeEstimates();
    const std::lock_guard lock(exchange_);
    for (FrameReport& report : reports) lidar_reports_.emplace_back(number, std::move(report));
    for (auto& estimate : estimates) {
      if (estimate->inertial) newest_ = estimate->inertial;
      if (visual_) estimates_.emplace_back(number, std::move(estimate));
    }
  });
}

void SlamSystem::FollowLive(const SensorEvent& event) {
  if (const auto* sample = std::get_if<ImuSample>(&event)) live_.AddImu(*sample);
  const std::lock_guard lock(exchange_);
  if (newest_) live_.Correct(*std::exchange(newest_, std::nullopt));
}

std::vector<FrameReport> SlamSystem::Process(SensorEvent event) {
  RethrowFailure();
  const TimeNs time = EventTime(event);
  if (std::holds_alternative<LidarScan>(event)) ++scans_seen_;
  if (std::holds_alternative<ImuSample>(event)) {
    sensor_times_.push_back({count_, {Subsystem::kImu, time}});
  } else if (std::holds_alternative<WheelOdometry>(event)) {
    sensor_times_.push_back({count_, {Subsystem::kWheels, time}});
  }
  if (stereo_) return ProcessStereo(event);
  const auto shared = std::make_shared<const SensorEvent>(std::move(event));
  const size_t known = lidar_ ? OlderThanFeedback(time) : 0;
  if (visual_) PostVisual(count_, known, shared);
  if (lidar_) PostLidar(count_, shared);
  ++count_;
  FollowLive(*shared);
  return Collect();
}

/// On the caller's thread: there is nothing beside it that could go on meanwhile.
std::vector<FrameReport> SlamSystem::ProcessStereo(const SensorEvent& event) {
  std::vector<FrameReport> reports;
  if (const auto* scan = std::get_if<LidarScan>(&event)) stereo_->AddStamp(scan->stamp);
  if (const auto* frame = std::get_if<CameraFrame>(&event)) {
    reports = Report(stereo_->AddImage(*frame));
  }
  ++count_;
  return reports;
}

std::vector<FrameReport> SlamSystem::Report(std::vector<StereoReport> pairs) {
  std::vector<FrameReport> reports;
  for (StereoReport& pair : pairs) {
    FrameReport report;
    report.source = FrameSource::kImage;
    report.stamp = pair.estimate.stamp;
    report.end = pair.estimate.stamp;
    report.completed = std::chrono::steady_clock::now();
    if (pair.estimate.T_world_camera) report.leader = "camera";
    report.T_world_body = pair.T_world_body;
    report.features = std::move(pair.features);
    report.stages = std::move(pair.stages);
    report.stereo = std::move(pair.estimate);
    Supervise(count_, &report);
    reports.push_back(std::move(report));
  }
  return reports;
}

std::vector<FrameReport> SlamSystem::Settle() {
  visual_worker_.WaitFor(visual_worker_.posted());
  lidar_worker_.WaitFor(lidar_worker_.posted());
  if (backend_) backend_->Settle();
  return Collect();
}

std::vector<FrameReport> SlamSystem::Finish() {
  if (stereo_) return Report(stereo_->Finish());
  RethrowFailure();
  std::vector<FrameReport> reports = Settle();
  if (visual_) PostVisual(count_, lidar_ ? count_ : 0, nullptr);
  if (lidar_) PostLidar(count_, nullptr);
  ++count_;
  for (FrameReport& report : Settle()) reports.push_back(std::move(report));
  RethrowFailure();
  return reports;
}

/// Both sides' reports in the order of their measurements, the camera's first, as far as nothing
/// can come before them any more.
std::vector<FrameReport> SlamSystem::Collect() {
  constexpr size_t kAll = std::numeric_limits<size_t>::max();
  const size_t visual_done = visual_ ? visual_worker_.done() : kAll;
  const size_t lidar_done = lidar_ ? lidar_worker_.done() : kAll;
  std::vector<FrameReport> reports;
  const std::lock_guard lock(exchange_);
  while (true) {
    const size_t visual = visual_reports_.empty() ? kAll : visual_reports_.front().first;
    const size_t lidar = lidar_reports_.empty() ? kAll : lidar_reports_.front().first;
    if (visual == kAll && lidar == kAll) break;
    const bool is_visual = visual <= lidar;
    const size_t number = is_visual ? visual : lidar;
    if (is_visual ? lidar_done < number : visual_done < number + 1) break;
    Numbered<FrameReport>& source = is_visual ? visual_reports_ : lidar_reports_;
    FrameReport& front = source.front().second;
    if (front.keyframe) {
      if (!backend_->HasDone(*front.keyframe)) break;
      for (StageTime& stage : backend_->TakeStages(*front.keyframe)) {
        front.stages.push_back(std::move(stage));
      }
    }
    Supervise(number, &front);
    reports.push_back(std::move(front));
    source.pop_front();
  }
  return reports;
}

void SlamSystem::ObserveSensors(size_t number) {
  for (const auto& [subsystem, time] : TakeBefore(number + 1, &sensor_times_)) {
    TimeNs& last = observed_[static_cast<size_t>(subsystem)];
    last = std::max(last, time);
    supervisor_.Observe(subsystem, last, true);
  }
}

void SlamSystem::Supervise(size_t number, FrameReport* report) {
  ObserveSensors(number);
  const auto observe = [&](Subsystem subsystem, TimeNs time, bool is_good) {
    TimeNs& last = observed_[static_cast<size_t>(subsystem)];
    last = std::max(last, time);
    supervisor_.Observe(subsystem, last, is_good);
  };
  if (report->source == FrameSource::kScan && report->has_scan) {
    const bool is_matched = report->leader.rfind("lidar", 0) == 0;
    observe(Subsystem::kLidar, report->stamp,
            is_matched &&
                report->degenerate_directions <= options_.supervisor.max_degenerate_directions);
  } else if (report->visual && report->visual->has_image) {
    observe(Subsystem::kCamera, report->end, report->visual->health == VioHealth::kGood);
  } else if (report->stereo) {
    observe(Subsystem::kCamera, report->end, report->stereo->T_world_camera.has_value());
  }
  const TimeNs now = std::max(supervised_.value_or(report->end), report->end);
  report->led_by = supervisor_.Leader(now);
  for (size_t i = 0; i < kSubsystems; ++i) {
    report->states[i] = supervisor_.State(static_cast<Subsystem>(i), now);
  }
  const size_t leader = report->led_by ? static_cast<size_t>(*report->led_by) : kSubsystems;
  if (supervised_) led_seconds_[leader] += SecondsBetween(*supervised_, now);
  supervised_ = now;
}

void SlamSystem::RethrowFailure() const {
  visual_worker_.RethrowFailure();
  lidar_worker_.RethrowFailure();
  if (backend_) backend_->RethrowFailure();
}

ImageTracks SlamSystem::tracks() const {
  const std::lock_guard lock(exchange_);
  return tracks_;
}

const Trajectory& SlamSystem::odometry() const {
  if (stereo_) return stereo_->odometry();
  return lidar_ ? lidar_->trajectory() : visual_->trajectory();
}

size_t SlamSystem::images_seen() const {
  if (stereo_) return stereo_->images_seen();
  return visual_ ? visual_->images() : 0;
}

const Backend* SlamSystem::backend() const {
  if (stereo_) return stereo_->backend();
  return backend_ ? &backend_->backend() : nullptr;
}

size_t SlamSystem::stamps_seen() const {
  if (lidar_) return lidar_->stamps();
  return scans_seen_ > 0 ? scans_seen_ : images_seen();
}

KeyframeCounts SlamSystem::keyframe_counts() const {
  if (backend_) {
    const Backend& backend = backend_->backend();
    return {backend.keyframes().size(), backend.loops_accepted(), backend.loops_rejected()};
  }
  if (lidar_) return lidar_->Counts();
  if (stereo_) return stereo_->Counts();
  KeyframeCounts counts;
  counts.keyframes = visual_->keyframes();
  return counts;
}

std::vector<std::string> SlamSystem::Notices() const {
  std::vector<std::string> notices = setup_notices_;
  const auto add = [&](std::vector<std::string> more) {
    for (std::string& notice : more) notices.push_back(std::move(notice));
  };
  if (lidar_) add(lidar_->Notices());
  if (visual_) add(visual_->Notices());
  if (stereo_) add(stereo_->Notices());
  std::string led;
  double others = 0.0;
  const double most = *std::max_element(led_seconds_.begin(), led_seconds_.end());
  for (size_t i = 0; i <= kSubsystems; ++i) {
    if (led_seconds_[i] < 0.05) continue;
    if (led_seconds_[i] < most) others += led_seconds_[i];
    char text[64];
    std::snprintf(text, sizeof text, "%s%s %.1f s", led.empty() ? "" : ", ",
                  i < kSubsystems ? SubsystemName(static_cast<Subsystem>(i)) : "nobody",
                  led_seconds_[i]);
    led += text;
  }
  if (others > kWorthSaying) notices.push_back("led by: " + led);
  return notices;
}

Trajectory SlamSystem::trajectory() const {
  if (stereo_) return stereo_->Refined();
  if (!lidar_) return visual_->Refined();
  if (backend_) return backend_->backend().Corrected(odometry());
  return lidar_->Refined().value_or(odometry());
}

std::vector<MapPoint> SlamSystem::MapPoints() const {
  if (stereo_) return stereo_->MapPoints();
  if (!lidar_) return {};
  if (!backend_ && !lidar_->Refined()) return lidar_->map().points();
  const Trajectory best = trajectory();
  std::vector<SE3> corrections;
  for (size_t i = 0; i < odometry().size(); ++i) {
    corrections.push_back(best.poses()[i].T_world_body *
                          odometry().poses()[i].T_world_body.Inverse());
  }
  return lidar_->map().Moved(corrections);
}

}  // namespace regolith

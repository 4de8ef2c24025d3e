// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/simulator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/sim/camera_simulator.h"
#include "regolith/sim/drive_planner.h"
#include "regolith/sim/ground.h"
#include "regolith/sim/imu_simulator.h"
#include "regolith/sim/lidar_simulator.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/preview.h"
#include "regolith/sim/route_layout.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/terrain_mesh.h"
#include "regolith/sim/wheel_simulator.h"
#include "regolith/terrain/surface.h"

namespace regolith {
namespace {

constexpr TimeNs kEpoch = 1'700'000'000'000'000'000;  // an arbitrary date, as a real recorder's
constexpr double kTruthRate = 100.0;                  // Hz
constexpr double kTerrainMargin = 30.0;               // m
constexpr double kTerrainSpacing = 0.05;
constexpr double kPathEnd = 1.0;  // s of path beyond the last measurement
const char* const kCameras[] = {"mono", "left", "right"};

std::unique_ptr<Surface> MakeSurface(const ScenarioOptions& options, const HeightGrid* dem) {
  if (dem != nullptr) return CreateDemSurface(*dem, options.terrain, options.seed);
  return CreateGeneratedSurface(options.terrain, options.seed,
                                DriveBox(options.drive, options.seed));
}

std::vector<Eigen::Vector2d> Places(const RoverMotion& motion, double duration) {
  std::vector<Eigen::Vector2d> places;
  for (double time = 0.0; time <= duration; time += 0.5) {
    places.emplace_back(motion.SmoothAt(time).T_world_imu.translation.head<2>());
  }
  return places;
}

// The measurements of one sensor, evenly spaced.
struct Schedule {
  double rate = 1.0;          // Hz
  double stamp_offset = 0.0;  // s, of the stamp after the true time
  double last_start = 0.0;    // s, true time up to which measurements begin
  uint64_t next = 0;

  double true_time() const { return static_cast<double>(next) / rate; }
  TimeNs stamp() const { return AddSeconds(kEpoch, true_time() + stamp_offset); }
  bool done() const { return true_time() > last_start + 1e-9; }
};

class RoverSimulator : public Simulator {
 public:
  RoverSimulator(const ScenarioOptions& options, const HeightGrid* dem, ThreadPool* pool)
      : options_(options),
        pool_(pool),
        surface_(MakeSurface(options, dem)),
        drive_(PlanDrive(*surface_, options.drive, options.rover, options.seed,
                         options.duration + kPathEnd, kMotionInterval)),
        motion_(*surface_, drive_.path, options.rover, options.vibration, options.seed),
        ground_(*surface_, motion_.origin()),
        photometry_(options.planet, options.sun),
        mesh_(TerrainMesh::Create(ground_, Places(motion_, options.duration), photometry_.sun(),
                                  options.mesh, pool)),
        camera_(options.camera, *mesh_, photometry_, pool),
        lidar_(options.lidar, *mesh_, motion_, StreamSeed(options.seed, "lidar"), pool),
        imu_(options.imu, options.gravity, options.seed),
        wheels_(options.wheels, options.seed) {
    lidar_.CalibrateDropout({0.0, options.duration / 3.0, options.duration / 1.5});
    const double end = options.duration;
    imu_schedule_ = {options.imu.rate, 0.0, end};
    wheel_schedule_ = {options.wheels.rate, 0.0, end};
    lidar_schedule_ = {options.lidar.rate, 0.0, end - 1.0 / options.lidar.rate};
    camera_schedule_ = {options.camera.rate, options.camera.time_offset, end};
  }

  std::optional<SensorEvent> Next() override;

  TimeNs start_time() const override { return kEpoch; }
  TimeNs end_time() const override { return AddSeconds(kEpoch, options_.duration); }
  std::vector<std::string> Notices() const override { return {}; }

  RigCalibration rig() const override { return NominalRig(options_); }

  SE3 T_world_imu(TimeNs time) const override {
    return motion_.PoseAt(SecondsBetween(kEpoch, time));
  }

  Trajectory Truth() const override {
    Trajectory truth;
    const auto count = static_cast<int64_t>(std::floor(options_.duration * kTruthRate + 1e-9));
    for (int64_t i = 0; i <= count; ++i) {
      const TimeNs time = AddSeconds(kEpoch, static_cast<double>(i) / kTruthRate);
      truth.Append({time, T_world_imu(time)});
    }
    return truth;
  }

  HeightGrid TerrainAroundPath() const override;

  Image Preview() override {
    std::vector<Eigen::Vector3d> track;
    const SE3 T_imu_base = BaseFromImu().Inverse();
    for (double time = 0.0; time <= options_.duration; time += 0.25) {
      track.push_back((motion_.SmoothAt(time).T_world_imu * T_imu_base).translation);
    }
    return RenderPreview(*mesh_, photometry_, track, pool_);
  }

  double steepest_slope() const override { return drive_.steepest; }

 private:
  SensorEvent NextImu();
  SensorEvent NextWheels();
  SensorEvent NextScan();
  SensorEvent NextFrame();

  ScenarioOptions options_;
  ThreadPool* pool_;
  std::unique_ptr<Surface> surface_;
  Drive drive_;
  RoverMotion motion_;
  Ground ground_;
  Photometry photometry_;
  std::unique_ptr<TerrainMesh> mesh_;
  CameraSimulator camera_;
  LidarSimulator lidar_;
  ImuSimulator imu_;
  WheelSimulator wheels_;
  Schedule imu_schedule_;
  Schedule wheel_schedule_;
  Schedule lidar_schedule_;
  Schedule camera_schedule_;
  size_t next_camera_ = 0;
};

std::optional<SensorEvent> RoverSimulator::Next() {
  // Equal stamps go in this order.
  const Schedule* const schedules[] = {&imu_schedule_, &wheel_schedule_, &camera_schedule_,
                                       &lidar_schedule_};
  const Schedule* first = nullptr;
  for (const Schedule* schedule : schedules) {
    if (schedule->done()) continue;
    if (first == nullptr || schedule->stamp() < first->stamp()) first = schedule;
  }
  if (first == nullptr) return std::nullopt;
  if (first == &imu_schedule_) return NextImu();
  if (first == &wheel_schedule_) return NextWheels();
  if (first == &camera_schedule_) return NextFrame();
  return NextScan();
}

SensorEvent RoverSimulator::NextImu() {
  ImuSample sample = imu_.Measure(motion_.At(imu_schedule_.true_time()));
  sample.time = imu_schedule_.stamp();
  ++imu_schedule_.next;
  return sample;
}

SensorEvent RoverSimulator::NextWheels() {
  WheelOdometry odometry = wheels_.Measure(motion_.SmoothAt(wheel_schedule_.true_time()));
  odometry.time = wheel_schedule_.stamp();
  ++wheel_schedule_.next;
  return odometry;
}

SensorEvent RoverSimulator::NextScan() {
  LidarScan scan = lidar_.Scan(lidar_schedule_.true_time(), lidar_schedule_.next);
  scan.stamp = lidar_schedule_.stamp();
  ++lidar_schedule_.next;
  return scan;
}

// The three cameras are triggered together and come one after the other, with equal stamps.
SensorEvent RoverSimulator::NextFrame() {
  CameraFrame frame;
  frame.camera = kCameras[next_camera_];
  frame.time = camera_schedule_.stamp();
  const SE3 T_world_camera =
      motion_.PoseAt(camera_schedule_.true_time()) *
      (BaseFromImu().Inverse() * BaseFromCamera(options_.camera, frame.camera));
  frame.image = camera_.Render(T_world_camera, StreamSeed(options_.seed, frame.camera),
                               camera_schedule_.next);
  if (++next_camera_ == std::size(kCameras)) {
    next_camera_ = 0;
    ++camera_schedule_.next;
  }
  return frame;
}

HeightGrid RoverSimulator::TerrainAroundPath() const {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& place : Places(motion_, options_.duration)) box.extend(place);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kTerrainMargin);
  const Eigen::Vector2d origin = motion_.origin().head<2>();
  return SampleSurface(*surface_, {box.min() - margin + origin, box.max() + margin + origin},
                       kTerrainSpacing, motion_.origin());
}

}  // namespace

std::unique_ptr<Simulator> Simulator::Create(const ScenarioOptions& options, const HeightGrid* dem,
                                             ThreadPool* pool) {
  REGOLITH_CHECK(pool != nullptr, "the simulator needs threads");
  options.Check();
  return std::make_unique<RoverSimulator>(options, dem, pool);
}

}  // namespace regolith

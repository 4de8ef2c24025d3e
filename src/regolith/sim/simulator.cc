// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/simulator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/sim/camera_simulator.h"
#include "regolith/sim/drive_planner.h"
#include "regolith/sim/ground.h"
#include "regolith/sim/imu_simulator.h"
#include "regolith/sim/lidar_simulator.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/preview.h"
#include "regolith/sim/renderer.h"
#include "regolith/sim/route_layout.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/rover_shadow.h"
#include "regolith/sim/rover_view.h"
#include "regolith/sim/scene.h"
#include "regolith/sim/wheel_simulator.h"
#include "regolith/terrain/surface.h"

namespace regolith {
namespace {

constexpr TimeNs kEpoch = 1'700'000'000'000'000'000;  // an arbitrary date, as a real recorder's
constexpr double kTruthRate = 100.0;                  // Hz
constexpr double kTerrainMargin = 30.0;               // m
constexpr double kTerrainSpacing = 0.05;
constexpr double kSettlePeriod = 1.0;  // s between two exchanges of ground tiles
constexpr int kOtherSuns = 4;          // in a set of pairs
constexpr double kPairYaw = 0.2;       // rad, standard deviations between the images of a pair
constexpr double kPairTilt = 0.06;     // rad
constexpr double kPairShift = 0.25;    // m
constexpr double kPathEnd = 1.0;       // s of path beyond the last measurement

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

std::vector<Rock> RocksInWorld(const Surface& surface, const Drive& drive,
                               const RoverMotion& motion, double duration) {
  std::vector<Eigen::Vector2d> places = Places(motion, duration);
  for (Eigen::Vector2d& place : places) place += motion.origin().head<2>();
  std::vector<Rock> rocks = RocksAroundPath(surface, places);
  rocks.erase(std::remove_if(rocks.begin(), rocks.end(),
                             [&](const Rock& rock) { return drive.Clears(rock.centre); }),
              rocks.end());
  for (Rock& rock : rocks) {
    rock.centre -= motion.origin().head<2>();
    rock.ground -= motion.origin().z();
  }
  return rocks;
}

// What is needed to see the same ground under another sun.
struct OtherSun {
  OtherSun(const ScenarioOptions& options, const SunOptions& sun, const Ground& ground,
           const std::vector<Eigen::Vector2d>& places, std::vector<Rock> rocks, ThreadPool* pool)
      : photometry(options.planet, sun, options.terrain.albedo.mean),
        scene(Scene::Create(ground, places, std::move(rocks), photometry, options.mesh, pool)),
        renderer(MakeIntrinsics(options.camera), *scene, photometry, pool) {}

  Photometry photometry;
  std::unique_ptr<Scene> scene;
  Renderer renderer;
};

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
        photometry_(options.planet, options.sun, options.terrain.albedo.mean),
        scene_(Scene::Create(ground_, Places(motion_, options.duration),
                             RocksInWorld(*surface_, drive_, motion_, options.duration),
                             photometry_, options.mesh, pool)),
        renderer_(MakeIntrinsics(options.camera), *scene_, photometry_, pool),
        camera_(options.camera, renderer_, pool),
        cameras_(CameraNames(options.camera)),
        lidar_(options.lidar, *scene_, motion_, StreamSeed(options.seed, "lidar"), pool),
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

  RigCalibration rig() const override { return NominalRig(options_, cameras_); }

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
    return RenderPreview(*scene_, photometry_, track, pool_);
  }

  ImagePair Pair(int index, int count) override;

  double steepest_slope() const override { return drive_.steepest; }

 private:
  SensorEvent NextImu();
  SensorEvent NextWheels();
  SensorEvent NextScan();
  SensorEvent NextFrame();
  void Settle(double time);
  Exposure ChooseExposure(const std::string& camera, const RenderedView& view);
  void ChangeOtherSun(int index);

  ScenarioOptions options_;
  ThreadPool* pool_;
  std::unique_ptr<Surface> surface_;
  Drive drive_;
  RoverMotion motion_;
  Ground ground_;
  Photometry photometry_;
  std::unique_ptr<Scene> scene_;
  Renderer renderer_;
  CameraSimulator camera_;
  std::vector<std::string> cameras_;
  std::map<std::string, ExposureControl> exposure_controls_;
  std::map<std::string, Exposure> exposures_;
  RenderedView first_view_;
  std::unique_ptr<NearbyView> nearby_;
  RenderedView view_;
  int64_t settled_ = -1;
  std::unique_ptr<OtherSun> other_sun_;
  int other_sun_index_ = -1;
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
  Settle(lidar_schedule_.true_time());
  LidarScan scan = lidar_.Scan(lidar_schedule_.true_time(), lidar_schedule_.next);
  scan.stamp = lidar_schedule_.stamp();
  ++lidar_schedule_.next;
  return scan;
}

// Which tiles there are depends on the simulated time alone.
void RoverSimulator::Settle(double time) {
  const auto period = static_cast<int64_t>(std::floor(time / kSettlePeriod + 1e-9));
  if (period == settled_) return;
  settled_ = period;
  const double start = static_cast<double>(period) * kSettlePeriod;
  scene_->MoveTo(motion_.SmoothAt(start).T_world_imu.translation.head<2>());
}

// The right camera is exposed as the left one, so that a pair looks alike.
Exposure RoverSimulator::ChooseExposure(const std::string& camera, const RenderedView& view) {
  if (camera == "right") return exposures_.at("left");
  ExposureControl& control = exposure_controls_.try_emplace(camera, options_.camera).first->second;
  return exposures_[camera] = control.Next(view);
}

// The cameras are triggered together and come one after the other, with equal stamps.
SensorEvent RoverSimulator::NextFrame() {
  CameraFrame frame;
  frame.camera = cameras_[next_camera_];
  frame.time = camera_schedule_.stamp();
  Settle(camera_schedule_.true_time());
  const MotionState motion = motion_.At(camera_schedule_.true_time());
  const SE3 T_world_base = motion.T_world_imu * BaseFromImu().Inverse();
  const SE3 T_imu_camera = BaseFromImu().Inverse() * BaseFromCamera(options_.camera, frame.camera);
  const SE3 T_world_camera = motion.T_world_imu * T_imu_camera;
  const RoverShadow rover(RoverBody(), T_world_base);
  // The first camera stands between the others and spares them rays.
  const bool is_first = next_camera_ == 0;
  RenderedView& view = is_first ? first_view_ : view_;
  renderer_.Render(T_world_camera, {&rover, LampOnRover(options_, T_world_base)}, &view,
                   is_first ? nullptr : nearby_.get());
  if (is_first && cameras_.size() > 1) {
    nearby_ = std::make_unique<NearbyView>(view, T_world_camera, MakeIntrinsics(options_.camera),
                                           0.5 * options_.camera.baseline, *scene_);
  }
  frame.image =
      camera_.Expose(view, CameraMotionOf(motion, T_imu_camera), ChooseExposure(frame.camera, view),
                     StreamSeed(options_.seed, frame.camera), camera_schedule_.next);
  if (++next_camera_ == cameras_.size()) {
    next_camera_ = 0;
    ++camera_schedule_.next;
  }
  return frame;
}

// Casting a scene's light takes seconds, so many pairs share one other sun.
void RoverSimulator::ChangeOtherSun(int index) {
  if (index == other_sun_index_) return;
  other_sun_index_ = index;
  Random random(options_.seed, "other sun");
  SunOptions sun = options_.sun;
  for (int i = 0; i <= index; ++i) {
    sun.azimuth_deg = options_.sun.azimuth_deg + random.Uniform(60.0, 300.0);
    sun.elevation_deg = random.Uniform(8.0, 50.0);
  }
  other_sun_.reset();
  other_sun_ = std::make_unique<OtherSun>(
      options_, sun, ground_, Places(motion_, options_.duration),
      RocksInWorld(*surface_, drive_, motion_, options_.duration), pool_);
}

ImagePair RoverSimulator::Pair(int index, int count) {
  Random random(StreamSeed(options_.seed, "pair") + static_cast<uint64_t>(index));
  const double time = options_.drive.rest + (options_.duration - options_.drive.rest) *
                                                (index + 0.5) / static_cast<double>(count);
  const SE3 T_imu_camera = BaseFromImu().Inverse() * BaseFromCamera(options_.camera, "mono");
  const SE3 T_world_first = motion_.PoseAt(time) * T_imu_camera;
  const double later = std::min(time + random.Uniform(0.0, 3.0), options_.duration);
  // Turned and shifted as if the rover had come back another way.
  const Eigen::Quaterniond turn =
      Eigen::AngleAxisd(random.Gaussian(0.0, kPairYaw), Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(random.Gaussian(0.0, kPairTilt), Eigen::Vector3d::UnitX()) *
      Eigen::AngleAxisd(random.Gaussian(0.0, kPairTilt), Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d shift(random.Gaussian(0.0, kPairShift), 0.0,
                              random.Gaussian(0.0, kPairShift));
  const SE3 T_world_second = motion_.PoseAt(later) * T_imu_camera * SE3(turn, shift);
  const Eigen::Vector2d place = T_world_first.translation.head<2>();
  scene_->MoveTo(place);
  settled_ = -1;
  ImagePair pair;
  pair.same_sun = index % 2 == 0;
  if (!pair.same_sun) {
    ChangeOtherSun(index * kOtherSuns / count);
    other_sun_->scene->MoveTo(place);
  }
  pair.baseline = (T_world_second.translation - T_world_first.translation).norm();
  pair.rotation = T_world_first.rotation.angularDistance(T_world_second.rotation);
  const auto seed = StreamSeed(options_.seed, "pair noise");
  const auto frame = 2 * static_cast<uint64_t>(index);
  const auto expose = [&](const Renderer& renderer, const SE3& T_world_camera, uint64_t number) {
    const SE3 T_world_base = T_world_camera * BaseFromCamera(options_.camera, "mono").Inverse();
    renderer.Render(T_world_camera, {nullptr, LampOnRover(options_, T_world_base)}, &view_);
    return camera_.Expose(view_, CameraMotion{}, ExposureControl(options_.camera).Next(view_), seed,
                          number);
  };
  pair.second = expose(pair.same_sun ? renderer_ : other_sun_->renderer, T_world_second, frame + 1);
  pair.first = expose(renderer_, T_world_first, frame);
  FindFlow(*scene_, renderer_, MakeIntrinsics(options_.camera), T_world_first, T_world_second,
           pool_, &pair);
  return pair;
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

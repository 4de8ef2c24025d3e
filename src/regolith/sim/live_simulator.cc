// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/live_simulator.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/sim/camera_simulator.h"
#include "regolith/sim/drive_planner.h"
#include "regolith/sim/ground.h"
#include "regolith/sim/imu_simulator.h"
#include "regolith/sim/lidar_simulator.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/renderer.h"
#include "regolith/sim/route_layout.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/rover_shadow.h"
#include "regolith/sim/rover_view.h"
#include "regolith/sim/scene.h"
#include "regolith/sim/suspension.h"
#include "regolith/sim/wheel_simulator.h"
#include "regolith/terrain/surface.h"

namespace regolith {
namespace {

constexpr TimeNs kEpoch = 1'700'000'000'000'000'000;  // an arbitrary date
constexpr double kDegree = M_PI / 180.0;
constexpr double kPlaceStep = 2.0;       // m between the places of the arena that the scene knows
constexpr double kSettlePeriod = 1.0;    // s between two exchanges of ground tiles
constexpr double kStartRoute = 12.0;     // m of free way ahead of the start
constexpr double kStartDuration = 30.0;  // s
constexpr double kKnownMargin = 3.0;     // m
constexpr double kFenderAhead = 0.15;    // m, of a wheel beyond its contact point
constexpr double kFenderAside = 0.1;     // m

struct Place {
  Eigen::Vector2d position;
  double yaw;
};

/// Where a planned drive would begin: level, and with a free way ahead.
Place FindStart(const Surface& surface, const ScenarioOptions& options) {
  DriveOptions drive = options.drive;
  if (drive.route != "waypoints") {
    drive.route = "wander";
    drive.length = std::min(drive.length, kStartRoute);
  }
  const Drive plan =
      PlanDrive(surface, drive, options.rover, options.seed, kStartDuration, kMotionInterval);
  return {plan.path.front().position, plan.path.front().yaw};
}

std::unique_ptr<Surface> MakeSurface(const ScenarioOptions& options, const HeightGrid* dem) {
  if (dem != nullptr) return CreateDemSurface(*dem, options.terrain, options.seed);
  return CreateGeneratedSurface(options.terrain, options.seed,
                                DriveBox(options.drive, options.seed));
}

/// How far (m) the rover's wheels reach into a rock; 0 where they keep clear of all.
double DepthInRocks(const std::vector<Rock>& rocks, const PlanarPose& pose) {
  const Eigen::Rotation2Dd to_body(-pose.yaw);
  double depth = 0.0;
  for (const Rock& rock : rocks) {
    const Eigen::Vector2d place = to_body * (rock.centre - pose.position);
    const double beyond_x = std::abs(place.x()) - kHalfWheelbase - kFenderAhead;
    const double beyond_y = std::abs(place.y()) - kHalfTrack - kFenderAside;
    const double distance = std::hypot(std::max(beyond_x, 0.0), std::max(beyond_y, 0.0));
    depth = std::max(depth, 0.5 * rock.diameter - distance);
  }
  return depth;
}

double Approach(double value, double target, double step) {
  return value + std::clamp(target - value, -step, step);
}

/// Drives by commands, one step of the motion after the other.
class CommandedDrive {
 public:
  CommandedDrive(const Surface& surface, const ScenarioOptions& options, const Place& start)
      : surface_(surface),
        options_(options),
        start_(start.position),
        suspension_(surface, options.rover) {
    pose_.position = start.position;
    pose_.yaw = start.yaw;
  }

  const PlanarPose& pose() const { return pose_; }
  const std::string& obstacle() const { return obstacle_; }
  Suspension* suspension() { return &suspension_; }

  void Command(double speed, double yaw_rate) {
    using Limits = LiveDriveLimits;
    const auto bounded = [](double value, double limit) {
      return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0;
    };
    wanted_speed_ = bounded(speed, Limits::kSpeed);
    wanted_yaw_rate_ = bounded(yaw_rate, Limits::kYawRate);
  }

  void Step() {
    using Limits = LiveDriveLimits;
    const double dt = kMotionInterval;
    yaw_rate_ = Approach(yaw_rate_, wanted_yaw_rate_, dt * Limits::kYawAcceleration);
    PlanarPose next = pose_;
    next.speed = Approach(pose_.speed, wanted_speed_, dt * Limits::kAcceleration);
    next.yaw += dt * yaw_rate_;
    const double heading = 0.5 * (pose_.yaw + next.yaw);
    const double way = 0.5 * dt * (pose_.speed + next.speed);
    next.position += way * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    const bool moves = way != 0.0 || yaw_rate_ != 0.0;
    if (!moves) {
      pose_ = next;
      return;
    }
    obstacle_ = ObstacleAt(next);
    if (obstacle_.empty()) {
      pose_ = next;
      return;
    }
    pose_.speed = 0.0;
    yaw_rate_ = 0.0;
  }

 private:
  /// Leaving a bad place is allowed, going deeper is not.
  std::string ObstacleAt(const PlanarPose& next) {
    if (!surface_.Known(next.position.x(), next.position.y(), kKnownMargin)) {
      return "the ground ends there";
    }
    const auto beyond = [&](const PlanarPose& pose) {
      return (pose.position - start_).cwiseAbs().maxCoeff();
    };
    if (beyond(next) > LiveSimulator::kArena && beyond(next) > beyond(pose_)) {
      return "the arena ends there";
    }
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(3.0);
    const std::vector<Rock> rocks =
        surface_.Rocks({next.position - reach, next.position + reach}, kObstacle);
    const double depth = DepthInRocks(rocks, next);
    if (depth > 0.0 && depth > DepthInRocks(rocks, pose_)) return "a rock";
    const Stance stance = suspension_.At(next.position, next.yaw);
    if (stance.travel > options_.rover.rocker_travel) return "a wheel would lose the ground";
    if (stance.Tilt() > options_.drive.max_slope_deg * kDegree &&
        stance.Tilt() > suspension_.At(pose_.position, pose_.yaw).Tilt()) {
      return "too steep";
    }
    return {};
  }

  const Surface& surface_;
  const ScenarioOptions& options_;
  Eigen::Vector2d start_;
  Suspension suspension_;
  PlanarPose pose_;
  double yaw_rate_ = 0.0;
  double wanted_speed_ = 0.0;
  double wanted_yaw_rate_ = 0.0;
  std::string obstacle_;
};

/// The measurements of one sensor, evenly spaced.
struct Schedule {
  double rate = 1.0;          // Hz
  double stamp_offset = 0.0;  // s, of the stamp after the true time
  double duration = 0.0;      // s, that a measurement takes
  uint64_t next = 0;

  double true_time() const { return static_cast<double>(next) / rate; }
  double due() const { return true_time() + duration; }
  TimeNs stamp() const { return AddSeconds(kEpoch, true_time() + stamp_offset); }
};

class CommandedRover : public LiveSimulator {
 public:
  CommandedRover(const ScenarioOptions& options, const HeightGrid* dem, const std::string& camera,
                 ThreadPool* pool)
      : options_(options),
        camera_name_(camera),
        surface_(MakeSurface(options_, dem)),
        drive_(*surface_, options_, FindStart(*surface_, options_)),
        motion_(*surface_, std::vector<PlanarPose>(1, drive_.pose()), options_.rover,
                options_.vibration, options_.seed),
        ground_(*surface_, motion_.origin()),
        photometry_(options_.planet, options_.sun, options_.terrain.albedo.mean),
        scene_(Scene::Create(ground_, Arena(), RocksInArena(), photometry_, options_.mesh, pool)),
        renderer_(MakeIntrinsics(options_.camera), *scene_, photometry_, pool),
        camera_(options_.camera, renderer_, pool),
        exposure_(options_.camera),
        lidar_(options_.lidar, *scene_, motion_, StreamSeed(options_.seed, "lidar"), pool),
        imu_(options_.imu, options_.gravity, options_.seed),
        wheels_(options_.wheels, options_.seed) {
    lidar_.CalibrateDropout({0.0});
    imu_schedule_.rate = options_.imu.rate;
    wheel_schedule_.rate = options_.wheels.rate;
    camera_schedule_.rate = options_.camera.rate;
    camera_schedule_.stamp_offset = options_.camera.time_offset;
    lidar_schedule_.rate = options_.lidar.rate;
    lidar_schedule_.duration = 1.0 / options_.lidar.rate;
  }

  void Command(double speed, double yaw_rate) override { drive_.Command(speed, yaw_rate); }
  TimeNs next_time() const override { return AddSeconds(kEpoch, First().due()); }
  SensorEvent Next() override;

  SE3 T_world_imu(TimeNs time) const override {
    return motion_.PoseAt(SecondsBetween(kEpoch, time));
  }
  SE3 T_world_base(TimeNs time) const override {
    return T_world_imu(time) * BaseFromImu().Inverse();
  }
  std::array<double, 4> wheel_angles() const override { return wheel_angles_; }
  std::string obstacle() const override { return drive_.obstacle(); }

 private:
  const Schedule& First() const;
  void DriveUntil(double time);
  void Settle(double time);
  void TurnWheels(const MotionState& motion);
  SensorEvent NextFrame();

  /// World: the start lies at its origin.
  std::vector<Eigen::Vector2d> Arena() const {
    std::vector<Eigen::Vector2d> places = {Eigen::Vector2d::Zero()};
    for (double x = -kArena; x <= kArena; x += kPlaceStep) {
      for (double y = -kArena; y <= kArena; y += kPlaceStep) places.emplace_back(x, y);
    }
    return places;
  }

  std::vector<Rock> RocksInArena() const {
    std::vector<Eigen::Vector2d> places = Arena();
    for (Eigen::Vector2d& place : places) place += motion_.origin().head<2>();
    std::vector<Rock> rocks = RocksAroundPath(*surface_, places);
    for (Rock& rock : rocks) {
      rock.centre -= motion_.origin().head<2>();
      rock.ground -= motion_.origin().z();
    }
    return rocks;
  }

  ScenarioOptions options_;
  std::string camera_name_;
  std::unique_ptr<Surface> surface_;
  CommandedDrive drive_;
  RoverMotion motion_;
  Ground ground_;
  Photometry photometry_;
  std::unique_ptr<Scene> scene_;
  Renderer renderer_;
  CameraSimulator camera_;
  ExposureControl exposure_;
  RenderedView view_;
  LidarSimulator lidar_;
  ImuSimulator imu_;
  WheelSimulator wheels_;
  Schedule imu_schedule_;
  Schedule wheel_schedule_;
  Schedule camera_schedule_;
  Schedule lidar_schedule_;
  std::array<double, 4> wheel_angles_{};
  int64_t settled_ = -1;
};

const Schedule& CommandedRover::First() const {
  // Of those due together in this order.
  const Schedule* first = &imu_schedule_;
  for (const Schedule* schedule : {&wheel_schedule_, &camera_schedule_, &lidar_schedule_}) {
    if (schedule == &camera_schedule_ && camera_name_.empty()) continue;
    if (schedule->due() < first->due() - 1e-9) first = schedule;
  }
  return *first;
}

void CommandedRover::DriveUntil(double time) {
  while (motion_.settled() <= time) {
    drive_.Step();
    motion_.Append(drive_.pose(), options_.rover, drive_.suspension());
  }
}

SensorEvent CommandedRover::Next() {
  const Schedule& first = First();
  const double time = first.true_time();
  DriveUntil(first.due());
  SensorEvent event;
  if (&first == &imu_schedule_) {
    ImuSample sample = imu_.Measure(motion_.At(time));
    sample.time = first.stamp();
    event = sample;
    ++imu_schedule_.next;
  } else if (&first == &wheel_schedule_) {
    const MotionState motion = motion_.SmoothAt(time);
    TurnWheels(motion);
    WheelOdometry odometry = wheels_.Measure(motion);
    odometry.time = first.stamp();
    event = odometry;
    ++wheel_schedule_.next;
  } else if (&first == &camera_schedule_) {
    event = NextFrame();
    ++camera_schedule_.next;
  } else {
    Settle(time);
    LidarScan scan = lidar_.Scan(time, first.next);
    scan.stamp = first.stamp();
    event = std::move(scan);
    ++lidar_schedule_.next;
  }
  return event;
}

void CommandedRover::TurnWheels(const MotionState& motion) {
  const double speed = (motion.T_world_imu.rotation.conjugate() * motion.v_world_imu).x();
  for (size_t i = 0; i < wheel_angles_.size(); ++i) {
    const double side = i % 2 == 0 ? kHalfTrack : -kHalfTrack;
    const double along = speed - motion.angular_velocity_imu.z() * side;
    wheel_angles_[i] += along / (options_.rover.wheel_radius * options_.wheels.rate);
  }
}

void CommandedRover::Settle(double time) {
  const auto period = static_cast<int64_t>(std::floor(time / kSettlePeriod + 1e-9));
  if (period == settled_) return;
  settled_ = period;
  scene_->MoveTo(motion_.SmoothAt(time).T_world_imu.translation.head<2>());
}

SensorEvent CommandedRover::NextFrame() {
  const double time = camera_schedule_.true_time();
  Settle(time);
  const MotionState motion = motion_.At(time);
  const SE3 T_world_base = motion.T_world_imu * BaseFromImu().Inverse();
  const SE3 T_imu_camera = BaseFromImu().Inverse() * BaseFromCamera(options_.camera, camera_name_);
  const RoverShadow rover(RoverBody(), T_world_base);
  renderer_.Render(motion.T_world_imu * T_imu_camera, {&rover, LampOnRover(options_, T_world_base)},
                   &view_);
  CameraFrame frame;
  frame.camera = camera_name_;
  frame.time = camera_schedule_.stamp();
  frame.image = camera_.Expose(view_, CameraMotionOf(motion, T_imu_camera), exposure_.Next(view_),
                               StreamSeed(options_.seed, camera_name_), camera_schedule_.next);
  return frame;
}

}  // namespace

std::unique_ptr<LiveSimulator> LiveSimulator::Create(const ScenarioOptions& options,
                                                     const HeightGrid* dem,
                                                     const std::string& camera, ThreadPool* pool) {
  REGOLITH_CHECK(pool != nullptr, "the simulator needs threads");
  REGOLITH_CHECK(camera.empty() || camera == "mono" || camera == "left" || camera == "right",
                 "camera ", camera);
  options.Check();
  return std::make_unique<CommandedRover>(options, dem, camera, pool);
}

RigCalibration LiveSimulator::Rig(const ScenarioOptions& options, const std::string& camera) {
  if (camera.empty()) return NominalRig(options, {});
  return NominalRig(options, {camera});
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/test_world_internal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/geometry/alignment.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kImuStep = 0.005;   // s
constexpr double kFrameStep = 0.1;   // s
constexpr double kWheelStep = 0.02;  // s
const Eigen::Vector2d kHalfImage(320.0, 240.0);

Course Constant(double value) { return {value, 0.0, 0.0}; }

Eigen::Vector3d GaussianVector(Random* random, double sigma) {
  const double x = random->Gaussian(0.0, sigma);
  const double y = random->Gaussian(0.0, sigma);
  return {x, y, random->Gaussian(0.0, sigma)};
}

Eigen::Vector3d Values(const Course& x, const Course& y, const Course& z) {
  return {x.value, y.value, z.value};
}

void RecordImu(const TestMotion& motion, const TestSensors& sensors, double duration, uint64_t seed,
               TestRecording* recording) {
  Random random(seed, "imu");
  const ImuNoise& noise = sensors.noise;
  if (sensors.has_biases) {
    recording->gyro_bias = GaussianVector(&random, noise.gyro_bias_sigma);
    recording->accelerometer_bias = GaussianVector(&random, noise.accelerometer_bias_sigma);
  }
  Eigen::Vector3d gyro_bias = recording->gyro_bias;
  Eigen::Vector3d accelerometer_bias = recording->accelerometer_bias;
  const Eigen::Vector3d gravity(0.0, 0.0, -sensors.gravity);
  const double root = std::sqrt(kImuStep);
  const int count = static_cast<int>(std::lround(duration / kImuStep));
  for (int i = 0; i <= count; ++i) {
    const TrueMotion truth = TrueMotionAt(motion, i * kImuStep);
    ImuSample sample;
    sample.time = FromSeconds(i * kImuStep);
    sample.angular_velocity =
        truth.rate_imu + gyro_bias + GaussianVector(&random, noise.gyro_density / root);
    sample.specific_force =
        truth.T_world_imu.rotation.conjugate() * (truth.acceleration_world - gravity) +
        accelerometer_bias + GaussianVector(&random, noise.accelerometer_density / root);
    recording->imu.push_back(sample);
    gyro_bias += GaussianVector(&random, noise.gyro_walk * root);
    accelerometer_bias += GaussianVector(&random, noise.accelerometer_walk * root);
  }
}

/// The camera's tracks: a landmark that leaves the image comes back as another one.
class TestCamera {
 public:
  TestCamera(const std::vector<Eigen::Vector3d>& landmarks, const TestSensors& sensors,
             uint64_t seed)
      : landmarks_(landmarks), sensors_(sensors), random_(seed, "camera") {}

  std::vector<TrackedFeature> See(const SE3& T_world_imu) {
    const SE3 T_camera_world = (T_world_imu * sensors_.T_imu_camera).Inverse();
    std::map<size_t, Eigen::Vector2d> seen;
    for (size_t i = 0; i < landmarks_.size(); ++i) {
      const Eigen::Vector3d point = T_camera_world * landmarks_[i];
      if (point.z() <= 0.1 || point.norm() < sensors_.nearest || point.norm() > sensors_.farthest) {
        continue;
      }
      const Eigen::Vector2d offset = kTestFocal * point.hnormalized();
      if ((offset.cwiseAbs() - kHalfImage).maxCoeff() < 0.0) seen[i] = offset;
    }
    std::map<size_t, int64_t> ids;
    for (const auto& [landmark, id] : ids_) {
      if (seen.count(landmark) > 0) ids[landmark] = id;
    }
    for (const auto& [landmark, offset] : seen) {
      if (static_cast<int>(ids.size()) >= sensors_.max_features) break;
      if (ids.try_emplace(landmark, next_id_).second) ++next_id_;
    }
    ids_ = std::move(ids);
    std::vector<TrackedFeature> features;
    for (const auto& [landmark, id] : ids_) features.push_back(MakeFeature(id, seen[landmark]));
    std::sort(features.begin(), features.end(),
              [](const auto& first, const auto& second) { return first.id < second.id; });
    return features;
  }

 private:
  TrackedFeature MakeFeature(int64_t id, const Eigen::Vector2d& offset) {
    const double u = offset.x() + random_.Gaussian(0.0, sensors_.pixel_sigma);
    const double v = offset.y() + random_.Gaussian(0.0, sensors_.pixel_sigma);
    TrackedFeature feature;
    feature.id = id;
    feature.pixel = (Eigen::Vector2d(u, v) + kHalfImage).cast<float>();
    feature.bearing = Eigen::Vector3d(u / kTestFocal, v / kTestFocal, 1.0).normalized();
    return feature;
  }

  const std::vector<Eigen::Vector3d>& landmarks_;
  TestSensors sensors_;
  Random random_;
  std::map<size_t, int64_t> ids_;
  int64_t next_id_ = 0;
};

void RecordWheels(const TestMotion& motion, const TestSensors& sensors, double duration,
                  TestRecording* recording) {
  constexpr double kTurnFactor = 1.1;
  const double factor = sensors.wheel_scale / (1.0 - sensors.wheel_slip);
  const auto base_at = [&](double time) {
    return TrueMotionAt(motion, time).T_world_imu * sensors.T_imu_base;
  };
  WheelOdometry odometry;
  recording->wheels.push_back(odometry);
  const int count = static_cast<int>(std::lround(duration / kWheelStep));
  for (int i = 1; i <= count; ++i) {
    const SE3 step = base_at((i - 1) * kWheelStep).Inverse() * base_at(i * kWheelStep);
    const double turn = kTurnFactor * LogSo3(step.rotation).z();
    const SE3 measured(ExpSo3({0.0, 0.0, turn}), {factor * step.translation.x(), 0.0, 0.0});
    odometry.T_odom_base = odometry.T_odom_base * measured;
    odometry.time = FromSeconds(i * kWheelStep);
    recording->wheels.push_back(odometry);
  }
}

}  // namespace

Course operator+(const Course& first, const Course& second) {
  return {first.value + second.value, first.rate + second.rate,
          first.acceleration + second.acceleration};
}

Course operator*(const Course& first, const Course& second) {
  return {first.value * second.value, first.rate * second.value + first.value * second.rate,
          first.acceleration * second.value + 2.0 * first.rate * second.rate +
              first.value * second.acceleration};
}

Course operator*(double factor, const Course& course) { return Constant(factor) * course; }

Course Sine(const Course& angle) {
  const double sine = std::sin(angle.value);
  const double cosine = std::cos(angle.value);
  return {sine, cosine * angle.rate, cosine * angle.acceleration - sine * angle.rate * angle.rate};
}

Course Wave(double time, double amplitude, double frequency, double phase) {
  const double pulsation = 2.0 * kPi * frequency;
  return amplitude * Sine({pulsation * time + phase, pulsation, 0.0});
}

Course SmoothStep(double time, double start, double duration) {
  const double u = std::clamp((time - start) / duration, 0.0, 1.0);
  return {u * u * u * (10.0 + u * (6.0 * u - 15.0)),
          30.0 * u * u * (1.0 - u) * (1.0 - u) / duration,
          60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (duration * duration)};
}

Course Drive(double time, double start, double end, double speed, double ramp) {
  // The speed is a smooth step up at the start and one down at the end; this is the way of one.
  const auto way = [&](double begin) -> Course {
    const double u = std::clamp((time - begin) / ramp, 0.0, 1.0);
    const double beyond = std::max(time - begin - ramp, 0.0);
    return {ramp * (u * u * u - 0.5 * u * u * u * u) + beyond, u * u * (3.0 - 2.0 * u),
            6.0 * u * (1.0 - u) / ramp};
  };
  return speed * (way(start) + -1.0 * way(end - ramp));
}

TrueMotion TrueMotionAt(const TestMotion& motion, double time) {
  const BodyCourse course = motion(time);
  const double roll = course.roll.value;
  const double pitch = course.pitch.value;
  TrueMotion truth;
  truth.T_world_imu.translation = Values(course.x, course.y, course.z);
  truth.T_world_imu.rotation =
      ExpSo3({0.0, 0.0, course.yaw.value}) * ExpSo3({0.0, pitch, 0.0}) * ExpSo3({roll, 0.0, 0.0});
  truth.v_world_imu = {course.x.rate, course.y.rate, course.z.rate};
  truth.acceleration_world = {course.x.acceleration, course.y.acceleration, course.z.acceleration};
  const double along = course.yaw.rate * std::cos(pitch);
  truth.rate_imu = {course.roll.rate - course.yaw.rate * std::sin(pitch),
                    course.pitch.rate * std::cos(roll) + along * std::sin(roll),
                    along * std::cos(roll) - course.pitch.rate * std::sin(roll)};
  return truth;
}

TestMotion RoverMotion() {
  return [](double time) {
    constexpr double kHeading = kPi / 3.0;
    const Course first = Drive(time, 3.0, 11.0, 0.5, 0.8);
    const Course second = Drive(time, 17.5, 25.5, 0.5, 0.8);
    const Course way = first + second;
    const auto bump = [&](double amplitude, double length, double phase) {
      return amplitude * Sine((2.0 * kPi / length) * way + Constant(phase));
    };
    BodyCourse course;
    course.x = first + std::cos(kHeading) * second;
    course.y = std::sin(kHeading) * second;
    course.z = Constant(0.6) + bump(0.015, 1.7, 0.3) + bump(0.005, 0.6, 1.0);
    course.roll = bump(0.02, 2.1, 1.2) + bump(0.01, 0.7, 0.2);
    course.pitch = bump(0.025, 1.5, 0.7) + bump(0.01, 0.5, 2.0);
    course.yaw = kHeading * SmoothStep(time, 11.2, 5.8) + bump(0.01, 3.0, 0.0);
    return course;
  };
}

TestMotion HandHeldMotion(double start) {
  return [start](double time) {
    const Course begun = SmoothStep(time, start, 1.5);
    const auto waves = [&](double amplitude, double frequency, double phase) {
      return begun * (Wave(time, amplitude, frequency, phase) +
                      Wave(time, 0.3 * amplitude, 2.3 * frequency, 2.0 * phase + 1.0));
    };
    BodyCourse course;
    course.x = waves(0.5, 0.31, 0.4);
    course.y = waves(0.6, 0.24, 1.7);
    course.z = waves(0.35, 0.41, 2.9);
    course.roll = waves(0.25, 0.37, 0.9);
    course.pitch = waves(0.25, 0.29, 2.2);
    course.yaw = waves(0.5, 0.23, 0.1);
    return course;
  };
}

std::vector<Eigen::Vector3d> GroundLandmarks(uint64_t seed) {
  Random random(seed, "ground");
  std::vector<Eigen::Vector3d> landmarks;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.Uniform(-4.0, 22.0);
    const double y = random.Uniform(-12.0, 22.0);
    landmarks.emplace_back(x, y, random.Uniform(-0.05, 0.05));
    if (i % 5 == 0) landmarks.back().z() = random.Uniform(0.0, 0.5);
  }
  return landmarks;
}

std::vector<Eigen::Vector3d> RoomLandmarks(uint64_t seed) {
  Random random(seed, "room");
  std::vector<Eigen::Vector3d> landmarks;
  for (int i = 0; i < 1500; ++i) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (double& coordinate : point) coordinate = random.Uniform(-4.0, 4.0);
    const int wall = i % 6;
    point[wall / 2] = (wall % 2 == 0 ? -1.0 : 1.0) * random.Uniform(2.5, 4.0);
    landmarks.push_back(point);
  }
  return landmarks;
}

SE3 TestCameraPose() {
  Eigen::Matrix3d R_level_camera;
  R_level_camera << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return {ExpSo3({0.0, 15.0 * kPi / 180.0, 0.0}) * Eigen::Quaterniond(R_level_camera),
          {0.10, 0.03, 0.50}};
}

RigCalibration TestRig(const TestSensors& sensors) {
  RigCalibration rig;
  rig.gravity = sensors.gravity;
  rig.imu.emplace();
  rig.imu->noise = sensors.noise;
  CameraCalibration& camera = rig.cameras["mono"];
  camera.T_imu_camera = sensors.T_imu_camera;
  camera.intrinsics.width = 640;
  camera.intrinsics.height = 480;
  camera.intrinsics.focal.setConstant(kTestFocal);
  camera.intrinsics.principal_point = kHalfImage;
  rig.wheels.emplace();
  rig.wheels->T_imu_base = sensors.T_imu_base;
  return rig;
}

TestRecording Record(const TestMotion& motion, const std::vector<Eigen::Vector3d>& landmarks,
                     const TestSensors& sensors, double duration, uint64_t seed) {
  TestRecording recording;
  RecordImu(motion, sensors, duration, seed, &recording);
  TestCamera camera(landmarks, sensors, seed);
  const int count = static_cast<int>(std::lround(duration / kFrameStep));
  for (int i = 1; i < count; ++i) {
    const double time = i * kFrameStep;
    VioFrame frame;
    frame.stamp = FromSeconds(time - sensors.time_offset);
    frame.features = camera.See(TrueMotionAt(motion, time).T_world_imu);
    recording.frames.push_back(std::move(frame));
  }
  RecordWheels(motion, sensors, duration, &recording);
  return recording;
}

TestRun::TestRun(const VioOptions& options, const RigCalibration& rig,
                 const TestRecording& recording, const TestMotion& motion)
    : odometry_(options, rig, "mono", ""), motion_(motion) {
  const auto take = [this](std::vector<VioEstimate> estimates) {
    for (VioEstimate& estimate : estimates) estimates_.push_back(std::move(estimate));
  };
  size_t frame = 0;
  size_t wheel = 0;
  for (const ImuSample& sample : recording.imu) {
    for (; wheel < recording.wheels.size() && recording.wheels[wheel].time <= sample.time;) {
      odometry_.AddWheels(recording.wheels[wheel++]);
    }
    for (; frame < recording.frames.size() && recording.frames[frame].stamp <= sample.time;) {
      take(odometry_.AddFrame(recording.frames[frame++]));
    }
    take(odometry_.AddImu(sample));
  }
  take(odometry_.Finish());
  REGOLITH_CHECK(!estimates_.empty(), "odometry never started");
}

SE3 TestRun::TruePose(const VioEstimate& estimate) const {
  const auto true_at = [&](const NavState& state) {
    return TrueMotionAt(motion_, ToSeconds(state.time)).T_world_imu;
  };
  const NavState& first = estimates_.front().state;
  return first.T_world_imu * true_at(first).Inverse() * true_at(estimate.state);
}

double TestRun::PositionError(const VioEstimate& estimate) const {
  return (estimate.state.T_world_imu.translation - TruePose(estimate).translation).norm();
}

double TestRun::LargestError() const {
  double largest = 0.0;
  for (const VioEstimate& estimate : estimates_) {
    largest = std::max(largest, PositionError(estimate));
  }
  return largest;
}

const VioEstimate& TestRun::Before(double time) const {
  const VioEstimate* last = &estimates_.front();
  for (const VioEstimate& estimate : estimates_) {
    if (ToSeconds(estimate.state.time) < time) last = &estimate;
  }
  return *last;
}

double TestRun::ErrorGrowth(double from, double to) const {
  // The step that odometry says, against the true one in the first pose's own axes: what went wrong
  // before, a heading for instance, is not counted again.
  const auto pose = [](const VioEstimate& estimate) { return estimate.state.T_world_imu; };
  const VioEstimate& first = Before(from);
  const VioEstimate& last = Before(to);
  const SE3 estimated = pose(first).Inverse() * pose(last);
  const SE3 truth = TruePose(first).Inverse() * TruePose(last);
  return (estimated.translation - truth.translation).norm();
}

double TestRun::Scale() const {
  std::vector<Eigen::Vector3d> estimated;
  std::vector<Eigen::Vector3d> truth;
  for (const VioEstimate& estimate : estimates_) {
    estimated.push_back(estimate.state.T_world_imu.translation);
    truth.push_back(TruePose(estimate).translation);
  }
  const auto alignment = AlignPoints(truth, estimated, true);
  REGOLITH_CHECK(alignment.has_value(), estimates_.size(), " positions");
  return alignment->scale;
}

bool TestRun::HasHealth(VioHealth health) const { return HasHealth(health, 0.0, 1e9); }

bool TestRun::HasHealth(VioHealth health, double from, double to) const {
  return std::any_of(estimates_.begin(), estimates_.end(), [&](const VioEstimate& estimate) {
    const double time = ToSeconds(estimate.state.time);
    return estimate.health == health && time >= from && time <= to;
  });
}

bool TestRun::HasNotice(const std::string& part) const {
  const std::vector<std::string> notices = odometry_.Notices();
  return std::any_of(notices.begin(), notices.end(), [&](const std::string& notice) {
    return notice.find(part) != std::string::npos;
  });
}

bool TestRun::IsFinite() const {
  return std::all_of(estimates_.begin(), estimates_.end(), [](const VioEstimate& estimate) {
    return estimate.state.T_world_imu.translation.allFinite() &&
           estimate.state.T_world_imu.rotation.coeffs().allFinite() &&
           estimate.state.v_world_imu.allFinite() && estimate.covariance.allFinite();
  });
}

}  // namespace regolith

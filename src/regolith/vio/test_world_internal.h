// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A world for tests of visual–inertial odometry: closed-form motion, landmarks, and what an IMU, a
// camera and wheels measure there. Bearings without images.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/sensor/rig_calibration.h"
#include "regolith/vio/visual_inertial_odometry.h"

namespace regolith {

/// A value in time, with its derivatives.
struct Course {
  double value = 0.0;
  double rate = 0.0;
  double acceleration = 0.0;
};
Course operator+(const Course& first, const Course& second);
Course operator*(const Course& first, const Course& second);
Course operator*(double factor, const Course& course);
Course Sine(const Course& angle);
/// amplitude · sin(2π frequency (time - start) + phase).
Course Wave(double time, double amplitude, double frequency, double phase);
/// From 0 to 1 without jumps of acceleration.
Course SmoothStep(double time, double start, double duration);
/// The way at `speed` from `start` to `end`, both ends softened over `ramp` s.
Course Drive(double time, double start, double end, double speed, double ramp);

/// Where a body is: position (m) and roll, pitch, yaw (rad; yaw last to be applied).
struct BodyCourse {
  Course x, y, z, roll, pitch, yaw;
};
/// Time (s) → course. What it says is exact.
using TestMotion = std::function<BodyCourse(double)>;

/// What is true of the IMU at one time.
struct TrueMotion {
  SE3 T_world_imu;
  Eigen::Vector3d v_world_imu;
  Eigen::Vector3d acceleration_world;
  Eigen::Vector3d rate_imu;
};
TrueMotion TrueMotionAt(const TestMotion& motion, double time);

/// A rover: 3 s of rest, 4 m at 0.5 m/s to 11 s, a turn of 60° on the spot to 17 s, 4 m more, and
/// from 25.5 s rest. It rocks as it goes.
TestMotion RoverMotion();
/// Rotations and translations about all axes, that begin at `start` (s; -10: moving at 0 s).
TestMotion HandHeldMotion(double start);

/// Ground with stones around the rover's way, and walls of a room of 8 m around the origin.
std::vector<Eigen::Vector3d> GroundLandmarks(uint64_t seed);
std::vector<Eigen::Vector3d> RoomLandmarks(uint64_t seed);

/// Looks forward and 15° down.
SE3 TestCameraPose();

/// Sensors as they are, which may differ from what the rig says.
struct TestSensors {
  double gravity = 9.81;
  ImuNoise noise;
  bool has_biases = true;
  SE3 T_imu_camera = TestCameraPose();
  double pixel_sigma = 0.25;
  double time_offset = 0.0;  ///< s, to be added to the camera's stamps
  int max_features = 120;
  double nearest = 0.4;    ///< m
  double farthest = 15.0;  ///< m
  SE3 T_imu_base = SE3(Eigen::Quaterniond::Identity(), {0.0, 0.0, -0.6});
  double wheel_scale = 1.0;  ///< the wheels' way in their own metres
  double wheel_slip = 0.0;   ///< share of their way that the rover does not go
};

/// The rig that describes the sensors, all of it right, without a time offset.
RigCalibration TestRig(const TestSensors& sensors);

/// Focal length of the camera (pixels), 640 × 480.
inline constexpr double kTestFocal = 381.0;

struct TestRecording {
  std::vector<ImuSample> imu;                                    ///< 200 Hz
  std::vector<VioFrame> frames;                                  ///< 10 Hz, from 0.1 s on
  std::vector<WheelOdometry> wheels;                             ///< 50 Hz
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();           ///< at 0 s
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  ///< at 0 s
};
TestRecording Record(const TestMotion& motion, const std::vector<Eigen::Vector3d>& landmarks,
                     const TestSensors& sensors, double duration, uint64_t seed);

/// Odometry's answer to a recording, against the motion that it was made from.
class TestRun {
 public:
  TestRun(const VioOptions& options, const RigCalibration& rig, const TestRecording& recording,
          const TestMotion& motion);

  const VisualInertialOdometry& odometry() const { return odometry_; }
  const std::vector<VioEstimate>& estimates() const { return estimates_; }
  /// The first pose is odometry's to choose: truth in its world, as of the first estimate.
  SE3 TruePose(const VioEstimate& estimate) const;
  /// m
  double PositionError(const VioEstimate& estimate) const;
  double FinalError() const { return PositionError(estimates_.back()); }
  double LargestError() const;
  /// How far the error changed between the last estimates before two times (s), m.
  double ErrorGrowth(double from, double to) const;
  /// Of all positions against the true ones (similarity alignment).
  double Scale() const;
  bool HasHealth(VioHealth health) const;
  bool HasHealth(VioHealth health, double from, double to) const;
  bool HasNotice(const std::string& part) const;
  bool IsFinite() const;
  /// The last estimate before a time (s).
  const VioEstimate& Before(double time) const;

 private:
  VisualInertialOdometry odometry_;
  TestMotion motion_;
  std::vector<VioEstimate> estimates_;
};

}  // namespace regolith

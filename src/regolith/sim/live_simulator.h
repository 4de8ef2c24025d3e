// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>

#include "regolith/core/thread_pool.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/terrain/height_grid.h"

namespace regolith {

/// Largest commands that are followed, and how fast they are.
struct LiveDriveLimits {
  static constexpr double kSpeed = 0.8;            ///< m/s
  static constexpr double kYawRate = 0.35;         ///< rad/s
  static constexpr double kAcceleration = 0.5;     ///< m/s²
  static constexpr double kYawAcceleration = 0.7;  ///< rad/s²
};

/// A rover that is driven by commands instead of a plan, on the ground of a scenario. Its sensors
/// are those of Simulator, with one camera at most. Commands take effect after 0.3 s, the reach of
/// the spline that makes the motion smooth. The rover stops before rocks, where the ground is too
/// steep for it, and at the border of an arena of 40 m around its start.
class LiveSimulator {
 public:
  static constexpr double kArena = 40.0;  ///< m, half a side

  /// The camera "mono", "left" or "right"; empty: none. `pool` must outlive the simulator. Throws
  /// InputError for a scenario on whose ground no place to start is found.
  static std::unique_ptr<LiveSimulator> Create(const ScenarioOptions& options,
                                               const HeightGrid* dem, const std::string& camera,
                                               ThreadPool* pool);
  virtual ~LiveSimulator() = default;

  /// What the rig file says, with the one camera.
  static RigCalibration Rig(const ScenarioOptions& options, const std::string& camera);

  /// Follows these from now on: m/s ahead, rad/s to the left. What is not finite is taken as 0.
  virtual void Command(double speed, double yaw_rate) = 0;

  /// When the next measurement is there: a scan when its turn has ended.
  virtual TimeNs next_time() const = 0;
  /// The next measurement, in the order of those times.
  virtual SensorEvent Next() = 0;

  /// The truth, up to next_time().
  virtual SE3 T_world_imu(TimeNs time) const = 0;
  virtual SE3 T_world_base(TimeNs time) const = 0;
  /// rad that the front left, front right, rear left and rear right wheel have turned.
  virtual std::array<double, 4> wheel_angles() const = 0;
  /// Why the rover does not go where it is told; empty where it does.
  virtual std::string obstacle() const = 0;
};

}  // namespace regolith

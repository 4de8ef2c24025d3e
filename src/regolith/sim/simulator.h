// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"
#include "regolith/sim/image_pair.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/terrain/height_grid.h"

namespace regolith {

/// A rover drives over ground, and its sensors measure: the same scenario, seed and elevation model
/// give the same events, whatever the number of threads.
class Simulator : public SensorSource {
 public:
  /// Generates the ground, or takes `dem` where it is not null, and lays the path. `pool` must
  /// outlive the simulator. Throws InputError for a scenario that cannot be driven.
  static std::unique_ptr<Simulator> Create(const ScenarioOptions& options, const HeightGrid* dem,
                                           ThreadPool* pool);

  /// What the rig file says; hidden errors of clock, wheels and biases are not in it.
  virtual RigCalibration rig() const = 0;

  /// The true pose of the body at `time`.
  virtual SE3 T_world_imu(TimeNs time) const = 0;
  /// The truth at 100 Hz from the first to the last measurement.
  virtual Trajectory Truth() const = 0;

  /// The ground around the path as far as 30 m, posts 5 cm apart, frame world.
  virtual HeightGrid TerrainAroundPath() const = 0;

  /// A view of the ground for people, with the rover's track drawn in; 1280 × 720.
  virtual Image Preview() = 0;

  /// Pair `index` of `count` along the drive: the mono camera's image, and another from a place up
  /// to a metre or two away, turned; every second pair under another sun. Pairs are to be asked for
  /// in their order.
  virtual ImagePair Pair(int index, int count) = 0;

  /// Steepest slope on the path, rad.
  virtual double steepest_slope() const = 0;
};

}  // namespace regolith

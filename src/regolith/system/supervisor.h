// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "regolith/core/check.h"
#include "regolith/core/time.h"

namespace regolith {

/// In the order in which they lead.
enum class Subsystem { kLidar, kCamera, kWheels, kImu };
inline constexpr size_t kSubsystems = 4;
/// "lidar", "camera", "wheels", "imu".
const char* SubsystemName(Subsystem subsystem);

enum class SubsystemState {
  kAbsent,     ///< nothing came yet
  kGood,       ///< leads, or could
  kPoor,       ///< measures, but says itself that it cannot be trusted
  kSilent,     ///< measured once, and does no more
  kReturning,  ///< measures again, but not for long enough to lead
};
/// "absent", "good", "poor", "silent", "returning".
const char* SubsystemStateName(SubsystemState state);

struct SupervisorOptions {
  /// s without a measurement, in the order of Subsystem, after which one is silent.
  std::array<double, kSubsystems> timeouts = {0.5, 0.5, 0.25, 0.1};
  int poor_measurements = 3;  ///< one after the other, before a subsystem loses the lead
  double return_time = 1.0;   ///< s of good measurements, before one that was lost leads again
  int max_degenerate_directions = 3;  ///< of six; a scan that leaves more of them open is poor

  void Check() const;
};

/// Says which subsystem leads, by these rules:
///   1. The first in the order lidar, camera, wheels, IMU leads that is good.
///   2. A few poor measurements take nobody the lead; several in a row do.
///   3. What was silent or poor leads again only after it was good for a while, so that the lead
///      does not flicker. At the start a first good measurement is enough.
///   4. Where none is good, the IMU leads as long as it measures; else nobody does.
/// Time is that of the measurements, never a clock's, so it is the same on every run.
class Supervisor {
 public:
  explicit Supervisor(const SupervisorOptions& options = SupervisorOptions());

  /// A measurement of a subsystem, and whether it trusts itself: enough matches, no more than it
  /// can bear of degenerate directions. Times of one subsystem do not decrease.
  void Observe(Subsystem subsystem, TimeNs time, bool is_good);

  SubsystemState State(Subsystem subsystem, TimeNs now) const;
  std::optional<Subsystem> Leader(TimeNs now) const;

 private:
  struct Record {
    std::optional<TimeNs> last;
    std::optional<TimeNs> good_since;  ///< nothing while poor
    int poor = 0;                      ///< in a row
    bool was_lost = false;
  };
  bool IsSilent(size_t subsystem, TimeNs now) const;

  SupervisorOptions options_;
  std::array<Record, kSubsystems> records_;
};

}  // namespace regolith

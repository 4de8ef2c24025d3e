// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/supervisor.h"

namespace regolith {

const char* SubsystemName(Subsystem subsystem) {
  constexpr std::array<const char*, kSubsystems> kNames = {"lidar", "camera", "wheels", "imu"};
  return kNames[static_cast<size_t>(subsystem)];
}

const char* SubsystemStateName(SubsystemState state) {
  switch (state) {
    case SubsystemState::kAbsent:
      return "absent";
    case SubsystemState::kGood:
      return "good";
    case SubsystemState::kPoor:
      return "poor";
    case SubsystemState::kSilent:
      return "silent";
    case SubsystemState::kReturning:
      return "returning";
  }
  return "";
}

void SupervisorOptions::Check() const {
  for (const double timeout : timeouts) REGOLITH_CHECK(timeout > 0.0, "timeout=", timeout);
  REGOLITH_CHECK(poor_measurements >= 1, "poor_measurements=", poor_measurements);
  REGOLITH_CHECK(return_time >= 0.0, "return_time=", return_time);
  REGOLITH_CHECK(max_degenerate_directions >= 0 && max_degenerate_directions <= 6,
                 "max_degenerate_directions=", max_degenerate_directions);
}

Supervisor::Supervisor(const SupervisorOptions& options) : options_(options) { options.Check(); }

bool Supervisor::IsSilent(size_t subsystem, TimeNs now) const {
  const Record& record = records_[subsystem];
  return record.last && SecondsBetween(*record.last, now) > options_.timeouts[subsystem];
}

void Supervisor::Observe(Subsystem subsystem, TimeNs time, bool is_good) {
  const auto index = static_cast<size_t>(subsystem);
  Record& record = records_[index];
  REGOLITH_CHECK(!record.last || time >= *record.last, SubsystemName(subsystem), " at ", time,
                 " after ", *record.last);
  if (IsSilent(index, time)) {
    record.was_lost = true;
    record.good_since.reset();
  }
  record.last = time;
  record.poor = is_good ? 0 : record.poor + 1;
  if (record.poor >= options_.poor_measurements) {
    record.was_lost = true;
    record.good_since.reset();
  } else if (is_good && !record.good_since) {
    record.good_since = time;
  }
}

SubsystemState Supervisor::State(Subsystem subsystem, TimeNs now) const {
  const auto index = static_cast<size_t>(subsystem);
  const Record& record = records_[index];
  if (!record.last) return SubsystemState::kAbsent;
  if (IsSilent(index, now)) return SubsystemState::kSilent;
  if (!record.good_since) return SubsystemState::kPoor;
  const bool is_back =
      !record.was_lost || SecondsBetween(*record.good_since, *record.last) >= options_.return_time;
  return is_back ? SubsystemState::kGood : SubsystemState::kReturning;
}

std::optional<Subsystem> Supervisor::Leader(TimeNs now) const {
  for (size_t i = 0; i < kSubsystems; ++i) {
    const auto subsystem = static_cast<Subsystem>(i);
    if (State(subsystem, now) == SubsystemState::kGood) return subsystem;
  }
  const SubsystemState imu = State(Subsystem::kImu, now);
  if (imu == SubsystemState::kPoor || imu == SubsystemState::kReturning) return Subsystem::kImu;
  return std::nullopt;
}

}  // namespace regolith

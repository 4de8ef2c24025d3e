// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/revisits.h"

#include <cmath>
#include <optional>

namespace regolith {
namespace {

constexpr double kRevisitGap = 20.0;  // m of track between a place and its revisit

}  // namespace

std::vector<Revisit> FindRevisits(Span<const PlanarPose> path, double interval) {
  // Places about 0.5 m apart, with the way driven until each.
  struct Place {
    size_t index;
    double driven;
  };
  std::vector<Place> places;
  double driven = 0.0;
  for (size_t i = 0; i < path.size(); ++i) {
    if (i > 0) driven += (path[i].position - path[i - 1].position).norm();
    if (places.empty() || driven - places.back().driven >= 0.5) places.push_back({i, driven});
  }
  std::vector<Revisit> revisits;
  std::optional<Revisit> open;
  const auto close = [&] {
    if (open && open->length >= kRevisitLength) revisits.push_back(*open);
    open.reset();
  };
  double open_from = 0.0;
  for (const Place& place : places) {
    const PlanarPose& pose = path[place.index];
    double nearest = kRevisitReach;
    double facing = 0.0;
    for (const Place& old : places) {
      if (place.driven - old.driven < kRevisitGap) break;
      const double distance = (path[old.index].position - pose.position).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      facing = std::cos(path[old.index].yaw - pose.yaw);
    }
    const bool near = nearest < kRevisitReach && std::abs(facing) > 0.5;
    if (!near || (open && open->same_direction != (facing > 0.0))) close();
    if (!near) continue;
    const double time = static_cast<double>(place.index) * interval;
    if (!open) {
      open = Revisit{time, time, 0.0, facing > 0.0};
      open_from = place.driven;
    }
    open->end = time;
    open->length = place.driven - open_from;
  }
  close();
  return revisits;
}

}  // namespace regolith

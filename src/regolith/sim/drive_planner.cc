// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/drive_planner.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/random.h"
#include "regolith/sim/drive_map.h"
#include "regolith/sim/drive_timing.h"
#include "regolith/sim/leg_search.h"
#include "regolith/sim/route_layout.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/suspension.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr int kCandidates = 60;                // places looked at
constexpr int kTries = 8;                      // places planned at
constexpr int kRepairs = 6;                    // new searches for a leg whose check fails
constexpr double kReserve = 0.5 * kDegree;     // below max_slope: what a check allows
constexpr double kMapReserve = 1.5 * kDegree;  // below max_slope: what the search allows
constexpr double kCorridor = 5.0;              // m
constexpr double kRetraceCorridor = 1.5;       // m: within kRevisitReach of the old track
constexpr double kCheckStep = 0.15;            // m
constexpr double kNominalStep = 0.5;           // m
constexpr double kRevisitGap = 20.0;           // m of track between a place and its revisit
constexpr double kKnownMargin = 3.0;           // m
constexpr double kWidestFirstTurn = 10.0 * kDegree;

struct Placement {
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  double yaw = 0.0;
  bool mirrored = false;
  double score = 0.0;  // the lower, the better

  Eigen::Vector2d operator()(Eigen::Vector2d point) const {
    if (mirrored) point.y() = -point.y();
    return offset + Eigen::Rotation2Dd(yaw) * point;
  }
};

// A route that was found: legs, and what its check measured.
struct Route {
  std::vector<LegCurve> legs;
  double steepest = 0.0;
};

struct Check {
  double steepest = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  bool stands = true;
};

class Planner {
 public:
  Planner(const Surface& surface, const DriveOptions& options, const RoverOptions& rover,
          uint64_t seed)
      : surface_(surface),
        options_(options),
        rover_(rover),
        suspension_(surface, rover),
        map_(surface, std::max(options.max_slope_deg * kDegree - kMapReserve, 0.01)),
        nominal_(LayRoute(options, seed)),
        random_(seed, "placement") {}

  Route Find();
  double SteepestOf(const std::vector<PlanarPose>& path, Eigen::Vector2d* place);
  std::vector<Eigen::Vector2d> Cleared(const Route& route);

 private:
  bool placed_by_user() const {
    return options_.route == "waypoints" && options_.waypoint_frame == "map";
  }
  double allowed() const { return options_.max_slope_deg * kDegree - kReserve; }
  std::vector<Placement> Placements();
  std::optional<double> Score(const Placement& placement) const;
  std::optional<Route> Plan(const Placement& placement);
  std::optional<std::vector<Eigen::Vector2d>> PlanLeg(LegRequest request);
  Eigen::Vector2d Target(const Eigen::Vector2d& wanted);
  void Measure(const Eigen::Vector2d& position, double yaw, Check* check);

  const Surface& surface_;
  const DriveOptions& options_;
  const RoverOptions& rover_;
  Suspension suspension_;
  DriveMap map_;
  std::vector<NominalLeg> nominal_;
  Random random_;
};

// Shares of the nominal route that are steep: much too steep is bad, some slope is wanted.
std::optional<double> Planner::Score(const Placement& placement) const {
  int points = 0;
  int closed = 0;
  int wanted = 0;
  for (const NominalLeg& leg : nominal_) {
    for (const Eigen::Vector2d& point : leg.Points(1.0)) {
      const Eigen::Vector2d p = placement(point);
      if (!surface_.Known(p.x(), p.y(), kKnownMargin + 1.0)) return std::nullopt;
      const auto height = [&](double dx, double dy) {
        return surface_.Height(p.x() + dx, p.y() + dy, 0.25);
      };
      const double slope = std::atan(
          std::hypot(height(0.5, 0.0) - height(-0.5, 0.0), height(0.0, 0.5) - height(0.0, -0.5)));
      ++points;
      if (slope > allowed()) ++closed;
      if (slope > 0.9 * options_.wanted_slope_deg * kDegree && slope <= allowed()) ++wanted;
    }
  }
  const double share = static_cast<double>(closed) / points;
  return share - std::min(static_cast<double>(wanted) / points, 0.1);
}

std::vector<Placement> Planner::Placements() {
  if (placed_by_user()) return {Placement{}};
  const Eigen::AlignedBox2d box = surface_.box();
  std::vector<Placement> found;
  for (int i = 0; i < kCandidates; ++i) {
    Placement placement;
    placement.yaw = random_.Uniform(-kWidestFirstTurn, kWidestFirstTurn);
    placement.mirrored = options_.route != "waypoints" && random_.Uniform() < 0.5;
    if (options_.route == "waypoints") placement.yaw = 0.0;
    Eigen::AlignedBox2d extent;
    for (const NominalLeg& leg : nominal_) {
      extent.extend(placement(leg.from)).extend(placement(leg.to));
    }
    const Eigen::Vector2d room = box.sizes() - extent.sizes();
    const double x = random_.Uniform();
    const double y = random_.Uniform();
    if (room.minCoeff() <= 0.0) continue;
    placement.offset = box.min() - extent.min() + Eigen::Vector2d(x * room.x(), y * room.y());
    const std::optional<double> score = Score(placement);
    if (!score) continue;
    placement.score = *score;
    found.push_back(placement);
  }
  if (found.empty()) {
    throw InputError("drive.length",
                     Concatenate("a route of ", options_.length,
                                 " m fits nowhere on known ground; use a shorter route or a "
                                 "larger elevation model"));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Placement& a, const Placement& b) { return a.score < b.score; });
  return found;
}

void Planner::Measure(const Eigen::Vector2d& position, double yaw, Check* check) {
  const Stance stance = suspension_.At(position, yaw);
  if (stance.travel > rover_.rocker_travel) check->stands = false;
  const double slope = std::max(stance.Tilt(), suspension_.SlopeAhead(position, yaw));
  if (slope <= check->steepest && check->stands) return;
  check->steepest = std::max(slope, check->steepest);
  check->place = position;
}

// A place near the wanted one where the rover can turn: level enough, no rocks round the wheels.
Eigen::Vector2d Planner::Target(const Eigen::Vector2d& wanted) {
  Eigen::Vector2d best = wanted;
  double least = 1e9;
  for (int ring = 0; ring <= 8; ++ring) {
    const int spokes = ring == 0 ? 1 : 8;
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const double angle = 2.0 * M_PI * spoke / spokes;
      const Eigen::Vector2d place =
          wanted + 0.3 * ring * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (map_.Steepness(place) > 0.85) continue;
      const int hits = map_.TurnHits(place);
      const double cost = 2.0 * hits + 0.3 * ring;
      if (hits < 0 || cost >= least) continue;
      least = cost;
      best = place;
    }
    if (least < 2.0) break;
  }
  return best;
}

std::optional<std::vector<Eigen::Vector2d>> Planner::PlanLeg(LegRequest request) {
  const Eigen::Vector2d wanted = request.nominal.back();
  for (int repair = 0; repair <= kRepairs; ++repair) {
    request.nominal.back() = Target(wanted);
    auto points = FindLeg(request, &map_);
    if (!points) return std::nullopt;
    const LegCurve curve(*points);
    Check check;
    for (double s = 0.0; s < curve.length() && check.stands; s += kCheckStep) {
      const LegCurve::Sample sample = curve.At(s);
      Measure(sample.position, sample.yaw, &check);
    }
    // Turns on the spot at the end.
    for (int i = 0; i < 8 && check.stands; ++i) {
      Measure(points->back(), 0.25 * M_PI * i, &check);
    }
    if (check.stands && check.steepest <= allowed()) return points;
    if ((check.place - request.start).norm() < 1.0) return std::nullopt;
    map_.Block(check.place, 0.5);
  }
  return std::nullopt;
}

std::optional<Route> Planner::Plan(const Placement& placement) {
  std::vector<std::vector<Eigen::Vector2d>> tracks;
  Route route;
  Eigen::Vector2d place = Target(placement(nominal_.front().from));
  double yaw = 0.0;
  for (size_t i = 0; i < nominal_.size(); ++i) {
    const NominalLeg& leg = nominal_[i];
    LegRequest request;
    request.start = place;
    request.arrival_yaw = yaw;
    request.curvature = options_.curvature;
    request.corridor = kCorridor;
    if (leg.retraces >= 0) {
      request.nominal = tracks[static_cast<size_t>(leg.retraces)];
      if (leg.reversed) std::reverse(request.nominal.begin(), request.nominal.end());
      request.corridor = kRetraceCorridor + (place - request.nominal.front()).norm();
    } else {
      for (const Eigen::Vector2d& point : leg.Points(kNominalStep)) {
        request.nominal.push_back(placement(point));
      }
    }
    const Eigen::Vector2d first =
        request.nominal[std::min<size_t>(4, request.nominal.size() - 1)] - request.nominal[0];
    const double heading = std::atan2(first.y(), first.x());
    request.turn = std::remainder(heading - yaw, 2.0 * M_PI);
    if (i == 0) request.turn = 0.0;
    auto points = PlanLeg(request);
    if (!points) return std::nullopt;
    route.legs.emplace_back(*points);
    place = points->back();
    yaw = route.legs.back().At(route.legs.back().length()).yaw;
    tracks.push_back(std::move(*points));
  }
  for (const LegCurve& leg : route.legs) {
    Check check;
    for (double s = 0.0; s < leg.length(); s += kCheckStep) {
      Measure(leg.At(s).position, leg.At(s).yaw, &check);
    }
    route.steepest = std::max(route.steepest, check.steepest);
  }
  return route;
}

Route Planner::Find() {
  std::optional<Route> best;
  int tries = 0;
  for (const Placement& placement : Placements()) {
    if (tries++ == kTries) break;
    std::optional<Route> route = Plan(placement);
    if (!route) continue;
    if (!best || route->steepest > best->steepest) best = std::move(route);
    if (best->steepest >= options_.wanted_slope_deg * kDegree) break;
  }
  if (best) return *best;
  throw InputError(
      "drive.max_slope_deg",
      Concatenate("no route below ", options_.max_slope_deg,
                  " degrees of slope was found; choose another --seed, gentler relief, a shorter "
                  "drive.length or a flatter crop, or move the waypoints"));
}

double Planner::SteepestOf(const std::vector<PlanarPose>& path, Eigen::Vector2d* place) {
  Check check;
  for (size_t i = 0; i < path.size(); ++i) {
    const bool same =
        i > 0 && path[i].position == path[i - 1].position && path[i].yaw == path[i - 1].yaw;
    if (!same && (i % 2 == 0)) Measure(path[i].position, path[i].yaw, &check);
  }
  *place = check.place;
  return check.steepest;
}

// Rocks on the wheels' tracks of all legs, and round the places where the rover turns.
std::vector<Eigen::Vector2d> Planner::Cleared(const Route& route) {
  std::vector<Eigen::Vector2d> cleared;
  const auto add = [&cleared](const Rock& rock) {
    if (std::find(cleared.begin(), cleared.end(), rock.centre) == cleared.end()) {
      cleared.push_back(rock.centre);
    }
  };
  const double wheels = std::hypot(kHalfWheelbase, kHalfTrack);
  for (const LegCurve& leg : route.legs) {
    for (double s = 0.0; s < leg.length(); s += 0.05) {
      const LegCurve::Sample sample = leg.At(s);
      const Eigen::Vector2d ahead(std::cos(sample.yaw), std::sin(sample.yaw));
      for (const Rock& rock : map_.RocksNear(sample.position)) {
        const Eigen::Vector2d offset = rock.centre - sample.position;
        const double along = std::abs(std::abs(offset.dot(ahead)) - kHalfWheelbase);
        const double aside = ahead.x() * offset.y() - ahead.y() * offset.x();
        if (along < rover_.wheel_radius && OnWheelTrack(aside, rock.diameter)) add(rock);
      }
    }
    for (const double s : {0.0, leg.length()}) {
      const Eigen::Vector2d place = leg.At(s).position;
      for (const Rock& rock : map_.RocksNear(place)) {
        const double distance = (rock.centre - place).norm();
        if (std::abs(distance - wheels) < kHalfWheelWidth + 0.5 * rock.diameter) add(rock);
      }
    }
  }
  return cleared;
}

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

Drive PlanDrive(const Surface& surface, const DriveOptions& options, const RoverOptions& rover,
                uint64_t seed, double duration, double interval) {
  Planner planner(surface, options, rover, seed);
  const Route route = planner.Find();
  Drive drive;
  drive.path = TimeDrive(options, seed, route.legs, duration, interval);
  for (size_t i = 1; i < drive.path.size(); ++i) {
    drive.length += (drive.path[i].position - drive.path[i - 1].position).norm();
  }
  drive.steepest = planner.SteepestOf(drive.path, &drive.steepest_place);
  drive.revisits = FindRevisits(drive.path, interval);
  drive.cleared = planner.Cleared(route);
  return drive;
}

}  // namespace regolith

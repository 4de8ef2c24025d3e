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
#include "regolith/sim/revisits.h"
#include "regolith/sim/route_layout.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/suspension.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr int kCandidates = 60;                // places looked at
constexpr int kTries = 12;                     // of them, planned at
constexpr int kRounds = 12;                    // of looking at places, while none has a route
constexpr int kRoutes = 3;                     // routes found, of which the best is taken
constexpr int kRepairs = 6;                    // new searches for a leg whose check fails
constexpr int kWidenings = 2;                  // rounds of them, each farther from the nominal leg
constexpr int kTurnYaws = 16;                  // checked where the rover turns
constexpr double kReserve = 0.5 * kDegree;     // below max_slope: what a check allows
constexpr double kMapReserve = 1.5 * kDegree;  // below max_slope: what the search allows
constexpr double kCorridor = 5.0;              // m
constexpr double kRetraceCorridor = 1.5;       // m: within kRevisitReach of the old track
constexpr double kTargetReach = 2.4;           // m from the nominal end of a leg to the real one
constexpr double kCheckStep = 0.05;            // m
constexpr double kNominalStep = 0.5;           // m
constexpr double kKnownMargin = 3.0;           // m
constexpr double kWidestFirstTurn = 10.0 * kDegree;
constexpr double kLeastPace = 0.97;      // of the nominal route's: slower is not wanted
constexpr double kGoodEnough = 1.5;      // of badness
constexpr double kMostDetour = 1.3;      // length of a leg, relative to the nominal one
constexpr double kRevisitReserve = 1.0;  // m
constexpr double kMostCleared = 0.02;    // rocks a metre that need not be avoided

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

// A route that was found: legs, and what their checks measured.
struct Route {
  std::vector<LegCurve> legs;
  double steepest = 0.0;
  double badness = 0.0;  // how far it is from what is wanted
};

struct Check {
  double steepest = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  bool stands = true;
};

struct CheckedLeg {
  std::vector<Eigen::Vector2d> points;
  double steepest = 0.0;
};

// The points of a nominal leg, placed, and bent so that they begin at `start`.
std::vector<Eigen::Vector2d> Led(std::vector<Eigen::Vector2d> points, const Placement& placement,
                                 const Eigen::Vector2d& start) {
  const Eigen::Vector2d moved = start - placement(points.front());
  for (size_t i = 0; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    points[i] = placement(points[i]) + (1.0 - share) * moved;
  }
  return points;
}

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
  std::optional<Route> BestAmong(const std::vector<Placement>& placements);
  double SteepestOf(const std::vector<PlanarPose>& path, Eigen::Vector2d* place);
  std::vector<Eigen::Vector2d> Cleared(const Route& route);

 private:
  bool placed_by_user() const {
    return options_.route == "waypoints" && options_.waypoint_frame == "map";
  }
  double allowed() const { return options_.max_slope_deg * kDegree - kReserve; }
  std::vector<Placement> Placements();
  void CheckWaypointsAreKnown() const;
  std::optional<double> Score(const Placement& placement) const;
  std::optional<Route> Plan(const Placement& placement);
  std::optional<Eigen::Vector2d> Start(const Placement& placement);
  std::optional<CheckedLeg> PlanLeg(const LegRequest& request);
  std::optional<CheckedLeg> Repaired(LegRequest request, double target_reach);
  Eigen::Vector2d Target(const Eigen::Vector2d& wanted, double reach);
  void Measure(const Eigen::Vector2d& position, double yaw, Check* check);
  void MeasureTurn(const Eigen::Vector2d& position, Check* check);
  bool Passes(const Check& check);
  [[noreturn]] void ReportFailure() const;
  double Pace(const Route& route) const;
  double Badness(const Route& route);

  const Surface& surface_;
  const DriveOptions& options_;
  const RoverOptions& rover_;
  Suspension suspension_;
  DriveMap map_;
  std::vector<NominalLeg> nominal_;
  Random random_;
  int unstable_ = 0;  // checks that failed since a wheel could not reach the ground
  int steep_ = 0;     // since body or ground were too steep
};

bool Planner::Passes(const Check& check) {
  if (check.stands && check.steepest <= allowed()) return true;
  ++(check.stands ? steep_ : unstable_);
  return false;
}

void Planner::ReportFailure() const {
  if (unstable_ > steep_) {
    throw InputError("rover.rocker_travel",
                     Concatenate(rover_.rocker_travel,
                                 " m is too little for the ground: no route was found on which all "
                                 "wheels touch it; allow more, or choose gentler relief"));
  }
  throw InputError(
      "drive.max_slope_deg",
      Concatenate(
          "no route was found below ", options_.max_slope_deg,
          " degrees of slope and clear of rocks too tall for the rover; choose another "
          "--seed, gentler relief, fewer rocks (terrain.rocks), a shorter drive.length or a "
          "flatter crop, or move the waypoints"));
}

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

void Planner::CheckWaypointsAreKnown() const {
  for (const NominalLeg& leg : nominal_) {
    for (const Eigen::Vector2d& place : {leg.from, leg.to}) {
      if (surface_.Known(place.x(), place.y(), kKnownMargin)) continue;
      throw InputError("drive.waypoints",
                       Concatenate("(", place.x(), ", ", place.y(),
                                   ") lies beyond the terrain or in one of its holes; expected "
                                   "places of the map, m from its middle"));
    }
  }
}

std::vector<Placement> Planner::Placements() {
  if (placed_by_user()) {
    CheckWaypointsAreKnown();
    return {Placement{}};
  }
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
  if (found.empty() && options_.route == "waypoints") {
    throw InputError("drive.waypoints",
                     "fit nowhere on known ground; use nearer ones or a larger elevation model");
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

void Planner::MeasureTurn(const Eigen::Vector2d& position, Check* check) {
  for (int i = 0; i < kTurnYaws && check->stands; ++i) {
    Measure(position, 2.0 * M_PI * i / kTurnYaws, check);
  }
}

// A place near the wanted one where the rover can turn: level enough, no rocks round the wheels.
Eigen::Vector2d Planner::Target(const Eigen::Vector2d& wanted, double reach) {
  constexpr int kRings = 8;
  Eigen::Vector2d best = wanted;
  double least = 1e9;
  for (int ring = 0; ring <= kRings; ++ring) {
    const int spokes = ring == 0 ? 1 : 8;
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const double angle = 2.0 * M_PI * spoke / spokes;
      const Eigen::Vector2d place =
          wanted + reach * ring / kRings * Eigen::Vector2d(std::cos(angle), std::sin(angle));
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

// Searches, checks what was found, closes the places where the check fails, and searches again.
std::optional<CheckedLeg> Planner::Repaired(LegRequest request, double target_reach) {
  const std::vector<Eigen::Vector2d> nominal = request.nominal;
  for (int repair = 0; repair <= kRepairs; ++repair) {
    // The whole leg leads to where its end was moved.
    const Eigen::Vector2d moved = Target(nominal.back(), target_reach) - nominal.back();
    for (size_t i = 0; i < nominal.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(nominal.size() - 1);
      request.nominal[i] = nominal[i] + share * share * moved;
    }
    auto points = FindLeg(request, &map_);
    if (!points) return std::nullopt;
    const LegCurve curve(*points);
    Check check;
    for (double s = 0.0; s < curve.length() && check.stands; s += kCheckStep) {
      const LegCurve::Sample sample = curve.At(s);
      Measure(sample.position, sample.yaw, &check);
    }
    MeasureTurn(points->back(), &check);
    if (Passes(check)) return CheckedLeg{*points, check.steepest};
    if ((check.place - request.start).norm() < 1.0) return std::nullopt;
    map_.Block(check.place, 0.5);
  }
  return std::nullopt;
}

std::optional<CheckedLeg> Planner::PlanLeg(const LegRequest& request) {
  for (int round = 0; round < kWidenings; ++round) {
    LegRequest wider = request;
    if (request.corridor >= kCorridor) wider.corridor *= 1.0 + 0.5 * round;
    auto leg = Repaired(wider, kTargetReach * (1 + round));
    if (leg) return leg;
  }
  return std::nullopt;
}

std::optional<Eigen::Vector2d> Planner::Start(const Placement& placement) {
  const Eigen::Vector2d wanted = placement(nominal_.front().from);
  for (int repair = 0; repair <= kRepairs; ++repair) {
    const Eigen::Vector2d place = Target(wanted, kTargetReach);
    Check check;
    MeasureTurn(place, &check);
    if (Passes(check)) return place;
    map_.Block(place, 0.5);
  }
  return std::nullopt;
}

std::optional<Route> Planner::Plan(const Placement& placement) {
  std::vector<CheckedLeg> found;
  Route route;
  const std::optional<Eigen::Vector2d> start = Start(placement);
  if (!start) return std::nullopt;
  Eigen::Vector2d place = *start;
  double yaw = 0.0;
  for (const NominalLeg& leg : nominal_) {
    LegRequest request;
    request.start = place;
    request.arrival_yaw = yaw;
    request.curvature = options_.curvature;
    if (leg.retraces >= 0) {
      request.nominal = found[static_cast<size_t>(leg.retraces)].points;
      if (leg.reversed) std::reverse(request.nominal.begin(), request.nominal.end());
      request.corridor = kRetraceCorridor + (place - request.nominal.front()).norm();
    } else {
      request.nominal = Led(leg.Points(kNominalStep), placement, place);
      request.corridor = kCorridor;
    }
    const Eigen::Vector2d first =
        request.nominal[std::min<size_t>(4, request.nominal.size() - 1)] - request.nominal[0];
    const double heading = std::atan2(first.y(), first.x());
    request.turn = found.empty() ? 0.0 : std::remainder(heading - yaw, 2.0 * M_PI);
    auto checked = PlanLeg(request);
    if (!checked) return std::nullopt;
    route.steepest = std::max(route.steepest, checked->steepest);
    route.legs.emplace_back(checked->points);
    place = checked->points.back();
    yaw = route.legs.back().At(route.legs.back().length()).yaw;
    found.push_back(*std::move(checked));
  }
  route.badness = Badness(route);
  return route;
}

// The mean speed up to the end of each leg but the first, relative to the nominal route's; the
// lowest. Turns that are wider than planned cost it.
double Planner::Pace(const Route& route) const {
  double pace = 1.0;
  double yaw = 0.0;
  double nominal_yaw = 0.0;
  double length = 0.0;
  double nominal_length = 0.0;
  double time = options_.rest;
  double nominal_time = options_.rest;
  for (size_t i = 0; i < route.legs.size(); ++i) {
    const LegCurve& leg = route.legs[i];
    const NominalLeg& nominal = nominal_[i];
    const Eigen::Vector2d chord = nominal.to - nominal.from;
    const double chord_yaw = std::atan2(chord.y(), chord.x());
    const auto turn = [&](double from, double to) {
      return TurnDuration(options_, std::remainder(to - from, 2.0 * M_PI)) + 2.0 * options_.stop;
    };
    time += turn(yaw, leg.At(0.0).yaw) + LegDuration(options_, leg.length());
    nominal_time +=
        turn(nominal_yaw, chord_yaw - 0.5 * nominal.bend) + LegDuration(options_, chord.norm());
    length += leg.length();
    nominal_length += chord.norm();
    if (i > 0) pace = std::min(pace, (length / time) / (nominal_length / nominal_time));
    yaw = leg.At(leg.length()).yaw;
    nominal_yaw = chord_yaw + 0.5 * nominal.bend;
  }
  return pace;
}

// In units of a degree of slope that is missing: 0 for a route that has all that is wanted.
double Planner::Badness(const Route& route) {
  double length = 0.0;
  double detours = 0.0;
  std::vector<PlanarPose> poses;
  for (size_t i = 0; i < route.legs.size(); ++i) {
    const LegCurve& leg = route.legs[i];
    const double nominal = (nominal_[i].to - nominal_[i].from).norm();
    length += leg.length();
    detours += std::max(0.0, leg.length() / nominal - kMostDetour);
    for (double s = 0.0; s < leg.length(); s += 0.25) {
      const LegCurve::Sample sample = leg.At(s);
      poses.push_back({sample.position, sample.yaw, 0.0});
    }
  }
  const std::vector<Revisit> revisits = FindRevisits(poses, 1.0);
  const auto kept = std::count_if(revisits.begin(), revisits.end(), [](const Revisit& revisit) {
    return revisit.length > kRevisitLength + kRevisitReserve;
  });
  const auto wanted = std::count_if(nominal_.begin(), nominal_.end(),
                                    [](const NominalLeg& leg) { return leg.retraces >= 0; });
  const auto cleared = static_cast<double>(Cleared(route).size());
  return std::max(0.0, options_.wanted_slope_deg - route.steepest / kDegree) +
         200.0 * std::max(0.0, kLeastPace - Pace(route)) + 10.0 * detours +
         5.0 * static_cast<double>(std::max<int64_t>(0, wanted - kept)) +
         0.3 * std::max(0.0, std::floor(cleared - kMostCleared * length));
}

std::optional<Route> Planner::BestAmong(const std::vector<Placement>& placements) {
  std::optional<Route> best;
  int tries = 0;
  int routes = 0;
  for (const Placement& placement : placements) {
    if (tries++ == kTries || routes == kRoutes) break;
    std::optional<Route> route = Plan(placement);
    if (!route) continue;
    ++routes;
    if (!best || route->badness < best->badness) best = std::move(route);
    if (best->badness <= kGoodEnough) break;
  }
  return best;
}

Route Planner::Find() {
  const int rounds = placed_by_user() ? 1 : kRounds;
  for (int round = 0; round < rounds; ++round) {
    const std::optional<Route> best = BestAmong(Placements());
    if (best) return *best;
  }
  ReportFailure();
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

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/route_layout.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kRoom = 25.0;  // m around a route, to place it in
// Shares of a route of loops: the first lap, the second; the rest leads away.
constexpr double kFirstLap = 0.28;
constexpr double kSecondLap = 0.21;
constexpr double kLeaving = 45.0 * kDegree;  // by which the way out turns off the old track

Eigen::Vector2d Direction(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }

// Appends a leg of `length` whose chord points to `yaw`.
void Append(double yaw, double length, double bend, std::vector<NominalLeg>* legs) {
  NominalLeg leg;
  if (!legs->empty()) leg.from = legs->back().to;
  leg.to = leg.from + length * Direction(yaw);
  leg.bend = bend;
  legs->push_back(leg);
}

void Retrace(int index, bool reversed, std::vector<NominalLeg>* legs) {
  const NominalLeg old = (*legs)[static_cast<size_t>(index)];
  NominalLeg leg;
  leg.from = legs->back().to;
  leg.to = reversed ? old.from : old.to;
  leg.bend = reversed ? -old.bend : old.bend;
  leg.retraces = index;
  leg.reversed = reversed;
  legs->push_back(leg);
}

// Legs ahead that bend a little to alternating sides; a point turn of about turn_deg between them,
// to the side that leads back to the general heading.
void AppendWander(const DriveOptions& options, double heading, int count, Random* random,
                  std::vector<NominalLeg>* legs) {
  const double length = LegLength(options);
  const double most_bend = std::min(0.5 * options.curvature * length, 25.0 * kDegree);
  double side = random->Uniform() < 0.5 ? -1.0 : 1.0;
  double tangent = heading;
  for (int i = 0; i < count; ++i) {
    const double bend = side * most_bend * random->Uniform(0.3, 1.0);
    Append(tangent + 0.5 * bend, length, bend, legs);
    tangent += bend;
    const double off = std::remainder(tangent - heading, 2.0 * M_PI);
    const double turn_side = std::abs(off) > 0.05 ? (off > 0.0 ? -1.0 : 1.0) : -side;
    tangent += turn_side * options.turn_deg * kDegree * random->Uniform(0.85, 1.1);
    side = random->Uniform() < 0.5 ? -1.0 : 1.0;
  }
}

// A lap round a polygon; its first side again; a second polygon that shares this side, outside the
// first, back to the start; the first lap's last side, facing the other way; and away.
std::vector<NominalLeg> LayLoops(const DriveOptions& options, Random* random) {
  const double length = LegLength(options);
  const int total = static_cast<int>(std::ceil(options.length / length));
  const int first = std::max(4, static_cast<int>(std::lround(kFirstLap * options.length / length)));
  const int second =
      std::max(3, static_cast<int>(std::lround(kSecondLap * options.length / length)));
  std::vector<NominalLeg> legs;
  // The legs' bends take a part of each corner, point turns the rest.
  const double corner = 2.0 * M_PI / first;
  const double start = corner * 0.25;
  for (int i = 0; i < first; ++i) {
    Append(start + i * corner, length, corner * random->Uniform(0.35, 0.65), &legs);
  }
  legs.back().to = Eigen::Vector2d::Zero();
  Retrace(0, false, &legs);
  const double right = 2.0 * M_PI / (second + 1);
  for (int i = 1; i <= second; ++i) {
    Append(start - i * right, length, -right * random->Uniform(0.35, 0.65), &legs);
  }
  legs.back().to = Eigen::Vector2d::Zero();
  Retrace(first - 1, true, &legs);
  const double heading = start + (first - 1) * corner + M_PI + kLeaving;
  AppendWander(options, heading, std::max(1, total - first - second - 2), random, &legs);
  return legs;
}

std::vector<NominalLeg> LayWaypoints(const DriveOptions& options) {
  std::vector<NominalLeg> legs;
  const std::vector<double>& list = options.waypoints;
  const bool map = options.waypoint_frame == "map";
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  for (size_t i = 0; i + 1 < list.size(); i += 2) {
    const Eigen::Vector2d next(list[i], list[i + 1]);
    const double distance = (next - last).norm();
    if (i > 0 || !map) {
      const int pieces = std::max(1, static_cast<int>(std::ceil(distance / LegLength(options))));
      for (int k = 0; k < pieces; ++k) {
        NominalLeg leg;
        leg.from = last + (next - last) * k / pieces;
        leg.to = last + (next - last) * (k + 1) / pieces;
        legs.push_back(leg);
      }
    }
    last = next;
  }
  return legs;
}

}  // namespace

std::vector<Eigen::Vector2d> NominalLeg::Points(double spacing) const {
  const Eigen::Vector2d chord = to - from;
  const int count = std::max(2, static_cast<int>(std::ceil(chord.norm() / spacing)));
  const Eigen::Vector2d right(chord.y(), -chord.x());
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    // The parabola with the arc's bend: a left bend bulges to the right.
    const double bulge = std::tan(0.5 * bend) * share * (1.0 - share);
    points.emplace_back(from + share * chord + bulge * right);
  }
  return points;
}

double LegLength(const DriveOptions& options) {
  return kMeanOfNominal * options.speed * (options.leg_duration - kRamp);
}

std::vector<NominalLeg> LayRoute(const DriveOptions& options, uint64_t seed) {
  Random random(seed, "route");
  if (options.route == "waypoints") return LayWaypoints(options);
  if (options.route == "loops") return LayLoops(options, &random);
  std::vector<NominalLeg> legs;
  const int count = static_cast<int>(std::ceil(options.length / LegLength(options)));
  AppendWander(options, 0.0, std::max(count, 1), &random, &legs);
  return legs;
}

Eigen::AlignedBox2d DriveBox(const DriveOptions& options, uint64_t seed) {
  Eigen::AlignedBox2d box;
  for (const NominalLeg& leg : LayRoute(options, seed)) {
    for (const Eigen::Vector2d& point : leg.Points(2.0)) box.extend(point);
  }
  const Eigen::Vector2d room = Eigen::Vector2d::Constant(kRoom);
  if (options.route == "waypoints" && options.waypoint_frame == "map") {
    return {box.min() - room, box.max() + room};
  }
  // The route may be turned and mirrored.
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * box.diagonal().norm()) + room;
  return {-half, half};
}

}  // namespace regolith

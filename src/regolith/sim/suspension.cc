// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/suspension.h"

#include <algorithm>
#include <cmath>

#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

// A wheel does not fall into what is narrower than itself.
constexpr double kWheelFootprint = 0.1;  // m between the posts that it feels
constexpr double kSmallestBump = 0.04;   // m, of a rock that moves the body
constexpr double kTile = 4.0;            // m
constexpr int kEnvelopeSteps = 2;        // on either side of a wheel's middle
constexpr double kEnvelopeReach = 0.7;   // of the radius: steeper contact means an obstacle

constexpr int kRockStepsAlong = 3;  // on either side of a rock's middle
constexpr int kRockStepsAside = 2;  // likewise, over the width of the wheel
constexpr double kBelowAll = -1e9;  // m

// How far a wheel of this radius has come down at `u` m from its middle.
double Drop(double radius, double u) { return radius - std::sqrt(radius * radius - u * u); }

}  // namespace

double Stance::Tilt() const { return std::acos(std::cos(pitch) * std::cos(roll)); }

Eigen::Quaterniond FromYawPitchRoll(double yaw, double pitch, double roll) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

const std::vector<Rock>& Suspension::RocksAround(const Eigen::Vector2d& place) {
  const auto column = static_cast<int64_t>(std::floor(place.x() / kTile));
  const auto row = static_cast<int64_t>(std::floor(place.y() / kTile));
  const auto [entry, fresh] = rocks_.try_emplace((column << 32) ^ (row & 0xffffffff));
  if (fresh) {
    const Eigen::Vector2d low(kTile * static_cast<double>(column),
                              kTile * static_cast<double>(row));
    const Eigen::Vector2d reach =
        Eigen::Vector2d::Constant(options_.wheel_radius + tops_.reach() * kObstacle);
    const Eigen::Vector2d high = low + Eigen::Vector2d::Constant(kTile);
    for (const Rock& rock : surface_.Rocks({low - reach, high + reach}, kSmallestBump)) {
      if (rock.diameter < kObstacle) entry->second.push_back(rock);
    }
  }
  return entry->second;
}

double Suspension::ContactWithRock(const Rock& rock, const Eigen::Vector2d& wheel,
                                   const Eigen::Vector2d& ahead) const {
  const double radius = options_.wheel_radius;
  const double reach = tops_.reach() * rock.diameter;
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const Eigen::Vector2d offset = rock.centre - wheel;
  const double along = offset.dot(ahead);
  const double aside = offset.dot(left);
  // The part of the wheel's width that is over the rock.
  const double right_edge = std::max(aside - reach, -kHalfWheelWidth);
  const double left_edge = std::min(aside + reach, kHalfWheelWidth);
  if (right_edge >= left_edge) return kBelowAll;
  double highest = kBelowAll;
  for (int i = -kRockStepsAlong; i <= kRockStepsAlong; ++i) {
    const double u = along + reach * i / (kRockStepsAlong + 1);
    if (std::abs(u) >= radius) continue;
    for (int j = -kRockStepsAside; j <= kRockStepsAside; ++j) {
      const double share = 0.5 + 0.5 * j / (kRockStepsAside + 0.5);
      const double v = right_edge + share * (left_edge - right_edge);
      const Eigen::Vector2d place = wheel + u * ahead + v * left;
      highest = std::max(highest, tops_.Top(rock, place.x(), place.y()) - Drop(radius, u));
    }
  }
  return highest;
}

// The hub of a wheel of radius r above h(u) is at max over u of h(u) + sqrt(r² - u²).
double Suspension::Contact(const Eigen::Vector2d& wheel, const Eigen::Vector2d& ahead) {
  const double radius = options_.wheel_radius;
  double highest = kBelowAll;
  for (int i = -kEnvelopeSteps; i <= kEnvelopeSteps; ++i) {
    const double u = kEnvelopeReach * radius * i / kEnvelopeSteps;
    const Eigen::Vector2d place = wheel + u * ahead;
    const double ground = surface_.Height(place.x(), place.y(), kWheelFootprint);
    highest = std::max(highest, ground - Drop(radius, u));
  }
  const double far = std::hypot(radius, kHalfWheelWidth) + tops_.reach() * kObstacle;
  for (const Rock& rock : RocksAround(wheel)) {
    if ((rock.centre - wheel).squaredNorm() > far * far) continue;
    highest = std::max(highest, ContactWithRock(rock, wheel, ahead));
  }
  return highest;
}

Suspension::Side Suspension::Rest(const Eigen::Vector2d& middle, const Eigen::Vector2d& ahead) {
  const double front = Contact(middle + kHalfWheelbase * ahead, ahead);
  const double back = Contact(middle - kHalfWheelbase * ahead, ahead);
  if (options_.wheels == 4) {
    return {0.5 * (front + back), 0.5 * (front - back) / kHalfWheelbase, 0.0};
  }
  // The bogie behind joins the middle and the back wheel; the rocker, its pivot and the front one.
  const double centre = Contact(middle, ahead);
  const double pivot = 0.5 * (centre + back);
  const double slope = (front - pivot) / (1.5 * kHalfWheelbase);
  return {pivot + 0.5 * kHalfWheelbase * slope, slope,
          std::abs(0.5 * (centre - back) - 0.5 * kHalfWheelbase * slope)};
}

Stance Suspension::At(const Eigen::Vector2d& position, double yaw) {
  const Eigen::Vector2d ahead(std::cos(yaw), std::sin(yaw));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const Side port = Rest(position + kHalfTrack * left, ahead);
  const Side starboard = Rest(position - kHalfTrack * left, ahead);
  Stance stance;
  stance.height = 0.5 * (port.height + starboard.height);
  stance.pitch = -std::atan(0.5 * (port.slope + starboard.slope));
  stance.roll = std::atan2(port.height - starboard.height, 2.0 * kHalfTrack);
  const double rocker = 0.5 * kHalfWheelbase * std::abs(port.slope - starboard.slope);
  stance.travel = rocker + std::max(port.travel, starboard.travel);
  return stance;
}

double Suspension::SlopeAhead(const Eigen::Vector2d& position, double yaw) const {
  const Eigen::Vector2d half = 0.5 * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
  const Eigen::Vector2d front = position + half;
  const Eigen::Vector2d back = position - half;
  return std::abs(std::atan(surface_.Height(front.x(), front.y(), kWheelFootprint) -
                            surface_.Height(back.x(), back.y(), kWheelFootprint)));
}

}  // namespace regolith

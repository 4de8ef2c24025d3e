// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/fill_light.h"

#include <array>
#include <cmath>

#include "regolith/sim/scene.h"

namespace regolith {
namespace {

constexpr int kPackets = 2;
constexpr int kDirections = kPackets * kPacketSize;
constexpr float kGoldenAngle = 2.3999632F;  // rad
constexpr float kLift = 0.3F;               // of the posts' spacing
// A ray stands for a cone: 2π sr · cosine over the number of rays.
constexpr float kConeWidth = 0.3F;  // rad
// Light that a lit rock sends on, as a share of level lit ground's: half of it is turned away.
constexpr float kRockShare = 0.5F;

// Spread over the hemisphere in proportion to the cosine; the same for all places, so that their
// means differ smoothly.
std::array<Eigen::Vector3f, kDirections> CosineDirections() {
  std::array<Eigen::Vector3f, kDirections> directions;
  for (size_t i = 0; i < kDirections; ++i) {
    const float sine_squared = (static_cast<float>(i) + 0.5F) / kDirections;
    const float sine = std::sqrt(sine_squared);
    const float angle = kGoldenAngle * static_cast<float>(i);
    directions[i] = {sine * std::cos(angle), sine * std::sin(angle),
                     std::sqrt(1.0F - sine_squared)};
  }
  return directions;
}

float Arriving(const Scene& scene, const Photometry& photometry, bool interreflection,
               const RayPacket& rays, int lane) {
  const Eigen::Vector3f direction = rays.Direction(lane);
  if (rays.object[lane] == kNothing) return photometry.SkyWithoutSun(direction);
  if (!interreflection) return 0.0F;
  if (scene.IsRock(rays.object[lane])) return kRockShare * photometry.LevelGround();
  const float width = kConeWidth * rays.distance[lane];
  SurfacePoint point = scene.Look(rays, lane, width, width);
  // One bounce: what fills that ground is being cast too, and the open sky stands for it.
  point.fill = photometry.OpenSky();
  return photometry.Ground(point, -direction);
}

}  // namespace

std::vector<float> CastFillLight(const Scene& scene, const Photometry& photometry,
                                 bool interreflection, const GroundTile& tile) {
  static const std::array<Eigen::Vector3f, kDirections> kRays = CosineDirections();
  constexpr float kFar = 1000.0F;  // m
  std::vector<float> fill;
  for (int row = 0; row < GroundTile::kPosts; row += GroundTile::kFillStep) {
    for (int column = 0; column < GroundTile::kPosts; column += GroundTile::kFillStep) {
      const Eigen::Vector3f place =
          tile.Post(column, row) + kLift * tile.spacing() * tile.Normal(column, row);
      float sum = 0.0F;
      for (size_t packet = 0; packet < kPackets; ++packet) {
        RayPacket rays;
        for (int lane = 0; lane < kPacketSize; ++lane) {
          rays.Set(lane, place, kRays[packet * kPacketSize + static_cast<size_t>(lane)], kFar);
        }
        scene.Intersect(&rays);
        for (int lane = 0; lane < kPacketSize; ++lane) {
          sum += Arriving(scene, photometry, interreflection, rays, lane);
        }
      }
      fill.push_back(sum / kDirections);
    }
  }
  return fill;
}

}  // namespace regolith

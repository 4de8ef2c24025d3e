// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/sunlight.h"

#include <algorithm>

namespace regolith {
namespace {

constexpr int kSunRays = 4;       // a place
constexpr float kFarAway = 2e4F;  // m
// Rays of light start above the post by this share of the posts' spacing, so that neither rounding
// nor a coarser neighbour's seam shades it.
constexpr float kShadowLift = 0.2F;

// 1 where the middle of the disc is seen, 0 where not.
std::vector<float> CastMiddle(const Scene& scene, const SunDisc& sun,
                              const std::vector<Eigen::Vector3f>& places) {
  std::vector<float> seen(places.size());
  RayPacket rays;
  for (size_t first = 0; first < places.size(); first += kPacketSize) {
    const auto count = static_cast<int>(std::min<size_t>(kPacketSize, places.size() - first));
    for (int lane = 0; lane < kPacketSize; ++lane) {
      rays.Off(lane);
      if (lane >= count) continue;
      rays.Set(lane, places[first + static_cast<size_t>(lane)], sun.direction, kFarAway);
    }
    scene.Occluded(&rays);
    for (int lane = 0; lane < count; ++lane) {
      seen[first + static_cast<size_t>(lane)] = rays.distance[lane] > 0.0F ? 1.0F : 0.0F;
    }
  }
  return seen;
}

bool AgreesWithNeighbours(const std::vector<float>& seen, int column, int row) {
  const auto at = [&](int i, int j) {
    return seen[static_cast<size_t>(std::clamp(j, 0, GroundTile::kPosts - 1) * GroundTile::kPosts +
                                    std::clamp(i, 0, GroundTile::kPosts - 1))];
  };
  const float here = at(column, row);
  for (int j = row - 1; j <= row + 1; ++j) {
    for (int i = column - 1; i <= column + 1; ++i) {
      if (at(i, j) != here) return false;
    }
  }
  return true;
}

}  // namespace

void CastSunlight(const Scene& scene, const SunDisc& sun, Span<const Eigen::Vector3f> places,
                  float* sunlit) {
  constexpr size_t kPlacesAtOnce = kPacketSize / kSunRays;
  if (sun.direction.z() <= 0.0F) {
    std::fill(sunlit, sunlit + places.size(), 0.0F);
    return;
  }
  const auto to_sun = SpreadOverDisc<kSunRays>(sun);
  RayPacket rays;
  for (size_t first = 0; first < places.size(); first += kPlacesAtOnce) {
    for (int lane = 0; lane < kPacketSize; ++lane) {
      const size_t place = first + static_cast<size_t>(lane / kSunRays);
      if (place < places.size()) {
        rays.Set(lane, places[place], to_sun[static_cast<size_t>(lane % kSunRays)], kFarAway);
      } else {
        rays.Off(lane);
      }
    }
    scene.Occluded(&rays);
    for (size_t i = 0; i < kPlacesAtOnce && first + i < places.size(); ++i) {
      const float* distances = rays.distance + i * kSunRays;
      const auto seen = std::count_if(distances, distances + kSunRays,
                                      [](float distance) { return distance > 0.0F; });
      sunlit[first + i] = static_cast<float>(seen) / kSunRays;
    }
  }
}

std::vector<float> CastSunlightOnTile(const Scene& scene, const SunDisc& sun,
                                      const GroundTile& tile) {
  constexpr int kPosts = GroundTile::kPosts;
  std::vector<Eigen::Vector3f> places;
  for (int row = 0; row < kPosts; ++row) {
    for (int column = 0; column < kPosts; ++column) {
      places.push_back(tile.Post(column, row) +
                       kShadowLift * tile.spacing() * tile.Normal(column, row));
    }
  }
  if (sun.direction.z() <= 0.0F) return std::vector<float>(places.size(), 0.0F);
  const std::vector<float> middle = CastMiddle(scene, sun, places);
  std::vector<size_t> posts;
  std::vector<Eigen::Vector3f> borders;
  for (int row = 0; row < kPosts; ++row) {
    for (int column = 0; column < kPosts; ++column) {
      if (AgreesWithNeighbours(middle, column, row)) continue;
      posts.push_back(static_cast<size_t>(row * kPosts + column));
      borders.push_back(places[posts.back()]);
    }
  }
  std::vector<float> shares(posts.size());
  CastSunlight(scene, sun, borders, shares.data());
  std::vector<float> sunlit = middle;
  for (size_t i = 0; i < posts.size(); ++i) sunlit[posts[i]] = shares[i];
  return sunlit;
}

}  // namespace regolith

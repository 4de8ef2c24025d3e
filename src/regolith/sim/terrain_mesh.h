// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/sim/ground.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/sim/sun_disc.h"

namespace regolith {

inline constexpr int kPacketSize = 16;

/// Rays cast together, frame world, m; directions are unit vectors. Lanes with limit < 0 are off.
struct alignas(64) RayPacket {
  float origin_x[kPacketSize];
  float origin_y[kPacketSize];
  float origin_z[kPacketSize];
  float direction_x[kPacketSize];
  float direction_y[kPacketSize];
  float direction_z[kPacketSize];
  float limit[kPacketSize];     ///< m; the ray ends here
  float distance[kPacketSize];  ///< result: m to the ground; infinite where nothing is met

  void Set(int lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
           float ray_limit);
  Eigen::Vector3f Point(int lane) const;
};

/// What the ground is like at a place of the mesh.
struct GroundPoint {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float albedo = 0.1F;
  float sunlit = 1.0F;  ///< share of the sun's disc that is seen from there
};

/// The one mesh that all sensors see: tiles of posts, fine near the path and coarser outwards.
/// Neighbours of different spacing share the coarser one's edge, so there are no cracks.
class TerrainMesh {
 public:
  /// `path`: positions of the rover in the plane (m, world). Throws CheckError for an empty one.
  /// The sun stands still during a drive, so its light is cast once, from `sun`, at every post.
  static std::unique_ptr<TerrainMesh> Create(const Ground& ground, Span<const Eigen::Vector2d> path,
                                             const SunDisc& sun, const MeshOptions& options,
                                             ThreadPool* pool);
  virtual ~TerrainMesh() = default;

  /// The nearest crossing of each ray. `coherent`: the rays run side by side (a camera's).
  virtual void Intersect(RayPacket* rays, bool coherent) const = 0;

  /// Whether anything lies on each ray: distance becomes 0 where so, infinite where not.
  virtual void Occluded(RayPacket* rays) const = 0;

  /// Shape and brightness below or above (x, y), m, world, between the posts.
  virtual GroundPoint At(float x, float y) const = 0;

  virtual size_t post_count() const = 0;
};

}  // namespace regolith

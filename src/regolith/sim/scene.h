// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/sim/ground.h"
#include "regolith/sim/ground_tile.h"
#include "regolith/sim/mesh_options.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/ray_packet.h"

namespace regolith {

/// The one world that all sensors see: tiles of ground and rocks. Tiles are made and freed as the
/// rover moves; sunlight and fill light are cast once on each.
class Scene {
 public:
  /// `path`: places of the rover in the plane (m, world); `rocks` in world. Throws CheckError for
  /// an empty path. `ground`, `photometry` and `pool` must outlive the scene.
  static std::unique_ptr<Scene> Create(const Ground& ground, Span<const Eigen::Vector2d> path,
                                       std::vector<Rock> rocks, const Photometry& photometry,
                                       const MeshOptions& options, ThreadPool* pool);
  virtual ~Scene() = default;

  /// Makes the tiles for a rover at `position` (m, world) and frees the others. Which tiles there
  /// are depends on `position` alone. Not to be called while others look.
  virtual void MoveTo(const Eigen::Vector2d& position) = 0;

  /// What each ray meets first.
  virtual void Intersect(RayPacket* rays) const = 0;

  /// Whether anything lies on each ray: distance becomes 0 where so, infinite where not.
  virtual void Occluded(RayPacket* rays) const = 0;

  /// The surface where a ray that Intersect filled meets it, averaged over the footprint of a ray
  /// that is `width` m wide and `height` m high there. A rock's light and fill are zero: they are
  /// not cast beforehand.
  virtual SurfacePoint Look(const RayPacket& rays, int lane, float width, float height) const = 0;

  virtual bool IsRock(uint32_t object) const = 0;
  /// Whether (x, y), m, world, lies on this tile of ground.
  virtual bool Covers(uint32_t object, float x, float y) const = 0;

  virtual size_t tile_count() const = 0;
  virtual size_t rock_count() const = 0;
};

/// The rocks around a path (m, frame `map`) that a drive can see: from 5 cm on within 20 m, from
/// 20 cm on within 100 m, from 60 cm on within 300 m.
std::vector<Rock> RocksAroundPath(const Surface& surface, Span<const Eigen::Vector2d> path);

}  // namespace regolith

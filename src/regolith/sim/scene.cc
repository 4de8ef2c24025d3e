// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <embree3/rtcore.h>

#include "regolith/core/check.h"
#include "regolith/sim/fill_light.h"
#include "regolith/sim/rock_grain.h"
#include "regolith/sim/sunlight.h"
#include "regolith/sim/tile_tree.h"

namespace regolith {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kSeedStep = 0x9e3779b9U;  // between two rocks' grains

struct RockBand {
  double diameter;  // m, from which on
  double reach;     // m from the path
};
constexpr RockBand kRockBands[] = {{0.05, 20.0}, {0.2, 100.0}, {0.6, 300.0}};
// A rock stands in the scene while the rover is nearer than this many of its diameters: beyond, it
// is narrower than a pixel.
constexpr double kRockReachByDiameter = 500.0;

// An Embree scene of its own, for an instance.
class Part {
 public:
  Part(RTCDevice device, RTCGeometry geometry) : scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Part() { rtcReleaseScene(scene_); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  RTCScene scene() const { return scene_; }

 private:
  RTCScene scene_;
};

RTCGeometry GridGeometry(RTCDevice device, const GroundTile& tile) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_GRID);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             tile.positions().data(), 0, sizeof(Eigen::Vector3f),
                             tile.positions().size());
  auto* grid = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0,
                                                             RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
  REGOLITH_CHECK(grid != nullptr, "Embree gave no memory for a tile");
  grid->startVertexID = 0;
  grid->stride = GroundTile::kSkirtPosts;
  grid->width = GroundTile::kSkirtPosts;
  grid->height = GroundTile::kSkirtPosts;
  return geometry;
}

RTCGeometry RockGeometry(RTCDevice device, const RockShape& shape) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(Eigen::Vector3f), shape.vertices.size()));
  auto* triangles = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), shape.triangles.size()));
  REGOLITH_CHECK(vertices != nullptr && triangles != nullptr, "Embree gave no memory for a rock");
  for (const Eigen::Vector3f& vertex : shape.vertices) {
    vertices = std::copy(vertex.data(), vertex.data() + 3, vertices);
  }
  for (const auto& triangle : shape.triangles) {
    triangles = std::copy(triangle.begin(), triangle.end(), triangles);
  }
  return geometry;
}

// A rock's place as an affine map of its shape, column by column.
std::array<float, 12> Placement(const Rock& rock) {
  const auto size = static_cast<float>(rock.diameter);
  const auto cosine = size * static_cast<float>(std::cos(rock.yaw));
  const auto sine = size * static_cast<float>(std::sin(rock.yaw));
  return {cosine,
          sine,
          0.0F,
          -sine,
          cosine,
          0.0F,
          0.0F,
          0.0F,
          size,
          static_cast<float>(rock.centre.x()),
          static_cast<float>(rock.centre.y()),
          static_cast<float>(rock.ground)};
}

class EmbreeScene : public Scene {
 public:
  EmbreeScene(const Ground& ground, Span<const Eigen::Vector2d> path, std::vector<Rock> rocks,
              const Photometry& photometry, const MeshOptions& options, ThreadPool* pool)
      : ground_(ground),
        tree_(options, path),
        rocks_(std::move(rocks)),
        placed_(rocks_.size(), 0),
        shapes_(ground.surface().RockShapes()),
        photometry_(photometry),
        interreflection_(options.interreflection),
        pool_(pool),
        // One thread builds a tree: it is the same tree each time.
        device_(rtcNewDevice("threads=1,set_affinity=0")) {
    REGOLITH_CHECK(device_ != nullptr, "Embree gave no device");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const RockShape& shape : shapes_) {
      parts_.push_back(std::make_unique<Part>(device_, RockGeometry(device_, shape)));
    }
    next_id_ = static_cast<uint32_t>(rocks_.size());
    MoveTo(path[0]);
  }

  ~EmbreeScene() override {
    tiles_.clear();
    parts_.clear();
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  void MoveTo(const Eigen::Vector2d& position) override;

  void Intersect(RayPacket* rays) const override {
    alignas(64) int valid[kPacketSize];
    RTCRayHit16 rayhit;
    Load(*rays, &rayhit.ray, valid);
    for (int i = 0; i < kPacketSize; ++i) {
      rayhit.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rayhit.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    // Not flagged as coherent: even a camera's neighbouring rays then cost a sixth more here, and
    // Embree 3.13 was seen to hang in them.
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid, scene_, &context, &rayhit);
    for (int i = 0; i < kPacketSize; ++i) {
      const bool hit = valid[i] != 0 && rayhit.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      rays->distance[i] = hit ? rayhit.ray.tfar[i] : kInfinity;
      rays->object[i] = hit ? rayhit.hit.instID[0][i] : kNothing;
      rays->triangle[i] = rayhit.hit.primID[i];
      rays->u[i] = rayhit.hit.u[i];
      rays->v[i] = rayhit.hit.v[i];
    }
  }

  void Occluded(RayPacket* rays) const override {
    alignas(64) int valid[kPacketSize];
    RTCRay16 ray;
    Load(*rays, &ray, valid);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid, scene_, &context, &ray);
    for (int i = 0; i < kPacketSize; ++i) {
      rays->distance[i] = valid[i] != 0 && ray.tfar[i] < 0.0F ? 0.0F : kInfinity;
    }
  }

  SurfacePoint Look(const RayPacket& rays, int lane, float width, float height) const override;

  bool IsRock(uint32_t object) const override { return object < rocks_.size(); }

  bool Covers(uint32_t object, float x, float y) const override {
    return by_id_[object - rocks_.size()]->Covers(x, y);
  }

  size_t tile_count() const override { return tiles_.size(); }
  size_t rock_count() const override { return rocks_.size(); }

 private:
  struct Tile {
    TileKey key;
    std::unique_ptr<GroundTile> ground;
    std::unique_ptr<Part> part;
  };

  bool ExchangeRocks(const Eigen::Vector2d& position);
  void Instance(RTCScene part, const std::array<float, 12>& placement, uint32_t id);
  std::vector<Tile*> Exchange(const std::vector<TileKey>& wanted);
  void Commit(const std::vector<Tile*>& made);
  void CastLight(const std::vector<Tile*>& tiles);
  SurfacePoint LookAtRock(const RayPacket& rays, int lane, float width) const;

  static void Load(const RayPacket& rays, RTCRay16* ray, int* valid) {
    for (int i = 0; i < kPacketSize; ++i) {
      valid[i] = rays.limit[i] > 0.0F ? -1 : 0;
      ray->org_x[i] = rays.origin_x[i];
      ray->org_y[i] = rays.origin_y[i];
      ray->org_z[i] = rays.origin_z[i];
      ray->dir_x[i] = rays.direction_x[i];
      ray->dir_y[i] = rays.direction_y[i];
      ray->dir_z[i] = rays.direction_z[i];
      ray->tnear[i] = 0.0F;
      ray->tfar[i] = rays.limit[i];
      ray->time[i] = 0.0F;
      ray->mask[i] = ~0U;
      ray->id[i] = static_cast<unsigned>(i);
      ray->flags[i] = 0;
    }
  }

  const Ground& ground_;
  TileTree tree_;
  std::vector<Rock> rocks_;
  std::vector<char> placed_;  // by rock: 1 where it stands in the scene
  std::vector<RockShape> shapes_;
  const Photometry& photometry_;
  bool interreflection_;
  ThreadPool* pool_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
  std::vector<std::unique_ptr<Part>> parts_;  // by shape
  // Ids: rocks first, then tiles.
  std::map<uint32_t, Tile> tiles_;
  std::map<TileKey, uint32_t> ids_;
  std::vector<uint32_t> free_ids_;
  uint32_t next_id_ = 0;
  std::vector<const GroundTile*> by_id_;  // from the first tile's id on
};

// Places the rocks that the rover can see now, and takes the others away. Whether any changed.
bool EmbreeScene::ExchangeRocks(const Eigen::Vector2d& position) {
  bool changed = false;
  for (size_t i = 0; i < rocks_.size(); ++i) {
    const Rock& rock = rocks_[i];
    const double reach = kRockReachByDiameter * rock.diameter;
    const bool wanted = (rock.centre - position).squaredNorm() < reach * reach;
    if (wanted == (placed_[i] != 0)) continue;
    changed = true;
    placed_[i] = wanted ? 1 : 0;
    const auto id = static_cast<uint32_t>(i);
    if (wanted) {
      REGOLITH_CHECK(rock.shape < parts_.size(), "rock of shape ", rock.shape);
      Instance(parts_[rock.shape]->scene(), Placement(rock), id);
    } else {
      rtcDetachGeometry(scene_, id);
    }
  }
  return changed;
}

void EmbreeScene::Instance(RTCScene part, const std::array<float, 12>& placement, uint32_t id) {
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, part);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, placement.data());
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, id);
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::MoveTo(const Eigen::Vector2d& position) {
  const bool other_rocks = ExchangeRocks(position);
  const std::vector<Tile*> made = Exchange(tree_.Wanted(position));
  if (made.empty() && !other_rocks) return;
  constexpr size_t kTilesAtOnce = 2;
  pool_->ParallelFor(made.size(), kTilesAtOnce, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      Tile& tile = *made[i];
      tile.ground = std::make_unique<GroundTile>(ground_, tree_.Corner(tile.key),
                                                 tree_.Spacing(tile.key.level));
      tile.part = std::make_unique<Part>(device_, GridGeometry(device_, *tile.ground));
    }
  });
  Commit(made);
  CastLight(made);
}

// Frees the tiles that are not wanted and makes room for the new ones, in their order.
std::vector<EmbreeScene::Tile*> EmbreeScene::Exchange(const std::vector<TileKey>& wanted) {
  for (auto entry = ids_.begin(); entry != ids_.end();) {
    if (std::binary_search(wanted.begin(), wanted.end(), entry->first)) {
      ++entry;
      continue;
    }
    rtcDetachGeometry(scene_, entry->second);
    tiles_.erase(entry->second);
    free_ids_.push_back(entry->second);
    entry = ids_.erase(entry);
  }
  std::vector<Tile*> made;
  for (const TileKey& key : wanted) {
    if (ids_.count(key) != 0) continue;
    if (free_ids_.empty()) free_ids_.push_back(next_id_++);
    const uint32_t id = free_ids_.back();
    free_ids_.pop_back();
    ids_[key] = id;
    Tile& tile = tiles_[id];
    tile.key = key;
    made.push_back(&tile);
  }
  return made;
}

void EmbreeScene::Commit(const std::vector<Tile*>& made) {
  constexpr std::array<float, 12> kInPlace = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  by_id_.assign(next_id_ - rocks_.size(), nullptr);
  for (const auto& [id, tile] : tiles_) {
    by_id_[id - rocks_.size()] = tile.ground.get();
  }
  for (const Tile* tile : made) Instance(tile->part->scene(), kInPlace, ids_.at(tile->key));
  rtcCommitScene(scene_);
  const RTCError error = rtcGetDeviceError(device_);
  REGOLITH_CHECK(error == RTC_ERROR_NONE, "Embree error ", static_cast<int>(error));
}

// Fill light is one bounce of the sunlight, so all of that comes first.
void EmbreeScene::CastLight(const std::vector<Tile*>& tiles) {
  pool_->ParallelFor(tiles.size(), 1, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      GroundTile& ground = *tiles[i]->ground;
      ground.SetSunlight(CastSunlightOnTile(*this, photometry_.sun(), ground),
                         photometry_.sun().direction);
    }
  });
  std::vector<std::vector<float>> fills(tiles.size());
  pool_->ParallelFor(tiles.size(), 1, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      fills[i] = CastFillLight(*this, photometry_, interreflection_, *tiles[i]->ground);
    }
  });
  // Not before all are cast: tiles see each other.
  for (size_t i = 0; i < tiles.size(); ++i) tiles[i]->ground->SetFill(std::move(fills[i]));
}

SurfacePoint EmbreeScene::Look(const RayPacket& rays, int lane, float width, float height) const {
  const uint32_t object = rays.object[lane];
  if (IsRock(object)) return LookAtRock(rays, lane, width);
  const GroundTile& tile = *by_id_[object - rocks_.size()];
  const Eigen::Vector3f place = rays.Point(lane);
  // The footprint is stretched where the ray grazes the level ground.
  const float down = std::max(std::abs(rays.direction_z[lane]), 0.01F);
  const Eigen::Vector2f plan(rays.direction_x[lane], rays.direction_y[lane]);
  const float norm = plan.norm();
  const Eigen::Vector2f along = norm > 1e-4F ? Eigen::Vector2f(plan / norm) : plan;
  return tile.At(place.x(), place.y(), width, height / down, along);
}

SurfacePoint EmbreeScene::LookAtRock(const RayPacket& rays, int lane, float width) const {
  const Rock& rock = rocks_[rays.object[lane]];
  const RockShape& shape = shapes_[rock.shape];
  const auto& corners = shape.triangles[rays.triangle[lane]];
  const float u = rays.u[lane];
  const float v = rays.v[lane];
  const Eigen::Vector3f normal = (1.0F - u - v) * shape.normals[corners[0]] +
                                 u * shape.normals[corners[1]] + v * shape.normals[corners[2]];
  const Eigen::Matrix3f R_world_rock =
      Eigen::AngleAxisf(static_cast<float>(rock.yaw), Eigen::Vector3f::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d centre(rock.centre.x(), rock.centre.y(), rock.ground);
  const RockGrain grain =
      GrainOfRock(rays.object[lane] * kSeedStep,
                  R_world_rock.transpose() * (rays.Point(lane) - centre.cast<float>()), width);
  SurfacePoint point;
  point.normal = R_world_rock * (normal.normalized() - grain.slope).normalized();
  point.albedo = grain.brightness * rock.brightness * photometry_.ground_albedo();
  return point;
}

}  // namespace

std::vector<Rock> RocksAroundPath(const Surface& surface, Span<const Eigen::Vector2d> path) {
  std::vector<Rock> rocks;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& place : path) box.extend(place);
  for (size_t band = 0; band < std::size(kRockBands); ++band) {
    const double reach = kRockBands[band].reach;
    const bool last = band + 1 == std::size(kRockBands);
    const double largest = last ? kInfinity : kRockBands[band + 1].diameter;
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach);
    for (const Rock& rock :
         surface.Rocks({box.min() - margin, box.max() + margin}, kRockBands[band].diameter)) {
      if (rock.diameter >= largest) continue;
      const bool near = std::any_of(path.begin(), path.end(), [&](const Eigen::Vector2d& place) {
        return (place - rock.centre).squaredNorm() < reach * reach;
      });
      if (near) rocks.push_back(rock);
    }
  }
  return rocks;
}

std::unique_ptr<Scene> Scene::Create(const Ground& ground, Span<const Eigen::Vector2d> path,
                                     std::vector<Rock> rocks, const Photometry& photometry,
                                     const MeshOptions& options, ThreadPool* pool) {
  REGOLITH_CHECK(!path.empty(), "a scene needs a path");
  return std::make_unique<EmbreeScene>(ground, path, std::move(rocks), photometry, options, pool);
}

}  // namespace regolith

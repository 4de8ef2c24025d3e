// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/terrain_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <embree3/rtcore.h>

#include "regolith/core/check.h"
#include "regolith/sim/mesh_tiles.h"

namespace regolith {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kFarAway = 5000.0F;         // m
constexpr float kGoldenAngle = 2.3999632F;  // rad
constexpr int kSunRays = 4;                 // a post
// Sun rays start above the post, by this share of the posts' spacing, so that rounding does not
// let a post shade itself.
constexpr float kShadowLift = 0.05F;

class EmbreeMesh : public TerrainMesh {
 public:
  // One thread builds the tree: it is the same tree each time, and takes under a second.
  EmbreeMesh(MeshTiles tiles, const SunDisc& sun, ThreadPool* pool)
      : tiles_(std::move(tiles)), device_(rtcNewDevice("threads=1,set_affinity=0")) {
    REGOLITH_CHECK(device_ != nullptr, "Embree gave no device");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    AddTiles();
    rtcCommitScene(scene_);
    const RTCError error = rtcGetDeviceError(device_);
    REGOLITH_CHECK(error == RTC_ERROR_NONE, "Embree error ", static_cast<int>(error));
    CastSunlight(sun, pool);
  }

  ~EmbreeMesh() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;

  void Intersect(RayPacket* rays, bool coherent) const override {
    alignas(64) int valid[kPacketSize];
    RTCRayHit16 rayhit;
    Load(*rays, &rayhit.ray, valid);
    for (unsigned& geometry : rayhit.hit.geomID) geometry = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene_, &context, &rayhit);
    for (int i = 0; i < kPacketSize; ++i) {
      const bool hit = valid[i] != 0 && rayhit.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      rays->distance[i] = hit ? rayhit.ray.tfar[i] : kInfinity;
    }
  }

  void Occluded(RayPacket* rays) const override {
    alignas(64) int valid[kPacketSize];
    RTCRay16 ray;
    Load(*rays, &ray, valid);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid, scene_, &context, &ray);
    for (int i = 0; i < kPacketSize; ++i) {
      rays->distance[i] = valid[i] != 0 && ray.tfar[i] < 0.0F ? 0.0F : kInfinity;
    }
  }

  GroundPoint At(float x, float y) const override {
    const auto size = static_cast<float>(MeshTiles::kTileSize);
    const float u = (x - static_cast<float>(tiles_.corner.x())) / size;
    const float v = (y - static_cast<float>(tiles_.corner.y())) / size;
    const int column = std::clamp(static_cast<int>(u), 0, tiles_.columns - 1);
    const int row = std::clamp(static_cast<int>(v), 0, tiles_.rows - 1);
    const MeshTile& tile = tiles_.TileAt(column, row);
    const float last = static_cast<float>(tile.posts - 1);
    const float i = std::clamp((u - static_cast<float>(column)) * last, 0.0F, last);
    const float j = std::clamp((v - static_cast<float>(row)) * last, 0.0F, last);
    return Interpolate(tile, i, j);
  }

  size_t post_count() const override { return tiles_.positions.size(); }

 private:
  void CastSunlight(const SunDisc& sun, ThreadPool* pool) {
    constexpr size_t kTilesAtOnce = 8;
    pool->ParallelFor(tiles_.tiles.size(), kTilesAtOnce, [&](size_t begin, size_t end, size_t) {
      for (size_t i = begin; i < end; ++i) CastSunlightOnTile(sun, tiles_.tiles[i]);
    });
  }

  // The rays of one post go to points spread over the sun's disc (Vogel 1979), so that shadows have
  // penumbras; a packet serves some posts side by side.
  void CastSunlightOnTile(const SunDisc& sun, const MeshTile& tile) {
    constexpr int kPostsAtOnce = kPacketSize / kSunRays;
    Eigen::Vector3f to_sun[kSunRays];
    for (int ray = 0; ray < kSunRays; ++ray) to_sun[ray] = PointOfDisc(sun, ray);
    const auto end = tile.first_post + static_cast<uint32_t>(tile.posts * tile.posts);
    RayPacket rays;
    for (uint32_t first = tile.first_post; first < end; first += kPostsAtOnce) {
      for (int lane = 0; lane < kPacketSize; ++lane) {
        const uint32_t post = first + static_cast<uint32_t>(lane / kSunRays);
        const uint32_t safe = std::min(post, end - 1);
        const MeshTiles::Shape& shape = tiles_.shapes[safe];
        const Eigen::Vector3f normal =
            Eigen::Vector3f(-shape.slope_x, -shape.slope_y, 1.0F).normalized();
        rays.Set(lane, tiles_.positions[safe] + kShadowLift * tile.spacing * normal,
                 to_sun[lane % kSunRays], post < end ? kFarAway : -1.0F);
      }
      Occluded(&rays);
      for (uint32_t post = first; post < std::min(first + kPostsAtOnce, end); ++post) {
        const float* distances = rays.distance + (post - first) * kSunRays;
        const auto seen = std::count_if(distances, distances + kSunRays,
                                        [](float distance) { return distance > 0.0F; });
        tiles_.shapes[post].sunlit = static_cast<float>(seen) / kSunRays;
      }
    }
  }

  static Eigen::Vector3f PointOfDisc(const SunDisc& sun, int index) {
    const Eigen::Vector3f across = sun.direction.unitOrthogonal();
    const Eigen::Vector3f along = sun.direction.cross(across);
    const float radius = sun.radius * std::sqrt((static_cast<float>(index) + 0.5F) / kSunRays);
    const float angle = kGoldenAngle * static_cast<float>(index);
    return (sun.direction + radius * (std::cos(angle) * across + std::sin(angle) * along))
        .normalized();
  }

  void AddTiles() {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               tiles_.positions.data(), 0, sizeof(Eigen::Vector3f),
                               tiles_.positions.size());
    auto* grids = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), tiles_.tiles.size()));
    REGOLITH_CHECK(grids != nullptr, "Embree gave no memory for ", tiles_.tiles.size(), " tiles");
    for (size_t i = 0; i < tiles_.tiles.size(); ++i) {
      const MeshTile& tile = tiles_.tiles[i];
      const auto posts = static_cast<uint16_t>(tile.posts);
      grids[i].startVertexID = tile.first_post;
      grids[i].stride = static_cast<unsigned>(tile.posts);
      grids[i].width = posts;
      grids[i].height = posts;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

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

  GroundPoint Interpolate(const MeshTile& tile, float i, float j) const {
    const int column = std::min(static_cast<int>(i), tile.posts - 2);
    const int row = std::min(static_cast<int>(j), tile.posts - 2);
    const float a = i - static_cast<float>(column);
    const float b = j - static_cast<float>(row);
    const MeshTiles::Shape* low =
        &tiles_.shapes[tile.first_post + static_cast<size_t>(row * tile.posts + column)];
    const MeshTiles::Shape* high = low + tile.posts;
    const float w00 = (1.0F - a) * (1.0F - b);
    const float w10 = a * (1.0F - b);
    const float w01 = (1.0F - a) * b;
    const float w11 = a * b;
    const auto mix = [&](float MeshTiles::Shape::*member) {
      return w00 * low[0].*member + w10 * low[1].*member + w01 * high[0].*member +
             w11 * high[1].*member;
    };
    GroundPoint point;
    point.normal =
        Eigen::Vector3f(-mix(&MeshTiles::Shape::slope_x), -mix(&MeshTiles::Shape::slope_y), 1.0F)
            .normalized();
    point.albedo = mix(&MeshTiles::Shape::albedo);
    point.sunlit = mix(&MeshTiles::Shape::sunlit);
    return point;
  }

  MeshTiles tiles_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

}  // namespace

void RayPacket::Set(int lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                    float ray_limit) {
  origin_x[lane] = origin.x();
  origin_y[lane] = origin.y();
  origin_z[lane] = origin.z();
  direction_x[lane] = direction.x();
  direction_y[lane] = direction.y();
  direction_z[lane] = direction.z();
  limit[lane] = ray_limit;
}

Eigen::Vector3f RayPacket::Point(int lane) const {
  return Eigen::Vector3f(origin_x[lane], origin_y[lane], origin_z[lane]) +
         distance[lane] * Eigen::Vector3f(direction_x[lane], direction_y[lane], direction_z[lane]);
}

std::unique_ptr<TerrainMesh> TerrainMesh::Create(const Ground& ground,
                                                 Span<const Eigen::Vector2d> path,
                                                 const SunDisc& sun, const MeshOptions& options,
                                                 ThreadPool* pool) {
  return std::make_unique<EmbreeMesh>(BuildMeshTiles(ground, path, options, pool), sun, pool);
}

}  // namespace regolith

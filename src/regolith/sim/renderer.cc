// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr float kFarAway = 2e4F;  // m
// Farther level ground is seen so flat that a pixel's footprint is over five times as long as wide.
constexpr float kFarGround = 6.0F;  // m
// Neighbouring pixels of one surface differ less than this in distance.
constexpr float kEdgeRatio = 1.12F;
constexpr int kSubsamples = 4;
constexpr float kSubsampleShift = 0.25F;  // pixels
constexpr float kLift = 1e-3F;            // m, of rays that start on a surface

// The same class of objects: all ground is one.
uint32_t Class(const Scene& scene, uint32_t object) {
  constexpr uint32_t kGround = kNothing - 1;
  if (object == kNothing || scene.IsRock(object)) return object;
  return kGround;
}

}  // namespace

Renderer::Renderer(const CameraIntrinsics& intrinsics, const Scene& scene,
                   const Photometry& photometry, ThreadPool* pool)
    : width_(intrinsics.width),
      height_(intrinsics.height),
      pixel_(static_cast<float>(1.0 / intrinsics.focal.x())),
      scene_(scene),
      photometry_(photometry),
      pool_(pool) {
  const auto model = CameraModel::Create(intrinsics);
  for (int row = 0; row < height_; ++row) {
    for (int column = 0; column < width_; ++column) {
      const Eigen::Vector2d pixel(column, row);
      const auto bearing = model->Unproject(pixel);
      REGOLITH_CHECK(bearing.has_value(), "pixel ", pixel.transpose(), " has no bearing");
      bearings_.push_back(bearing->cast<float>());
    }
  }
}

void Renderer::Render(const SE3& T_world_camera, const Surroundings& surroundings,
                      RenderedView* view) const {
  const Pose pose{T_world_camera.rotation.toRotationMatrix().cast<float>(),
                  T_world_camera.translation.cast<float>()};
  view->width = width_;
  view->height = height_;
  view->radiance.resize(bearings_.size());
  view->distance.resize(bearings_.size());
  std::vector<uint32_t> objects(bearings_.size());
  constexpr size_t kRowsAtOnce = 8;
  const auto rows = static_cast<size_t>(height_);
  pool_->ParallelFor(rows, kRowsAtOnce, [&](size_t begin, size_t end, size_t) {
    for (size_t row = begin; row < end; ++row) {
      RenderRow(pose, surroundings, static_cast<int>(row), view, &objects);
    }
  });
  pool_->ParallelFor(rows, kRowsAtOnce, [&](size_t begin, size_t end, size_t) {
    for (size_t row = begin; row < end; ++row) {
      RefineRow(pose, surroundings, static_cast<int>(row), objects, view->distance, view);
    }
  });
}

void Renderer::RenderRow(const Pose& pose, const Surroundings& surroundings, int row,
                         RenderedView* view, std::vector<uint32_t>* objects) const {
  RayPacket rays;
  for (int first = 0; first < width_; first += kPacketSize) {
    const int count = std::min(kPacketSize, width_ - first);
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (lane < count) {
        rays.Set(lane, pose.origin, pose.R_world_camera * bearing(first + lane, row), kFarAway);
      } else {
        rays.Off(lane);
      }
    }
    scene_.Intersect(&rays, true);
    const auto pixel = static_cast<size_t>(row * width_ + first);
    Shade(rays, count, pixel_, surroundings, &view->radiance[pixel]);
    for (int lane = 0; lane < count; ++lane) {
      view->distance[pixel + static_cast<size_t>(lane)] = rays.distance[lane];
      (*objects)[pixel + static_cast<size_t>(lane)] = Class(scene_, rays.object[lane]);
    }
  }
}

bool Renderer::NeedsMore(const std::vector<uint32_t>& objects, const std::vector<float>& distances,
                         int column, int row) const {
  const auto pixel = static_cast<size_t>(row * width_ + column);
  const float distance = distances[pixel];
  if (distance > kFarGround && std::isfinite(distance)) return true;
  const auto differs = [&](size_t other) {
    if (objects[pixel] != objects[other]) return true;
    const float ratio = distance / distances[other];
    return ratio > kEdgeRatio || ratio < 1.0F / kEdgeRatio;
  };
  const auto width = static_cast<size_t>(width_);
  return (column > 0 && differs(pixel - 1)) || (column + 1 < width_ && differs(pixel + 1)) ||
         (row > 0 && differs(pixel - width)) || (row + 1 < height_ && differs(pixel + width));
}

// The bearing `right` and `down` of a pixel, in pixels, by central differences.
Eigen::Vector3f Renderer::Between(int column, int row, float right, float down) const {
  const int left_column = std::max(column - 1, 0);
  const int right_column = std::min(column + 1, width_ - 1);
  const int upper_row = std::max(row - 1, 0);
  const int lower_row = std::min(row + 1, height_ - 1);
  const float across = right / static_cast<float>(right_column - left_column);
  const float along = down / static_cast<float>(lower_row - upper_row);
  return (bearing(column, row) +
          across * (bearing(right_column, row) - bearing(left_column, row)) +
          along * (bearing(column, lower_row) - bearing(column, upper_row)))
      .normalized();
}

void Renderer::RefineRow(const Pose& pose, const Surroundings& surroundings, int row,
                         const std::vector<uint32_t>& objects, const std::vector<float>& distances,
                         RenderedView* view) const {
  std::vector<Sample> samples;
  for (int column = 0; column < width_; ++column) {
    if (!NeedsMore(objects, distances, column, row)) continue;
    for (int i = 0; i < kSubsamples; ++i) {
      const float right = i % 2 == 0 ? -kSubsampleShift : kSubsampleShift;
      const float down = i / 2 == 0 ? -kSubsampleShift : kSubsampleShift;
      samples.push_back({pose.R_world_camera * Between(column, row, right, down), column});
    }
    view->radiance[static_cast<size_t>(row * width_ + column)] = 0.0F;
  }
  RayPacket rays;
  float radiance[kPacketSize];
  for (size_t first = 0; first < samples.size(); first += kPacketSize) {
    const auto count = static_cast<int>(std::min<size_t>(kPacketSize, samples.size() - first));
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (lane < count) {
        rays.Set(lane, pose.origin, samples[first + static_cast<size_t>(lane)].direction, kFarAway);
      } else {
        rays.Off(lane);
      }
    }
    scene_.Intersect(&rays, true);
    Shade(rays, count, 0.5F * pixel_, surroundings, radiance);
    for (int lane = 0; lane < count; ++lane) {
      const int column = samples[first + static_cast<size_t>(lane)].column;
      view->radiance[static_cast<size_t>(row * width_ + column)] += radiance[lane] / kSubsamples;
    }
  }
}

void Renderer::Shade(const RayPacket& rays, int count, float pixel,
                     const Surroundings& surroundings, float* radiance) const {
  SurfacePoint points[kPacketSize];
  bool rocks = false;
  for (int lane = 0; lane < count; ++lane) {
    if (rays.object[lane] == kNothing) continue;
    points[lane] = scene_.Look(rays, lane, pixel * rays.distance[lane]);
    rocks = rocks || scene_.IsRock(rays.object[lane]);
  }
  if (rocks) LightRocks(rays, count, points);
  for (int lane = 0; lane < count; ++lane) {
    const Eigen::Vector3f direction = rays.Direction(lane);
    if (rays.object[lane] == kNothing) {
      radiance[lane] = photometry_.Sky(direction);
      continue;
    }
    if (surroundings.rover != nullptr && points[lane].light > 0.0F) {
      points[lane].light *= surroundings.rover->Sunlit(rays.Point(lane), photometry_.sun());
    }
    radiance[lane] = photometry_.Ground(points[lane], -direction);
  }
  if (surroundings.lamp.irradiance > 0.0F) {
    AddLamp(rays, count, surroundings.lamp, points, radiance);
  }
  for (int lane = 0; lane < count; ++lane) {
    if (rays.object[lane] == kNothing) continue;
    radiance[lane] =
        photometry_.ThroughAir(radiance[lane], rays.Direction(lane), rays.distance[lane]);
  }
}

// Rocks are few: their light is cast when they are seen.
void Renderer::LightRocks(const RayPacket& rays, int count, SurfacePoint* points) const {
  std::vector<Eigen::Vector3f> places;
  for (int lane = 0; lane < count; ++lane) {
    if (scene_.IsRock(rays.object[lane])) {
      places.push_back(rays.Point(lane) + kLift * points[lane].normal);
    }
  }
  float sunlit[kPacketSize];
  CastSunlight(scene_, photometry_.sun(), places, sunlit);
  size_t next = 0;
  for (int lane = 0; lane < count; ++lane) {
    if (!scene_.IsRock(rays.object[lane])) continue;
    const float incidence = points[lane].normal.dot(photometry_.sun().direction);
    points[lane].light = sunlit[next++] * std::max(incidence, 0.0F);
    points[lane].fill = photometry_.FillOutside(points[lane].normal);
  }
}

void Renderer::AddLamp(const RayPacket& rays, int count, const Lamp& lamp,
                       const SurfacePoint* points, float* radiance) const {
  RayPacket to_lamp;
  for (int lane = 0; lane < kPacketSize; ++lane) {
    to_lamp.Off(lane);
    if (lane >= count || rays.object[lane] == kNothing) continue;
    const Eigen::Vector3f place = rays.Point(lane) + kLift * points[lane].normal;
    const Eigen::Vector3f towards = lamp.place - place;
    to_lamp.Set(lane, place, towards.normalized(), towards.norm());
  }
  RayPacket seen = to_lamp;
  scene_.Occluded(&seen);
  for (int lane = 0; lane < count; ++lane) {
    if (to_lamp.limit[lane] < 0.0F || seen.distance[lane] == 0.0F) continue;
    const Eigen::Vector3f direction = to_lamp.Direction(lane);
    const float off = std::acos(std::clamp(-direction.dot(lamp.axis), -1.0F, 1.0F)) / lamp.beam;
    const float irradiance = lamp.irradiance * std::exp2(-off * off) /
                             (to_lamp.limit[lane] * to_lamp.limit[lane]);
    radiance[lane] +=
        photometry_.LitBy(points[lane], direction, irradiance, -rays.Direction(lane));
  }
}

}  // namespace regolith

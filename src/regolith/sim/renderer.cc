// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/core/check.h"
#include "regolith/sim/sunlight.h"

namespace regolith {
namespace {

constexpr float kFarAway = 2e4F;  // m
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Farther level ground is seen so flat that a pixel's footprint is over five times as long as wide.
constexpr float kFarGround = 7.0F;  // m
// Two rays two pixels apart see one surface where their distances differ by less than these shares;
// what lies behind a crest is the nearer in pixels the farther both are, so they grow by the metre.
constexpr float kToleranceAcross = 0.02F;
constexpr float kToleranceDown = 0.03F;
constexpr float kToleranceByMetre = 0.012F;
// Two rays one pixel apart, to interpolate half-way between them.
constexpr float kToleranceHalfway = 0.015F;
constexpr float kToleranceHalfwayByMetre = 0.006F;
constexpr float kMostTolerance = 0.3F;
// Neighbouring pixels of one surface differ less than this in distance.
constexpr float kEdgeRatio = 1.12F;
constexpr int kSubsamples = 2;           // beside the one in the middle
constexpr float kSubsampleShift = 0.3F;  // pixels
constexpr float kLift = 1e-3F;           // m, of rays that start on a surface

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
                      RenderedView* view, const NearbyView* nearby) const {
  const Pose pose{T_world_camera.rotation.toRotationMatrix().cast<float>(),
                  T_world_camera.translation.cast<float>(), nearby};
  view->width = width_;
  view->height = height_;
  view->radiance.resize(bearings_.size());
  view->distance.resize(bearings_.size());
  view->objects.resize(bearings_.size());
  // An even number, so that the lines that are cast are the same for all.
  constexpr size_t kRowsAtOnce = 16;
  const auto rows = static_cast<size_t>(height_);
  pool_->ParallelFor(rows, kRowsAtOnce, [&](size_t begin, size_t end, size_t) {
    RenderRows(pose, surroundings, static_cast<int>(begin), static_cast<int>(end), view);
  });
  pool_->ParallelFor(rows, kRowsAtOnce, [&](size_t begin, size_t end, size_t) {
    RefineRows(pose, surroundings, static_cast<int>(begin), static_cast<int>(end), view);
  });
}

Renderer::Line Renderer::Aim(const Pose& pose, int row, float down) const {
  Line line;
  line.row = row;
  const auto width = static_cast<size_t>(width_);
  line.directions.reserve(width);
  for (int column = 0; column < width_; ++column) {
    line.directions.push_back(pose.R_world_camera * (down == 0.0F ? bearing(column, row)
                                                                  : Between(column, row, 0, down)));
  }
  line.distances.assign(width, kInfinity);
  line.objects.assign(width, kNothing);
  line.triangles.resize(width);
  line.u.resize(width);
  line.v.resize(width);
  return line;
}

void Renderer::CastColumns(const Pose& pose, Span<const int> columns, Line* line) const {
  RayPacket rays;
  int lanes[kPacketSize];
  int count = 0;
  const auto cast = [&] {
    for (int lane = count; lane < kPacketSize; ++lane) rays.Off(lane);
    scene_.Intersect(&rays);
    for (int lane = 0; lane < count; ++lane) {
      const auto column = static_cast<size_t>(lanes[lane]);
      line->distances[column] = rays.distance[lane];
      line->objects[column] = rays.object[lane];
      line->triangles[column] = rays.triangle[lane];
      line->u[column] = rays.u[lane];
      line->v[column] = rays.v[lane];
    }
    count = 0;
  };
  for (const int column : columns) {
    const auto here = static_cast<size_t>(column);
    if (pose.nearby != nullptr) {
      const auto end = pose.nearby->Find(column, line->row, pose.origin, line->directions[here]);
      if (end) {
        line->distances[here] = end->distance;
        line->objects[here] = end->object;
        continue;
      }
    }
    rays.Set(count, pose.origin, line->directions[here], kFarAway);
    lanes[count++] = column;
    if (count == kPacketSize) cast();
  }
  if (count > 0) cast();
}

// The ray half-way between two that see the sky, or nearly the same place of the ground.
bool Renderer::Interpolate(const Pose& pose, const RayEnd& one, const RayEnd& other,
                           float tolerance, Line* line, int column) const {
  if (!SeeOneSurface(scene_, one, other, std::min(tolerance, kMostTolerance))) return false;
  if (one.object == kNothing) return true;
  const auto here = static_cast<size_t>(column);
  const float nearer = std::min(one.distance, other.distance);
  const float farther = std::max(one.distance, other.distance);
  const float distance = 2.0F * nearer * farther / (nearer + farther);
  const Eigen::Vector3f place = pose.origin + distance * line->directions[here];
  const bool on_one = scene_.Covers(one.object, place.x(), place.y());
  if (!on_one && !scene_.Covers(other.object, place.x(), place.y())) return false;
  line->distances[here] = distance;
  line->objects[here] = on_one ? one.object : other.object;
  return true;
}

// Casts every second column, and those that cannot be interpolated between them.
void Renderer::CastSparse(const Pose& pose, Line* line) const {
  std::vector<int> columns;
  for (int column = 0; column < width_; column += 2) columns.push_back(column);
  CastColumns(pose, columns, line);
  columns.clear();
  for (int column = 1; column < width_; column += 2) {
    if (column + 1 == width_) {
      columns.push_back(column);
      continue;
    }
    const auto here = static_cast<size_t>(column);
    const RayEnd left{line->distances[here - 1], line->objects[here - 1]};
    const RayEnd right{line->distances[here + 1], line->objects[here + 1]};
    const float tolerance = kToleranceAcross + kToleranceByMetre * left.distance;
    if (!Interpolate(pose, left, right, tolerance, line, column)) columns.push_back(column);
  }
  CastColumns(pose, columns, line);
}

void Renderer::CastBetween(const Pose& pose, const Line& above, const Line& below,
                           Line* line) const {
  std::vector<int> columns;
  for (int column = 0; column < width_; ++column) {
    const auto here = static_cast<size_t>(column);
    const RayEnd upper{above.distances[here], above.objects[here]};
    const RayEnd lower{below.distances[here], below.objects[here]};
    const float tolerance = kToleranceDown + kToleranceByMetre * lower.distance;
    if (!Interpolate(pose, upper, lower, tolerance, line, column)) columns.push_back(column);
  }
  CastColumns(pose, columns, line);
}

// The wanted columns half-way between two lines of pixels.
void Renderer::CastHalfway(const Pose& pose, const RenderedView& view, int upper_row,
                           Span<const char> wanted, Line* line) const {
  std::vector<int> columns;
  for (int column = 0; column < width_; ++column) {
    if (!wanted[static_cast<size_t>(column)]) continue;
    const RayEnd upper = view.End(column, upper_row);
    const RayEnd lower = view.End(column, upper_row + 1);
    const float tolerance = kToleranceHalfway + kToleranceHalfwayByMetre * lower.distance;
    if (!Interpolate(pose, upper, lower, tolerance, line, column)) columns.push_back(column);
  }
  CastColumns(pose, columns, line);
}

void Renderer::RenderRows(const Pose& pose, const Surroundings& surroundings, int begin, int end,
                          RenderedView* view) const {
  const auto keep = [&](int row, const Line& line) {
    const auto start = static_cast<size_t>(row * width_);
    ShadeLine(pose, surroundings, line, {}, &view->radiance[start]);
    for (size_t i = 0; i < line.objects.size(); ++i) {
      view->distance[start + i] = line.distances[i];
      view->objects[start + i] = line.objects[i];
    }
  };
  Line above = Aim(pose, begin, 0.0F);
  CastSparse(pose, &above);
  for (int row = begin; row < end; row += 2) {
    keep(row, above);
    if (row + 1 >= end) break;
    Line below = Aim(pose, std::min(row + 2, height_ - 1), 0.0F);
    CastSparse(pose, &below);
    Line between = Aim(pose, row + 1, 0.0F);
    CastBetween(pose, above, below, &between);
    keep(row + 1, between);
    above = std::move(below);
  }
}

void Renderer::ShadeLine(const Pose& pose, const Surroundings& surroundings, const Line& line,
                         Span<const char> wanted, float* radiance) const {
  RayPacket rays;
  int columns[kPacketSize];
  float shades[kPacketSize];
  int count = 0;
  const auto flush = [&] {
    Shade(rays, count, pixel_, 0.5F * pixel_, surroundings, shades);
    for (int lane = 0; lane < count; ++lane) radiance[columns[lane]] = shades[lane];
    count = 0;
  };
  for (int column = 0; column < width_; ++column) {
    const auto i = static_cast<size_t>(column);
    if (!wanted.empty() && !wanted[i]) continue;
    rays.Set(count, pose.origin, line.directions[i], kFarAway);
    rays.distance[count] = line.distances[i];
    rays.object[count] = line.objects[i];
    rays.triangle[count] = line.triangles[i];
    rays.u[count] = line.u[i];
    rays.v[count] = line.v[i];
    columns[count++] = column;
    if (count == kPacketSize) flush();
  }
  if (count > 0) flush();
}

bool Renderer::OnEdge(const RenderedView& view, int column, int row) const {
  const RayEnd here = view.End(column, row);
  const auto differs = [&](int other_column, int other_row) {
    const RayEnd other = view.End(other_column, other_row);
    if (here.object != other.object && Class(scene_, here.object) != Class(scene_, other.object)) {
      return true;
    }
    // Far crests are looked at between the lines.
    if (std::min(here.distance, other.distance) > kFarGround) return false;
    const float ratio = here.distance / other.distance;
    return ratio > kEdgeRatio + kToleranceByMetre * other.distance ||
           ratio * (kEdgeRatio + kToleranceByMetre * here.distance) < 1.0F;
  };
  return (column > 0 && differs(column - 1, row)) ||
         (column + 1 < width_ && differs(column + 1, row)) ||
         (row > 0 && differs(column, row - 1)) || (row + 1 < height_ && differs(column, row + 1));
}

// The bearing `right` and `down` of a pixel, in pixels, by central differences.
Eigen::Vector3f Renderer::Between(int column, int row, float right, float down) const {
  const int left_column = std::max(column - 1, 0);
  const int right_column = std::min(column + 1, width_ - 1);
  const int upper_row = std::max(row - 1, 0);
  const int lower_row = std::min(row + 1, height_ - 1);
  const float across = right / static_cast<float>(right_column - left_column);
  const float along = down / static_cast<float>(lower_row - upper_row);
  return (bearing(column, row) + across * (bearing(right_column, row) - bearing(left_column, row)) +
          along * (bearing(column, lower_row) - bearing(column, upper_row)))
      .normalized();
}

void Renderer::RefineRows(const Pose& pose, const Surroundings& surroundings, int begin, int end,
                          RenderedView* view) const {
  std::vector<std::vector<char>> far;
  std::vector<int> edges;
  for (int row = begin; row < end; ++row) {
    std::vector<char>& far_here = far.emplace_back(static_cast<size_t>(width_), 0);
    edges.clear();
    for (int column = 0; column < width_; ++column) {
      const float distance = view->distance[static_cast<size_t>(row * width_ + column)];
      if (OnEdge(*view, column, row)) {
        edges.push_back(column);
      } else if (distance > kFarGround && std::isfinite(distance) && row > 0 && row + 1 < height_) {
        far_here[static_cast<size_t>(column)] = 1;
      }
    }
    if (!edges.empty()) RefineEdges(pose, surroundings, row, edges, view);
  }
  RefineFar(pose, surroundings, begin, far, view);
}

// Far pixels get half of their light from their own line and a quarter each from the lines between
// them and their neighbours: a tent over two pixels' height.
void Renderer::RefineFar(const Pose& pose, const Surroundings& surroundings, int begin,
                         const std::vector<std::vector<char>>& far, RenderedView* view) const {
  const auto rows = static_cast<int>(far.size());
  const auto width = static_cast<size_t>(width_);
  const auto is_far = [&](int row, size_t column) {
    return row >= 0 && row < rows && far[static_cast<size_t>(row)][column] != 0;
  };
  for (int row = 0; row < rows; ++row) {
    float* radiance = &view->radiance[static_cast<size_t>(begin + row) * width];
    for (size_t i = 0; i < width; ++i) radiance[i] *= is_far(row, i) ? 0.5F : 1.0F;
  }
  std::vector<char> wanted(width);
  std::vector<float> between(width);
  for (int upper = -1; upper < rows; ++upper) {
    for (size_t i = 0; i < width; ++i) {
      wanted[i] = is_far(upper, i) || is_far(upper + 1, i) ? 1 : 0;
      between[i] = 0.0F;
    }
    if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end()) continue;
    Line line = Aim(pose, begin + upper, 0.5F);
    CastHalfway(pose, *view, begin + upper, wanted, &line);
    ShadeLine(pose, surroundings, line, wanted, between.data());
    for (const int row : {upper, upper + 1}) {
      for (size_t i = 0; i < width; ++i) {
        if (is_far(row, i)) {
          view->radiance[static_cast<size_t>(begin + row) * width + i] += 0.25F * between[i];
        }
      }
    }
  }
}

void Renderer::RefineEdges(const Pose& pose, const Surroundings& surroundings, int row,
                           Span<const int> columns, RenderedView* view) const {
  float* radiance = &view->radiance[static_cast<size_t>(row * width_)];
  RayPacket rays;
  float shades[kPacketSize];
  constexpr size_t kPixelsAtOnce = kPacketSize / kSubsamples;
  for (size_t first = 0; first < columns.size(); first += kPixelsAtOnce) {
    const size_t pixels = std::min(kPixelsAtOnce, columns.size() - first);
    const auto count = static_cast<int>(pixels) * kSubsamples;
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (lane >= count) {
        rays.Off(lane);
        continue;
      }
      const float shift = lane % kSubsamples == 0 ? -kSubsampleShift : kSubsampleShift;
      const int column = columns[first + static_cast<size_t>(lane / kSubsamples)];
      rays.Set(lane, pose.origin, pose.R_world_camera * Between(column, row, shift, -shift),
               kFarAway);
    }
    scene_.Intersect(&rays);
    Shade(rays, count, 0.5F * pixel_, 0.5F * pixel_, surroundings, shades);
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
      const float* parts = shades + pixel * kSubsamples;
      float& sum = radiance[columns[first + pixel]];
      sum = (sum + parts[0] + parts[1]) / (kSubsamples + 1);
    }
  }
}

// A footprint is `width` rad wide and as high, or `far_height` rad where the ground is far.
void Renderer::Shade(const RayPacket& rays, int count, float width, float far_height,
                     const Surroundings& surroundings, float* radiance) const {
  SurfacePoint points[kPacketSize];
  bool rocks = false;
  for (int lane = 0; lane < count; ++lane) {
    if (rays.object[lane] == kNothing) continue;
    const float distance = rays.distance[lane];
    const float height = distance > kFarGround ? far_height : width;
    points[lane] = scene_.Look(rays, lane, width * distance, height * distance);
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
  int lanes[kPacketSize];
  for (int lane = 0; lane < count; ++lane) {
    if (!scene_.IsRock(rays.object[lane])) continue;
    points[lane].fill = photometry_.FillOutside(points[lane].normal);
    points[lane].light = points[lane].normal.dot(photometry_.sun().direction);
    if (points[lane].light <= 0.0F) {
      points[lane].light = 0.0F;
      continue;
    }
    lanes[places.size()] = lane;
    places.push_back(rays.Point(lane) + kLift * points[lane].normal);
  }
  float sunlit[kPacketSize];
  CastSunlight(scene_, photometry_.sun(), places, sunlit);
  for (size_t i = 0; i < places.size(); ++i) points[lanes[i]].light *= sunlit[i];
}

void Renderer::AddLamp(const RayPacket& rays, int count, const Lamp& lamp,
                       const SurfacePoint* points, float* radiance) const {
  RayPacket to_lamp;
  for (int lane = 0; lane < kPacketSize; ++lane) {
    to_lamp.Off(lane);
    if (lane >= count || rays.object[lane] == kNothing) continue;
    // Interpolated places may lie a little under the ground.
    const Eigen::Vector3f place = rays.Point(lane) + kLift * points[lane].normal -
                                  kToleranceAcross * rays.distance[lane] * rays.Direction(lane);
    const Eigen::Vector3f towards = lamp.place - place;
    to_lamp.Set(lane, place, towards.normalized(), towards.norm());
  }
  RayPacket seen = to_lamp;
  scene_.Occluded(&seen);
  for (int lane = 0; lane < count; ++lane) {
    if (to_lamp.limit[lane] < 0.0F || seen.distance[lane] == 0.0F) continue;
    const Eigen::Vector3f direction = to_lamp.Direction(lane);
    const float off = std::acos(std::clamp(-direction.dot(lamp.axis), -1.0F, 1.0F)) / lamp.beam;
    const float irradiance =
        lamp.irradiance * std::exp2(-off * off) / (to_lamp.limit[lane] * to_lamp.limit[lane]);
    radiance[lane] += photometry_.LitBy(points[lane], direction, irradiance, -rays.Direction(lane));
  }
}

}  // namespace regolith

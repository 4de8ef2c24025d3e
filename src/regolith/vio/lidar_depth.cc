// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/lidar_depth.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <Eigen/Eigenvalues>

namespace regolith {
namespace {

/// The grid spans this much of x / z and y / z to both sides: 60° off the axis.
constexpr float kGridReach = 1.75F;
constexpr float kNearest = 0.3F;  // m before the camera

uint64_t VoxelOf(const Eigen::Vector3f& point, double size) {
  const auto index = [&](float value) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(value / size)) & 0x1fffff);
  };
  return index(point.x()) | index(point.y()) << 21 | index(point.z()) << 42;
}

}  // namespace

LidarDepth::LidarDepth(const LidarDepthOptions& options)
    : options_(options),
      cells_(static_cast<int>(std::ceil(2.0 * kGridReach / options.search_angle))) {
  options.Check();
}

void LidarDepth::Add(TimeNs time, Span<const Eigen::Vector3f> points_world,
                     const Eigen::Vector3d& lidar_world) {
  Scan scan{time, lidar_world, 0.0, {}};
  if (!scans_.empty()) {
    scan.way = scans_.back().way + (lidar_world - scans_.back().lidar_world).norm();
  }
  std::unordered_set<uint64_t> occupied;
  for (const Eigen::Vector3f& point : points_world) {
    if ((point.cast<double>() - lidar_world).norm() > options_.max_range) continue;
    if (occupied.insert(VoxelOf(point, options_.spacing)).second) {
      scan.points_world.push_back(point);
    }
  }
  // A rover that stands sees the same again and again.
  const bool stood = scans_.size() > 1 && scan.way - scans_[scans_.size() - 2].way < 0.02;
  if (stood) scans_.pop_back();
  scans_.push_back(std::move(scan));
  while (SecondsBetween(scans_.front().time, time) > options_.seconds &&
         scans_.back().way - scans_.front().way > options_.metres) {
    scans_.pop_front();
  }
}

int LidarDepth::CellOf(float coordinate) const {
  return static_cast<int>((coordinate + kGridReach) / static_cast<float>(options_.search_angle));
}

void LidarDepth::Project(const SE3& T_world_camera) {
  const SE3 T_camera_world = T_world_camera.Inverse();
  const Eigen::Matrix3f R = T_camera_world.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f p = T_camera_world.translation.cast<float>();
  std::vector<Return> seen;
  std::vector<uint32_t> cells;
  cell_begin_.assign(static_cast<size_t>(cells_) * static_cast<size_t>(cells_) + 1, 0);
  for (const Scan& scan : scans_) {
    for (const Eigen::Vector3f& point : scan.points_world) {
      const Eigen::Vector3f point_camera = R * point + p;
      if (point_camera.z() < kNearest) continue;
      const Eigen::Vector2f place = point_camera.head<2>() / point_camera.z();
      if (place.cwiseAbs().maxCoeff() >= kGridReach) continue;
      const auto cell = static_cast<uint32_t>(CellOf(place.y()) * cells_ + CellOf(place.x()));
      seen.push_back({point_camera, place});
      cells.push_back(cell);
      ++cell_begin_[cell + 1];
    }
  }
  for (size_t i = 1; i < cell_begin_.size(); ++i) cell_begin_[i] += cell_begin_[i - 1];
  returns_.resize(seen.size());
  std::vector<uint32_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (size_t i = 0; i < seen.size(); ++i) returns_[next[cells[i]]++] = seen[i];
}

std::vector<Eigen::Vector3d> LidarDepth::NearestReturns(const Eigen::Vector3d& bearing) const {
  const Eigen::Vector2f place = (bearing.head<2>() / bearing.z()).cast<float>();
  const int column = CellOf(place.x());
  const int row = CellOf(place.y());
  // Off the axis a step of the grid is a smaller angle: fewer returns count there.
  const auto reach = static_cast<float>(options_.search_angle);
  std::vector<std::pair<float, const Return*>> near;
  float nearest_range = 1e9F;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, cells_ - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, cells_ - 1); ++x) {
      const size_t cell =
          static_cast<size_t>(y) * static_cast<size_t>(cells_) + static_cast<size_t>(x);
      for (uint32_t i = cell_begin_[cell]; i < cell_begin_[cell + 1]; ++i) {
        const float distance = (returns_[i].place - place).norm();
        if (distance > reach) continue;
        near.emplace_back(distance, &returns_[i]);
        nearest_range = std::min(nearest_range, returns_[i].point_camera.norm());
      }
    }
  }
  // What lies far behind the nearest return is hidden by it.
  const float limit = nearest_range * (1.0F + static_cast<float>(options_.depth_step));
  near.erase(
      std::remove_if(near.begin(), near.end(),
                     [&](const auto& entry) { return entry.second->point_camera.norm() > limit; }),
      near.end());
  std::sort(near.begin(), near.end());
  // All around the bearing, not the nearest alone: where returns are dense, those lie within their
  // own noise.
  const size_t count = std::min(near.size(), static_cast<size_t>(options_.max_returns));
  std::vector<Eigen::Vector3d> points;
  for (size_t i = 0; i < count; ++i) {
    points.push_back(near[i * near.size() / count].second->point_camera.cast<double>());
  }
  return points;
}

std::optional<MeasuredDistance> LidarDepth::DistanceOf(const Eigen::Vector3d& bearing) const {
  if (bearing.z() < 0.3) return std::nullopt;
  const std::vector<Eigen::Vector3d> points = NearestReturns(bearing);
  if (points.size() < 3) return std::nullopt;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    spread += (point - mean) * (point - mean).transpose();
  }
  spread /= static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const double thickness = std::sqrt(std::max(solver.eigenvalues()[0], 0.0));
  const double width = std::sqrt(solver.eigenvalues()[1]);
  // Three returns of one ring lie on a line: no plane.
  if (thickness > options_.max_thickness || width < 2.0 * thickness || width < 0.01) {
    return std::nullopt;
  }
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const double cosine = std::abs(normal.dot(bearing));
  if (cosine < std::cos(options_.max_incidence)) return std::nullopt;
  MeasuredDistance measured;
  measured.distance = normal.dot(mean) / normal.dot(bearing);
  if (std::abs(measured.distance - mean.norm()) > options_.depth_step * mean.norm()) {
    return std::nullopt;
  }
  measured.sigma = std::hypot(options_.sigma, thickness / cosine);
  return measured;
}

std::vector<std::optional<MeasuredDistance>> LidarDepth::Distances(
    const SE3& T_world_camera, Span<const Eigen::Vector3d> bearings) {
  Project(T_world_camera);
  std::vector<std::optional<MeasuredDistance>> distances;
  for (const Eigen::Vector3d& bearing : bearings) distances.push_back(DistanceOf(bearing));
  return distances;
}

}  // namespace regolith

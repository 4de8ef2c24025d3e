// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/terrain_posts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr size_t kBlockRows = 32;
// A rock narrower than this many spacings would be a single raised post, a spike.
constexpr double kRockPosts = 3.0;

// The triangle's plane over the posts that it covers, seen from above.
void RaiseTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   TerrainPosts* posts) {
  const double half = 0.5 * (posts->count - 1);
  const auto index = [&](double coordinate) { return coordinate / posts->spacing + half; };
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
  if (area <= 0.0) return;  // Seen from below, or edge on.
  const auto first = [&](double low) {
    return std::max(0, static_cast<int>(std::ceil(index(low))));
  };
  const auto last = [&](double high) {
    return std::min(posts->count - 1, static_cast<int>(std::floor(index(high))));
  };
  const auto [low_x, high_x] = std::minmax({a.x(), b.x(), c.x()});
  const auto [low_y, high_y] = std::minmax({a.y(), b.y(), c.y()});
  for (int j = first(low_y); j <= last(high_y); ++j) {
    for (int i = first(low_x); i <= last(high_x); ++i) {
      const double x = posts->Coordinate(i);
      const double y = posts->Coordinate(j);
      const double u = ((x - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (y - a.y())) / area;
      const double v = ((b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y())) / area;
      if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
      double& height = posts->heights[static_cast<size_t>(j) * static_cast<size_t>(posts->count) +
                                      static_cast<size_t>(i)];
      height = std::max(height, a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z()));
    }
  }
}

void RaiseRocks(const Surface& surface, const Eigen::Vector2d& centre, double height_shift,
                TerrainPosts* posts) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * posts->side());
  const auto rocks = surface.Rocks({centre - half, centre + half}, kRockPosts * posts->spacing);
  if (rocks.empty()) return;
  const std::vector<RockShape> shapes = surface.RockShapes();
  for (const Rock& rock : rocks) {
    const RockShape& shape = shapes[rock.shape];
    const Eigen::AngleAxisd turn(rock.yaw, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d place(rock.centre.x() - centre.x(), rock.centre.y() - centre.y(),
                                rock.ground + height_shift);
    const auto vertex = [&](uint32_t index) -> Eigen::Vector3d {
      return place + turn * (rock.diameter * shape.vertices[index].cast<double>());
    };
    for (const auto& triangle : shape.triangles) {
      RaiseTriangle(vertex(triangle[0]), vertex(triangle[1]), vertex(triangle[2]), posts);
    }
  }
}

}  // namespace

Eigen::Vector3d TerrainPosts::Normal(int i, int j) const {
  const int west = std::max(i - 1, 0);
  const int east = std::min(i + 1, count - 1);
  const int south = std::max(j - 1, 0);
  const int north = std::min(j + 1, count - 1);
  const double slope_x = (Height(east, j) - Height(west, j)) / ((east - west) * spacing);
  const double slope_y = (Height(i, north) - Height(i, south)) / ((north - south) * spacing);
  return Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized();
}

TerrainPosts SampleTerrain(const Surface& surface, const Eigen::Vector2d& centre, double side,
                           int count, double height_shift, ThreadPool* pool) {
  REGOLITH_CHECK(count >= 2 && side > 0.0, count, " posts over ", side, " m");
  TerrainPosts posts;
  posts.count = count;
  posts.spacing = side / (count - 1);
  const auto columns = static_cast<size_t>(count);
  posts.heights.resize(columns * columns);
  pool->ParallelFor(columns, kBlockRows, [&](size_t begin, size_t end, size_t) {
    PostBlock block;
    block.x = centre.x() + posts.Coordinate(0);
    block.y = centre.y() + posts.Coordinate(static_cast<int>(begin));
    block.spacing = posts.spacing;
    block.columns = count;
    block.rows = static_cast<int>(end - begin);
    std::vector<double> heights;
    std::vector<float> albedo;
    surface.Sample(block, &heights, &albedo);
    for (size_t i = 0; i < heights.size(); ++i) {
      posts.heights[begin * columns + i] = heights[i] + height_shift;
    }
  });
  RaiseRocks(surface, centre, height_shift, &posts);
  return posts;
}

HeightRange RangeOf(const TerrainPosts& posts) {
  const auto [lowest, highest] = std::minmax_element(posts.heights.begin(), posts.heights.end());
  return {*lowest, *highest};
}

Place FlattestPlace(const TerrainPosts& posts, double width) {
  const int reach = std::max(1, static_cast<int>(std::ceil(0.5 * width / posts.spacing)));
  const int low = std::max(posts.count / 4, reach);
  const int high = std::max(low, posts.count - 1 - low);
  const int step = std::max(1, (high - low) / 128);
  Place best;
  double least = std::numeric_limits<double>::infinity();
  for (int j = low; j <= high; j += step) {
    for (int i = low; i <= high; i += step) {
      double lowest = std::numeric_limits<double>::infinity();
      double highest = -lowest;
      for (int v = std::max(j - reach, 0); v <= std::min(j + reach, posts.count - 1); ++v) {
        for (int u = std::max(i - reach, 0); u <= std::min(i + reach, posts.count - 1); ++u) {
          lowest = std::min(lowest, posts.Height(u, v));
          highest = std::max(highest, posts.Height(u, v));
        }
      }
      if (highest - lowest >= least) continue;
      least = highest - lowest;
      best = {posts.Coordinate(std::min(i, posts.count - 1)),
              posts.Coordinate(std::min(j, posts.count - 1)), highest};
    }
  }
  return best;
}

}  // namespace regolith

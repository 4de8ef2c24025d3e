// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/mesh_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "regolith/core/check.h"

namespace regolith {
namespace {

struct Level {
  double distance;  // m from the path, up to which
  int factor;       // of the finest spacing
};

// A camera pixel and the lidar's beam grow with distance as these do.
constexpr std::array<Level, 4> kLevels = {{{6.0, 1}, {30.0, 4}, {60.0, 8}, {1e9, 40}}};

double DistanceToPath(const Eigen::Vector2d& point, Span<const Eigen::Vector2d> path) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& place : path) {
    nearest = std::min(nearest, (point - place).squaredNorm());
  }
  return std::sqrt(nearest);
}

double SpacingAt(double distance, double finest) {
  for (const Level& level : kLevels) {
    if (distance < level.distance) return finest * level.factor;
  }
  return finest * kLevels.back().factor;
}

void LayTiles(Span<const Eigen::Vector2d> path, const MeshOptions& options, MeshTiles* mesh) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& place : path) box.extend(place);
  const double size = MeshTiles::kTileSize;
  const Eigen::Array2d low = ((box.min().array() - options.reach) / size).floor();
  const Eigen::Array2d high = ((box.max().array() + options.reach) / size).ceil();
  mesh->corner = size * low.matrix();
  mesh->columns = static_cast<int>(high.x() - low.x());
  mesh->rows = static_cast<int>(high.y() - low.y());
  uint32_t first_post = 0;
  for (int row = 0; row < mesh->rows; ++row) {
    for (int column = 0; column < mesh->columns; ++column) {
      const Eigen::Vector2d centre = mesh->corner + size * Eigen::Vector2d(column + 0.5, row + 0.5);
      // The near side of the tile decides.
      const double distance = DistanceToPath(centre, path) - 0.7 * size;
      MeshTile tile;
      const double spacing = SpacingAt(distance, options.spacing);
      tile.spacing = static_cast<float>(spacing);
      tile.posts = static_cast<int>(std::lround(size / spacing)) + 1;
      tile.first_post = first_post;
      first_post += static_cast<uint32_t>(tile.posts * tile.posts);
      mesh->tiles.push_back(tile);
    }
  }
  mesh->positions.resize(first_post);
  mesh->positions.reserve(first_post + 1);
  mesh->shapes.resize(first_post);
}

// Samples one tile; its edges follow rules that its neighbours share.
class TileSampler {
 public:
  TileSampler(const Ground& ground, MeshTiles* mesh) : ground_(ground), mesh_(mesh) {}

  void Sample(int column, int row) {
    column_ = column;
    row_ = row;
    tile_ = mesh_->TileAt(column, row);
    SampleHeights();
    WritePosts();
    StitchEdge(0, 1, tile_.posts, column, row - 1);                                // south
    StitchEdge(tile_.posts * (tile_.posts - 1), 1, tile_.posts, column, row + 1);  // north
    StitchEdge(0, tile_.posts, tile_.posts, column - 1, row);                      // west
    StitchEdge(tile_.posts - 1, tile_.posts, tile_.posts, column + 1, row);        // east
  }

 private:
  // Heights with one more post all around, for slopes.
  void SampleHeights() {
    const int side = tile_.posts + 2;
    heights_.resize(static_cast<size_t>(side) * static_cast<size_t>(side));
    const double spacing = Spacing();
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        heights_[static_cast<size_t>(j) * static_cast<size_t>(side) + static_cast<size_t>(i)] =
            ground_.Height(X(i - 1), Y(j - 1), spacing);
      }
    }
  }

  void WritePosts() {
    const int side = tile_.posts + 2;
    const double spacing = Spacing();
    const auto height = [&](int i, int j) {
      return heights_[static_cast<size_t>(j + 1) * static_cast<size_t>(side) +
                      static_cast<size_t>(i + 1)];
    };
    size_t post = tile_.first_post;
    for (int j = 0; j < tile_.posts; ++j) {
      for (int i = 0; i < tile_.posts; ++i, ++post) {
        mesh_->positions[post] = Eigen::Vector3d(X(i), Y(j), height(i, j)).cast<float>();
        MeshTiles::Shape& shape = mesh_->shapes[post];
        shape.slope_x = static_cast<float>((height(i + 1, j) - height(i - 1, j)) / (2.0 * spacing));
        shape.slope_y = static_cast<float>((height(i, j + 1) - height(i, j - 1)) / (2.0 * spacing));
        shape.albedo = static_cast<float>(ground_.Albedo(X(i), Y(j), spacing));
      }
    }
  }

  // An edge has the posts and the relief of the coarser of its two tiles; its ends those of the
  // coarsest of four.
  void StitchEdge(int first, int stride, int posts, int other_column, int other_row) {
    const double own = Spacing();
    const double coarse = std::max(own, SpacingOf(other_column, other_row, own));
    const int step = static_cast<int>(std::lround(coarse / own));
    for (int knot = 0; knot < posts; knot += step) {
      const bool end = knot == 0 || knot == posts - 1;
      Eigen::Vector3f& position = Post(first + knot * stride);
      position.z() = static_cast<float>(
          ground_.Height(position.x(), position.y(), end ? CornerSpacing(position) : coarse));
    }
    for (int knot = 0; knot + step < posts; knot += step) {
      const float left = Post(first + knot * stride).z();
      const float right = Post(first + (knot + step) * stride).z();
      for (int k = 1; k < step; ++k) {
        const float fraction = static_cast<float>(k) / static_cast<float>(step);
        Post(first + (knot + k) * stride).z() = left + fraction * (right - left);
      }
    }
  }

  double CornerSpacing(const Eigen::Vector3f& corner) const {
    const int column =
        static_cast<int>(std::lround((corner.x() - mesh_->corner.x()) / MeshTiles::kTileSize));
    const int row =
        static_cast<int>(std::lround((corner.y() - mesh_->corner.y()) / MeshTiles::kTileSize));
    double coarsest = Spacing();
    for (const int c : {column - 1, column}) {
      for (const int r : {row - 1, row}) coarsest = std::max(coarsest, SpacingOf(c, r, coarsest));
    }
    return coarsest;
  }

  double SpacingOf(int column, int row, double otherwise) const {
    if (column < 0 || row < 0 || column >= mesh_->columns || row >= mesh_->rows) return otherwise;
    const MeshTile& tile = mesh_->TileAt(column, row);
    return MeshTiles::kTileSize / (tile.posts - 1);
  }

  double Spacing() const { return MeshTiles::kTileSize / (tile_.posts - 1); }
  // Rounded as the stored position, so that two tiles ask for the same place.
  double X(int i) const {
    return static_cast<float>(mesh_->corner.x() + column_ * MeshTiles::kTileSize + i * Spacing());
  }
  double Y(int j) const {
    return static_cast<float>(mesh_->corner.y() + row_ * MeshTiles::kTileSize + j * Spacing());
  }
  Eigen::Vector3f& Post(int index) {
    return mesh_->positions[tile_.first_post + static_cast<size_t>(index)];
  }

  const Ground& ground_;
  MeshTiles* mesh_;
  MeshTile tile_;
  int column_ = 0;
  int row_ = 0;
  std::vector<double> heights_;
};

}  // namespace

MeshTiles BuildMeshTiles(const Ground& ground, Span<const Eigen::Vector2d> path,
                         const MeshOptions& options, ThreadPool* pool) {
  REGOLITH_CHECK(!path.empty(), "a mesh needs a path");
  MeshTiles mesh;
  LayTiles(path, options, &mesh);
  constexpr size_t kChunk = 16;
  pool->ParallelFor(mesh.tiles.size(), kChunk, [&](size_t begin, size_t end, size_t) {
    TileSampler sampler(ground, &mesh);
    for (size_t i = begin; i < end; ++i) {
      sampler.Sample(static_cast<int>(i) % mesh.columns, static_cast<int>(i) / mesh.columns);
    }
  });
  return mesh;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "regolith/sim/ground.h"
#include "regolith/sim/surface_point.h"
#include "regolith/sim/tile_tree.h"

namespace regolith {

/// A square of ground: its posts for rays, and what light falls on them, in several resolutions.
class GroundTile {
 public:
  /// Posts along a side, and with the skirt that hangs down around the tile and hides the seams
  /// between tiles of different spacing.
  static constexpr int kPosts = kTileCells + 1;
  static constexpr int kSkirtPosts = kPosts + 2;
  /// Fill light is found at every kFillStep-th post.
  static constexpr int kFillStep = 8;
  static constexpr int kFillPosts = kTileCells / kFillStep + 1;

  /// Samples the ground. `corner` (m, world) is the tile's least x and y.
  GroundTile(const Ground& ground, const Eigen::Vector2d& corner, double spacing);

  /// kSkirtPosts² positions (m, world), row by row; one float more allocated, as Embree asks.
  const std::vector<Eigen::Vector3f>& positions() const { return positions_; }
  const Eigen::Vector3f& Post(int column, int row) const {
    const int post = (row + 1) * kSkirtPosts + column + 1;
    return positions_[static_cast<size_t>(post)];
  }
  /// The normal at a post, from its neighbours.
  Eigen::Vector3f Normal(int column, int row) const;
  float spacing() const { return spacing_; }

  bool Covers(float x, float y) const {
    const float size = static_cast<float>(kTileCells) * spacing_;
    return x >= corner_.x() && y >= corner_.y() && x < corner_.x() + size && y < corner_.y() + size;
  }

  /// `sunlit`: kPosts² shares of the sun's disc that are seen; the sun lies in direction `sun`.
  void SetSunlight(const std::vector<float>& sunlit, const Eigen::Vector3f& sun);
  /// `fill`: kFillPosts² values.
  void SetFill(std::vector<float> fill) { fill_ = std::move(fill); }

  /// The mean over a patch about (x, y), m, world: `width` m across, and `length` m along the unit
  /// vector `along` of the plane.
  SurfacePoint At(float x, float y, float width, float length, const Eigen::Vector2f& along) const;

 private:
  // Fixed point, eight bytes: memory is what a look waits for. `light` is what a square metre of
  // plan catches (sunlit share · cosine of incidence / normal.z): its mean does not change with the
  // posts' spacing.
  struct alignas(8) Texel {
    int16_t slope_x = 0;
    int16_t slope_y = 0;
    int16_t albedo = 0;
    int16_t light = 0;
  };
  typedef int16_t TexelVector __attribute__((vector_size(8)));
  typedef float Sum __attribute__((vector_size(16)));
  static constexpr int kMips = 5;

  static constexpr int MipPosts(int mip) { return (kTileCells >> mip) + 1; }
  Texel* Mip(int mip) { return texels_.data() + mip_starts_[mip]; }
  const Texel* Mip(int mip) const { return texels_.data() + mip_starts_[mip]; }
  void Average(int mip);
  float FillAt(float i, float j) const;
  void AddBilinear(int mip, float i, float j, float weight, Sum* sum) const;

  Eigen::Vector2f corner_;
  float spacing_;
  std::vector<Eigen::Vector3f> positions_;
  std::vector<Texel> texels_;  ///< mips, finest first
  int mip_starts_[kMips];
  std::vector<float> fill_;  ///< kFillPosts²
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/ground_tile.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace regolith {
namespace {

constexpr float kSlopeScale = 8192.0F;  // slopes up to 4
constexpr float kAlbedoScale = 32767.0F;
constexpr float kLightScale = 8191.0F;  // up to 4: a cliff that faces a low sun
constexpr double kSkirtDepth = 1.5;     // of the spacing
constexpr int kMostTaps = 4;

int16_t PackSlope(double slope) {
  return static_cast<int16_t>(std::lround(std::clamp(slope, -3.9, 3.9) * kSlopeScale));
}

int16_t Pack(float value, float scale) {
  return static_cast<int16_t>(std::clamp(value * scale + 0.5F, 0.0F, 32767.0F));
}

}  // namespace

GroundTile::GroundTile(const Ground& ground, const Eigen::Vector2d& corner, double spacing)
    : corner_(corner.cast<float>()),
      spacing_(static_cast<float>(spacing)),
      fill_(static_cast<size_t>(kFillPosts * kFillPosts), 0.0F) {
  int start = 0;
  for (int mip = 0; mip < kMips; ++mip) {
    mip_starts_[mip] = start;
    start += MipPosts(mip) * MipPosts(mip);
  }
  texels_.resize(static_cast<size_t>(start));
  // One post more on each side, for slopes.
  PostBlock block;
  block.x = corner.x() - spacing;
  block.y = corner.y() - spacing;
  block.spacing = spacing;
  block.columns = kSkirtPosts;
  block.rows = kSkirtPosts;
  std::vector<double> heights;
  std::vector<float> albedo;
  ground.Sample(block, &heights, &albedo);
  positions_.reserve(heights.size() + 1);
  const double depth = kSkirtDepth * spacing;
  for (int j = 0; j < kSkirtPosts; ++j) {
    for (int i = 0; i < kSkirtPosts; ++i) {
      const int column = std::clamp(i, 1, kPosts);
      const int row = std::clamp(j, 1, kPosts);
      const double height = heights[static_cast<size_t>(row * kSkirtPosts + column)];
      const bool skirt = column != i || row != j;
      positions_.emplace_back(static_cast<float>(block.x + column * spacing),
                              static_cast<float>(block.y + row * spacing),
                              static_cast<float>(skirt ? height - depth : height));
    }
  }
  const double half = 0.5 / spacing;
  for (int j = 0; j < kPosts; ++j) {
    for (int i = 0; i < kPosts; ++i) {
      const auto post = static_cast<size_t>((j + 1) * kSkirtPosts + i + 1);
      Texel& texel = texels_[static_cast<size_t>(j * kPosts + i)];
      texel.slope_x = PackSlope(half * (heights[post + 1] - heights[post - 1]));
      texel.slope_y = PackSlope(half * (heights[post + kSkirtPosts] - heights[post - kSkirtPosts]));
      texel.albedo = Pack(albedo[post], kAlbedoScale);
    }
  }
}

Eigen::Vector3f GroundTile::Normal(int column, int row) const {
  const Texel& texel = texels_[static_cast<size_t>(row * kPosts + column)];
  return Eigen::Vector3f(-texel.slope_x / kSlopeScale, -texel.slope_y / kSlopeScale, 1.0F)
      .normalized();
}

void GroundTile::SetSunlight(const std::vector<float>& sunlit, const Eigen::Vector3f& sun) {
  for (size_t i = 0; i < sunlit.size(); ++i) {
    Texel& texel = texels_[i];
    // (normal · sun) / normal.z
    const float caught =
        sun.z() - (texel.slope_x * sun.x() + texel.slope_y * sun.y()) / kSlopeScale;
    texel.light = Pack(sunlit[i] * std::max(caught, 0.0F), kLightScale);
  }
  for (int mip = 1; mip < kMips; ++mip) Average(mip);
}

float GroundTile::FillAt(float i, float j) const {
  constexpr float kLast = kFillPosts - 1;
  const float u = std::clamp(i / kFillStep, 0.0F, kLast);
  const float v = std::clamp(j / kFillStep, 0.0F, kLast);
  const int column = std::min(static_cast<int>(u), kFillPosts - 2);
  const int row = std::min(static_cast<int>(v), kFillPosts - 2);
  const float a = u - static_cast<float>(column);
  const float b = v - static_cast<float>(row);
  const float* low = &fill_[static_cast<size_t>(row * kFillPosts + column)];
  const float* high = low + kFillPosts;
  return (1.0F - b) * ((1.0F - a) * low[0] + a * low[1]) + b * ((1.0F - a) * high[0] + a * high[1]);
}

// A tent over the finer texels, kept inside the tile.
void GroundTile::Average(int mip) {
  const int posts = MipPosts(mip);
  const int finer_posts = MipPosts(mip - 1);
  const Texel* finer = Mip(mip - 1);
  Texel* texels = Mip(mip);
  for (int j = 0; j < posts; ++j) {
    for (int i = 0; i < posts; ++i) {
      int slope_x = 0;
      int slope_y = 0;
      int albedo = 0;
      int light = 0;
      for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
          const int weight = (di == 0 ? 2 : 1) * (dj == 0 ? 2 : 1);
          const int column = std::clamp(2 * i + di, 0, finer_posts - 1);
          const int row = std::clamp(2 * j + dj, 0, finer_posts - 1);
          const Texel& texel = finer[row * finer_posts + column];
          slope_x += weight * texel.slope_x;
          slope_y += weight * texel.slope_y;
          albedo += weight * texel.albedo;
          light += weight * texel.light;
        }
      }
      Texel& texel = texels[j * posts + i];
      texel.slope_x = static_cast<int16_t>(slope_x / 16);
      texel.slope_y = static_cast<int16_t>(slope_y / 16);
      texel.albedo = static_cast<int16_t>(albedo / 16);
      texel.light = static_cast<int16_t>(light / 16);
    }
  }
}

void GroundTile::AddBilinear(int mip, float i, float j, float weight, Sum* sum) const {
  const int posts = MipPosts(mip);
  const float last = static_cast<float>(posts - 1);
  i = std::clamp(i, 0.0F, last);
  j = std::clamp(j, 0.0F, last);
  const int column = std::min(static_cast<int>(i), posts - 2);
  const int row = std::min(static_cast<int>(j), posts - 2);
  const float a = i - static_cast<float>(column);
  const float b = weight * (j - static_cast<float>(row));
  const Texel* low = Mip(mip) + row * posts + column;
  const Texel* high = low + posts;
  const float w11 = a * b;
  const float w01 = b - w11;
  const float w10 = a * (weight - b);
  const float w00 = (weight - b) - w10;
  const auto at = [](const Texel* texel) {
    TexelVector vector;
    std::memcpy(&vector, texel, sizeof(vector));
    return __builtin_convertvector(vector, Sum);
  };
  *sum += w00 * at(low) + w10 * at(low + 1) + w01 * at(high) + w11 * at(high + 1);
}

SurfacePoint GroundTile::At(float x, float y, float width, float length,
                            const Eigen::Vector2f& along) const {
  const float scale = 1.0F / spacing_;
  const float i = scale * (x - corner_.x());
  const float j = scale * (y - corner_.y());
  const int taps = std::clamp(static_cast<int>(length / (1.5F * width)), 1, kMostTaps);
  // What the taps leave between them is filtered by a coarser mip.
  const float patch = std::max(width, length / (1.5F * kMostTaps));
  const float lod = std::clamp(std::log2(std::max(scale * patch, 1.0F)), 0.0F, kMips - 1.001F);
  int mip = static_cast<int>(lod);
  float coarser = lod - static_cast<float>(mip);
  // Several taps blend enough, and a mip that hardly counts is not looked up.
  const float sure = taps > 1 ? 0.5F : 0.95F;
  if (coarser > sure) ++mip;
  if (taps > 1 || coarser < 0.05F || coarser > sure) coarser = 0.0F;
  const float share = 1.0F / static_cast<float>(taps);
  const float step = scale * length * share;
  const float texels = 1.0F / static_cast<float>(1 << mip);
  Sum sum = {};
  for (int tap = 0; tap < taps; ++tap) {
    const float offset = step * (static_cast<float>(tap) - 0.5F * static_cast<float>(taps - 1));
    const float u = texels * (i + offset * along.x());
    const float v = texels * (j + offset * along.y());
    AddBilinear(mip, u, v, share * (1.0F - coarser), &sum);
    if (coarser > 0.0F) AddBilinear(mip + 1, 0.5F * u, 0.5F * v, share * coarser, &sum);
  }
  SurfacePoint point;
  point.normal = Eigen::Vector3f(-sum[0] / kSlopeScale, -sum[1] / kSlopeScale, 1.0F).normalized();
  point.albedo = sum[2] / kAlbedoScale;
  point.light = point.normal.z() * sum[3] / kLightScale;
  point.fill = FillAt(i, j);
  return point;
}

}  // namespace regolith

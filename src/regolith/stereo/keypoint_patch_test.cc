// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/keypoint_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr int kSize = 64;
const Eigen::Vector2f kPlace(31.3F, 30.8F);

/// Waves of random length and direction.
class Texture {
 public:
  explicit Texture(uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < 30; ++i) {
      const double length = random.Uniform(5.0, 25.0);
      const double direction = random.Uniform(0.0, 6.28);
      waves_.push_back({6.28 / length * std::cos(direction), 6.28 / length * std::sin(direction),
                        random.Uniform(0.0, 6.28)});
    }
  }

  double At(const Eigen::Vector2d& place) const {
    double sum = 0.0;
    for (const Eigen::Vector3d& wave : waves_) {
      sum += std::sin(wave.head<2>().dot(place) + wave.z());
    }
    return sum;
  }

 private:
  std::vector<Eigen::Vector3d> waves_;
};

/// The texture as seen where `place` in the image shows `kPlace` of the texture and steps are
/// turned into the texture's by `by_step`; it brightens by `slope` grey levels a pixel.
Image Seen(const Texture& texture, const Eigen::Vector2f& place, const Eigen::Matrix2f& by_step,
           double gain = 8.0, double offset = 128.0,
           const Eigen::Vector2f& slope = Eigen::Vector2f::Zero()) {
  Image image{kSize, kSize, std::vector<uint8_t>(kSize * kSize)};
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const Eigen::Vector2f step =
          Eigen::Vector2f(static_cast<float>(column), static_cast<float>(row)) - place;
      const double grey = offset + gain * texture.At((kPlace + by_step * step).cast<double>()) +
                          static_cast<double>(slope.dot(step));
      image.data[static_cast<size_t>(row * kSize + column)] =
          static_cast<uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  return image;
}

struct Found {
  std::optional<Eigen::Vector2f> place;
  Eigen::Vector2f wanted;
};

/// Detected `error` beside the place.
Found AlignSeen(const Eigen::Matrix2f& by_step, const Eigen::Vector2f& error, double gain,
                double max_step = 2.5) {
  const Texture texture(3);
  const Eigen::Vector2f wanted(29.6F, 33.1F);
  const Image first = Seen(texture, kPlace, Eigen::Matrix2f::Identity());
  const Image second = Seen(texture, wanted, by_step, gain, 100.0);
  const Eigen::Vector2f detected = wanted + error;
  return {AlignPatch(CutPatch(first, kPlace), kPlace, CutPatch(second, detected), detected, by_step,
                     0.8, max_step),
          wanted};
}

TEST(KeypointPatch, TheSamePlaceIsFoundToAFewHundredthsOfAPixel) {
  Eigen::Matrix2f nearer;
  nearer << 0.75F, 0.06F, -0.05F, 0.65F;
  for (const Eigen::Matrix2f& by_step : {Eigen::Matrix2f::Identity().eval(), nearer}) {
    for (const Eigen::Vector2f& error : {Eigen::Vector2f(0.0F, 0.0F), Eigen::Vector2f(1.1F, -0.7F),
                                         Eigen::Vector2f(-0.4F, 1.3F)}) {
      // Another exposure.
      const Found found = AlignSeen(by_step, error, 5.0);
      ASSERT_TRUE(found.place) << by_step << "\n" << error;
      EXPECT_LT((*found.place - found.wanted).norm(), 0.07F) << by_step << "\n" << error;
    }
  }
}

TEST(KeypointPatch, LightThatGoesAlongWithTheRoverDoesNotPullThePlace) {
  // A rover's halo lies on other ground with every metre: opposite slopes in both images.
  const Eigen::Vector2f wanted(29.6F, 33.1F);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Texture texture(seed);
    const Eigen::Matrix2f same = Eigen::Matrix2f::Identity();
    const Image first = Seen(texture, kPlace, same, 3.0, 128.0, {0.9F, -0.6F});
    const Image second = Seen(texture, wanted, same, 3.0, 128.0, {-0.9F, 0.6F});
    const auto place = AlignPatch(CutPatch(first, kPlace), kPlace, CutPatch(second, wanted), wanted,
                                  same, 0.8, 2.5);
    ASSERT_TRUE(place) << seed;
    EXPECT_LT((*place - wanted).norm(), 0.1F) << seed;
  }
}

TEST(KeypointPatch, WhatIsTooFarAwayIsNotFound) {
  const Eigen::Vector2f error(1.3F, -1.0F);
  EXPECT_TRUE(AlignSeen(Eigen::Matrix2f::Identity(), error, 8.0, 1.8).place);
  EXPECT_FALSE(AlignSeen(Eigen::Matrix2f::Identity(), error, 8.0, 1.5).place);
}

TEST(KeypointPatch, OtherGroundIsNotFound) {
  int found = 0;
  for (uint64_t seed = 10; seed < 40; ++seed) {
    const Image first = Seen(Texture(seed), kPlace, Eigen::Matrix2f::Identity());
    const Image second = Seen(Texture(seed + 100), kPlace, Eigen::Matrix2f::Identity());
    const auto place = AlignPatch(CutPatch(first, kPlace), kPlace, CutPatch(second, kPlace), kPlace,
                                  Eigen::Matrix2f::Identity(), 0.8, 2.5);
    found += place ? 1 : 0;
  }
  EXPECT_LE(found, 1);
}

TEST(KeypointPatch, WhatHasNoTextureSaysNothing) {
  const Texture texture(3);
  for (const double gain : {0.0, 0.05}) {
    const Image flat = Seen(texture, kPlace, Eigen::Matrix2f::Identity(), gain);
    const KeypointPatch patch = CutPatch(flat, kPlace);
    EXPECT_FALSE(AlignPatch(patch, kPlace, patch, kPlace, Eigen::Matrix2f::Identity(), 0.8, 2.5));
  }
  // An edge says nothing of the place along it.
  Image edge{kSize, kSize, std::vector<uint8_t>(kSize * kSize, 40)};
  for (int row = 0; row < kSize; ++row) {
    std::fill_n(edge.data.begin() + row * kSize + kSize / 2, kSize / 2, uint8_t{200});
  }
  const KeypointPatch patch = CutPatch(edge, kPlace);
  EXPECT_FALSE(AlignPatch(patch, kPlace, patch, kPlace, Eigen::Matrix2f::Identity(), 0.8, 2.5));
}

TEST(KeypointPatch, BeyondTheImageItsEdgeIsRepeated) {
  Image image{3, 2, {1, 2, 3, 4, 5, 6}};
  const KeypointPatch patch = CutPatch(image, {2.2F, 0.6F});
  EXPECT_EQ(patch.centre, Eigen::Vector2i(2, 1));
  const auto grey = [&](int column, int row) {
    return patch.grey[static_cast<size_t>((row + KeypointPatch::kReach) * KeypointPatch::kSide +
                                          column + KeypointPatch::kReach)];
  };
  EXPECT_EQ(grey(0, 0), 6);
  EXPECT_EQ(grey(-1, -1), 2);
  EXPECT_EQ(grey(-9, -9), 1);
  EXPECT_EQ(grey(5, 5), 6);
}

}  // namespace
}  // namespace regolith

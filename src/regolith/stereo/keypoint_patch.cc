// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/keypoint_patch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace regolith {
namespace {

constexpr int kHalf = 5;  // pixels, of the square that is compared
constexpr int kCompared = 2 * kHalf + 1;
constexpr int kIterations = 10;
constexpr float kConverged = 0.01F;      // pixels
constexpr float kLeastDeviation = 1.5F;  // grey levels, of a square with texture
// Of the contrast-free square's gradients: the weaker direction, a pixel.
constexpr float kLeastInformation = 0.01F;

using Square = Eigen::Array<float, kCompared, kCompared>;
using Framed = Eigen::Array<float, kCompared + 2, kCompared + 2>;

/// Bilinear; `place` is in pixels from the patch's first.
float Sample(const KeypointPatch& patch, float column, float row) {
  const int left = static_cast<int>(column);
  const int top = static_cast<int>(row);
  const float u = column - static_cast<float>(left);
  const float v = row - static_cast<float>(top);
  const uint8_t* grey =
      patch.grey.data() + static_cast<ptrdiff_t>(top) * KeypointPatch::kSide + left;
  const float upper = static_cast<float>(grey[0]) * (1.0F - u) + static_cast<float>(grey[1]) * u;
  grey += KeypointPatch::kSide;
  const float lower = static_cast<float>(grey[0]) * (1.0F - u) + static_cast<float>(grey[1]) * u;
  return upper * (1.0F - v) + lower * v;
}

/// The square of (2 half + 1)² pixels around a place of the patch, its axes turned and scaled;
/// false where it reaches beyond the patch.
template <typename Values>
bool SampleSquare(const KeypointPatch& patch, const Eigen::Vector2f& place,
                  const Eigen::Matrix2f& by_step, Values* values) {
  constexpr int kReach = (Values::RowsAtCompileTime - 1) / 2;
  constexpr auto kLast = static_cast<float>(KeypointPatch::kSide - 1);
  const Eigen::Vector2f centre =
      place - patch.centre.cast<float>() + Eigen::Vector2f::Constant(KeypointPatch::kReach);
  const Eigen::Vector2f extent =
      by_step.cwiseAbs() * Eigen::Vector2f::Constant(static_cast<float>(kReach));
  if ((centre - extent).minCoeff() < 0.0F || (centre + extent).maxCoeff() >= kLast) return false;
  for (int row = -kReach; row <= kReach; ++row) {
    for (int column = -kReach; column <= kReach; ++column) {
      const Eigen::Vector2f at =
          centre + by_step * Eigen::Vector2f(static_cast<float>(column), static_cast<float>(row));
      (*values)(row + kReach, column + kReach) = Sample(patch, at.x(), at.y());
    }
  }
  return true;
}

/// Takes the plane through the values away: what changes slowly across the square may go along with
/// the camera, and would pull the place with it.
void RemovePlane(Square* square) {
  static const Square kColumns =
      Eigen::Array<float, 1, kCompared>::LinSpaced(-kHalf, kHalf).replicate<kCompared, 1>();
  static const Square kRows = kColumns.transpose();
  static const float kSpread = kColumns.square().mean();
  *square -= square->mean();
  const float by_column = (*square * kColumns).mean() / kSpread;
  const float by_row = (*square * kRows).mean() / kSpread;
  *square -= by_column * kColumns + by_row * kRows;
}

/// Takes plane and contrast away; gives the contrast (standard deviation, grey levels), or nothing
/// where that is too little.
std::optional<float> Normalise(Square* square) {
  RemovePlane(square);
  const float deviation = std::sqrt(square->square().mean());
  if (deviation < kLeastDeviation) return std::nullopt;
  *square /= deviation;
  return deviation;
}

}  // namespace

KeypointPatch CutPatch(const Image& image, const Eigen::Vector2f& place) {
  KeypointPatch patch;
  patch.centre = {static_cast<int>(std::lround(place.x())),
                  static_cast<int>(std::lround(place.y()))};
  auto* target = patch.grey.data();
  for (int dy = -KeypointPatch::kReach; dy <= KeypointPatch::kReach; ++dy) {
    const int row = std::clamp(patch.centre.y() + dy, 0, image.height - 1);
    const uint8_t* source = image.data.data() + static_cast<ptrdiff_t>(row) * image.width;
    for (int dx = -KeypointPatch::kReach; dx <= KeypointPatch::kReach; ++dx) {
      *target++ = source[std::clamp(patch.centre.x() + dx, 0, image.width - 1)];
    }
  }
  return patch;
}

std::optional<Eigen::Vector2f> AlignPatch(const KeypointPatch& first,
                                          const Eigen::Vector2f& first_place,
                                          const KeypointPatch& second,
                                          const Eigen::Vector2f& second_place,
                                          const Eigen::Matrix2f& first_by_second,
                                          double min_correlation, double max_step) {
  Framed framed;
  if (!SampleSquare(first, first_place, first_by_second, &framed)) return std::nullopt;
  Square wanted = framed.block<kCompared, kCompared>(1, 1);
  const std::optional<float> contrast = Normalise(&wanted);
  if (!contrast) return std::nullopt;
  Square by_column =
      (framed.block<kCompared, kCompared>(1, 2) - framed.block<kCompared, kCompared>(1, 0)) *
      (0.5F / *contrast);
  Square by_row =
      (framed.block<kCompared, kCompared>(2, 1) - framed.block<kCompared, kCompared>(0, 1)) *
      (0.5F / *contrast);
  RemovePlane(&by_column);
  RemovePlane(&by_row);
  Eigen::Matrix2f information;
  information << by_column.square().mean(), (by_column * by_row).mean(),
      (by_column * by_row).mean(), by_row.square().mean();
  const float half_trace = 0.5F * information.trace();
  const float weaker =
      half_trace - std::sqrt(std::max(half_trace * half_trace - information.determinant(), 0.0F));
  if (weaker < kLeastInformation) return std::nullopt;
  const Eigen::Matrix2f inverse = information.inverse();

  Eigen::Vector2f place = second_place;
  Square seen;
  for (int i = 0; i < kIterations; ++i) {
    if (!SampleSquare(second, place, Eigen::Matrix2f::Identity(), &seen)) return std::nullopt;
    if (!Normalise(&seen)) return std::nullopt;
    const Square difference = seen - wanted;
    const Eigen::Vector2f step =
        -inverse * Eigen::Vector2f((by_column * difference).mean(), (by_row * difference).mean());
    place += step;
    if ((place - second_place).norm() > static_cast<float>(max_step)) return std::nullopt;
    if (step.norm() < kConverged) break;
  }
  if ((seen * wanted).mean() < static_cast<float>(min_correlation)) return std::nullopt;
  return place;
}

}  // namespace regolith

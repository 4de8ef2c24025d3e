// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/terrain/crater_profile.h"
#include "regolith/terrain/post_block.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

struct Crater {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m
  double diameter = 1.0;                             ///< m, rim to rim, mean over the directions
  float depth = 0.1F;                                ///< depth / diameter, rim crest to floor
  float freshness = 1.0F;  ///< depth as a share of what it was when it formed
  /// Fourier coefficients of the radius over the direction: cos 2θ, sin 2θ, cos 3θ, sin 3θ.
  float outline[4] = {0.0F, 0.0F, 0.0F, 0.0F};
};

/// The largest departure of a crater's radius from its mean, as a share.
inline constexpr double kCraterIrregularity = 0.1;

/// The height (m) that a crater adds at `offset` m from its centre; zero beyond kCraterReach
/// radii. Once continuously differentiable.
double CraterHeight(const Crater& crater, const Eigen::Vector2d& offset);

/// Craters wider than `diameter` m, a m².
double CraterDensity(const CraterOptions& options, double diameter);

/// Depth / diameter of a fresh crater `diameter` m wide.
double FreshCraterDepth(const CraterOptions& options, double diameter);

/// Craters of a box and, as far as they are wide, around it: those that can be seen from inside.
/// Their places depend on the seed alone, not on the box: boxes that overlap agree.
class CraterField {
 public:
  /// Craters of diameter D lie up to 100 D, but no farther than `surroundings` m, outside the box.
  CraterField(const CraterOptions& options, uint64_t seed, const Eigen::AlignedBox2d& box,
              double surroundings = 0.0);

  /// Sum of the craters' heights at (x, y) in m, of craters at least `min_diameter` m wide.
  double Height(double x, double y, double min_diameter) const;

  /// Adds Height of every post of `block` to `heights`, looking at each crater once.
  void AddTo(const PostBlock& block, double min_diameter, double* heights) const;

  /// How much of fresh craters' ejecta lies at (x, y): the sum over the craters at least
  /// `min_diameter` m wide of freshness³ · (distance / radius)^-3, little of it inside the rim.
  double Ejecta(double x, double y, double min_diameter) const;

  size_t size() const { return size_; }
  double MeanDepth() const;  ///< of depth / diameter

 private:
  /// Craters whose diameters lie within a factor of two, in a lattice of bins by their centres. A
  /// bin is twice as wide as they reach, so that a point needs at most four of them.
  struct Class {
    double max_diameter = 0.0;
    double reach = 1.0;  ///< m
    Eigen::Vector2d corner = Eigen::Vector2d::Zero();
    int columns = 0;
    int rows = 0;
    std::vector<uint32_t> starts;  ///< bins + 1
    std::vector<Crater> craters;   ///< bin by bin
  };
  static Class MakeClass(const std::vector<Crater>& craters, double max_diameter,
                         const Eigen::AlignedBox2d& box);
  void AddExtra(const CraterOptions& options);

  /// Calls visit(crater) for every crater at least `min_diameter` m wide that may reach `box`.
  template <typename Visitor>
  void Visit(const Eigen::AlignedBox2d& box, double min_diameter, const Visitor& visit) const;

  std::vector<Class> classes_;
  size_t size_ = 0;
};

}  // namespace regolith

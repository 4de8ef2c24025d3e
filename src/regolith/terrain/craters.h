// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/terrain/terrain_options.h"

namespace regolith {

struct Crater {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m
  double diameter = 1.0;                             ///< m, rim to rim
  double depth = 0.1;                                ///< depth / diameter, rim crest to floor
  double rim = 0.0;                                  ///< rim height / diameter
};

/// The height (m) that a crater adds at `distance` m from its centre; zero beyond kCraterReach
/// radii. Once continuously differentiable.
double CraterHeight(const Crater& crater, double distance);

inline constexpr double kCraterReach = 2.2;

/// Craters of a box and, as far as they are wide, around it: those that can be seen from inside.
/// Their places depend on the seed alone, not on the box: boxes that overlap agree.
class CraterField {
 public:
  /// Craters of diameter D lie up to 100 D, but no farther than `surroundings` m, outside the box.
  CraterField(const CraterOptions& options, uint64_t seed, const Eigen::AlignedBox2d& box,
              double surroundings = 0.0);

  /// Sum of the craters' heights at (x, y) in m, of craters at least `min_diameter` m wide.
  double Height(double x, double y, double min_diameter) const;

  size_t size() const { return size_; }

 private:
  /// Craters whose diameters lie within a factor of two, in a lattice of bins; each crater stands
  /// in every bin that it reaches, so that one bin answers for a point.
  struct Class {
    double max_diameter = 0.0;
    double bin_size = 1.0;
    Eigen::Vector2d corner = Eigen::Vector2d::Zero();
    int columns = 0;
    int rows = 0;
    std::vector<uint32_t> starts;  ///< bins + 1
    std::vector<Crater> craters;   ///< bin by bin
  };
  static Class MakeClass(const std::vector<Crater>& craters, double max_diameter,
                         const Eigen::AlignedBox2d& box);

  std::vector<Class> classes_;
  size_t size_ = 0;
};

}  // namespace regolith

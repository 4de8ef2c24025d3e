// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "regolith/terrain/craters.h"
#include "regolith/terrain/rock.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// Rocks wider than `diameter` m, a m², by the options' law.
double RockDensity(const RockOptions& options, double diameter);

/// The rocks of a plane. Depends on seed and place alone.
class RockField {
 public:
  /// Ejecta of `craters` gather rocks; `box` (m) is where their mean is taken, so that the law
  /// holds on the sum. Keeps a reference to `craters`.
  RockField(const RockOptions& options, uint64_t seed, const CraterField& craters,
            const Eigen::AlignedBox2d& box);

  /// Those at least `min_diameter` m wide whose centres lie in `box`, their `ground` left at 0.
  std::vector<Rock> Rocks(const Eigen::AlignedBox2d& box, double min_diameter) const;

  /// How much denser rocks lie at (x, y) than on average.
  double Intensity(double x, double y) const;

 private:
  void DrawCell(uint64_t cell_seed, const Eigen::AlignedBox2d& cell, double low, double high,
                std::vector<Rock>* rocks) const;

  RockOptions options_;
  uint64_t seed_;
  const CraterField* craters_;
  double mean_ejecta_ = 0.0;
};

}  // namespace regolith

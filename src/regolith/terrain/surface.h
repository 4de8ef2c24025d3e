// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/terrain/height_grid.h"
#include "regolith/terrain/post_block.h"
#include "regolith/terrain/rock.h"
#include "regolith/terrain/surface_report.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// The ground as a function of place. Frame `map`: x east, y north, z up, m.
class Surface {
 public:
  virtual ~Surface() = default;

  /// Height (m) at (x, y), of all relief that posts `spacing` m apart can carry; 0 gives all.
  virtual double Height(double x, double y, double spacing) const = 0;

  /// Normal albedo at (x, y), likewise.
  virtual double Albedo(double x, double y, double spacing) const = 0;

  /// Heights (m) and normal albedo of all posts of a block, as Height and Albedo give them (to
  /// 1e-5 m and 1e-4), much faster.
  virtual void Sample(const PostBlock& block, std::vector<double>* heights,
                      std::vector<float>* albedo) const;

  /// The rocks at least `min_diameter` m wide whose centres lie in `box` (m). Depends on the place
  /// alone: boxes that overlap agree, and so do diameters.
  virtual std::vector<Rock> Rocks(const Eigen::AlignedBox2d& box, double min_diameter) const;

  /// The meshes that Rock::shape counts.
  virtual std::vector<RockShape> RockShapes() const;

  /// Whether the ground within `margin` m of (x, y) is known: inside the elevation model and not
  /// one of its holes. Generated ground is known everywhere in its box.
  virtual bool Known(double x, double y, double margin) const = 0;

  /// The box in which a path may be looked for, m.
  virtual Eigen::AlignedBox2d box() const = 0;

  /// What its relief was made of.
  virtual SurfaceReport Report() const;
};

/// Ground generated from statistics: self-affine relief and craters, scaled together so that the
/// slopes over 1 m have the figure asked for. `box` (m) is where a path may lie.
std::unique_ptr<Surface> CreateGeneratedSurface(const TerrainOptions& options, uint64_t seed,
                                                const Eigen::AlignedBox2d& box);

/// Ground of an elevation model, with relief, craters and ripples added below its effective
/// resolution only: they go on from the model's own relief to the slopes of the statistics over 1 m
/// (dem_relief.h). The origin lies in its centre. Throws InputError for a model without data.
std::unique_ptr<Surface> CreateDemSurface(const HeightGrid& dem, const TerrainOptions& options,
                                          uint64_t seed);

/// Heights of the top of `surface`, rocks included, over `box` at posts `spacing` m apart;
/// coordinates are shifted by -`origin` (m, x y z), so that a terrain can be written in the frame
/// of a path.
HeightGrid SampleSurface(const Surface& surface, const Eigen::AlignedBox2d& box, double spacing,
                         const Eigen::Vector3d& origin);

}  // namespace regolith

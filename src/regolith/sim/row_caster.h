// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/sim/terrain_mesh.h"

namespace regolith {

/// The rays of one line of an image and how far each sees.
struct RayRow {
  std::vector<Eigen::Vector3f> directions;  ///< unit vectors, world
  std::vector<float> distances;             ///< m; infinite where nothing is met
};

/// Casts the rays of image lines from one place. Ground without a crest between two rays has an
/// inverse distance that is linear in the image (exactly so for a plane), so a ray between two that
/// nearly agree is interpolated: a quarter of the rays give the same picture.
class RowCaster {
 public:
  RowCaster(const TerrainMesh& mesh, const Eigen::Vector3f& origin)
      : mesh_(mesh), origin_(origin) {}

  /// Casts every second ray and what cannot be interpolated between them.
  void CastSparse(RayRow* row) const;

  /// Interpolates between the lines above and below, and casts the rest.
  void CastBetween(const RayRow& above, const RayRow& below, RayRow* row) const;

 private:
  void CastColumns(Span<const int> columns, RayRow* row) const;

  const TerrainMesh& mesh_;
  Eigen::Vector3f origin_;
};

}  // namespace regolith

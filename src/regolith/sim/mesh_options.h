// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// How finely the ground is meshed: posts of `spacing` near the path, each ring outwards twice as
/// far apart; and how its light is cast.
struct MeshOptions {
  double spacing = 0.005;  ///< m; 0.005, 0.01, 0.02 or 0.04
  double reach = 1000.0;   ///< m, from the path to the ground's border
  bool interreflection =
      true;  ///< shadows are filled by light from lit ground around, not sky only
};

}  // namespace regolith

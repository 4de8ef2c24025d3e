// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace regolith {

struct TerrainArguments {
  std::string dem;                   ///< elevation model; empty generates the ground
  std::string statistics;            ///< moon or mars; empty takes the body that the model names
  std::vector<int> crop;             ///< centre column, centre row, side in pixels; or empty
  double side = 256.0;               ///< m, of generated ground
  double pixel = 0.25;               ///< m, of generated ground
  int mesh_posts = 1025;             ///< posts a side of height map and meshes
  std::vector<std::string> exports;  ///< of heightmap, dae, obj, sdf, urdf
  std::optional<uint64_t> seed;      ///< instead of the scenario's
  bool repair = false;               ///< fill what the elevation model lacks
  std::vector<std::string> set;      ///< key=value over the scenario's
  std::string config;                ///< YAML over the scenario
  std::string out;
  bool overwrite = false;
  bool quiet = false;
  int threads = 2;
};

/// `regolith terrain`: reads or generates ground, says what it is, and writes terrain.tif,
/// terrain.yaml, summary.json, preview.png and the exports asked for. Returns the exit code.
int Terrain(const TerrainArguments& arguments);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "regolith/apps/reproduce_cells.h"
#include "regolith/report/document.h"

namespace regolith {

/// All cells of one scene and seed.
struct SceneResults {
  Scene scene;
  uint64_t seed = 1;
  std::vector<TrackCell> tracks;                ///< one a method of the plan
  std::vector<std::vector<MatchCell>> matches;  ///< one list a method of the plan
};

/// Table 1 of one scene: medians over its image pairs under the same sun, or under another. No
/// rows where there is no such pair.
DocumentTable MatchTable(const ReproducePlan& plan, const std::vector<SceneResults>& results,
                         const Scene& scene, bool same_sun);

/// Table 2 of one scene: medians over the seeds and their spread.
DocumentTable ErrorTable(const ReproducePlan& plan, const std::vector<SceneResults>& results,
                         const Scene& scene);

/// What a method costs in one scene: processor, memory, energy.
DocumentTable CostTable(const ReproducePlan& plan, const std::vector<SceneResults>& results,
                        const Scene& scene);

/// What learned features gain over others in the same pipeline, the paper's figures beside ours.
DocumentTable GainTable(const ReproducePlan& plan, const std::vector<SceneResults>& results);

/// Every cell without a result, and why. No rows where there is none.
DocumentTable FailureTable(const ReproducePlan& plan, const std::vector<SceneResults>& results);

/// Every cell as comma-separated values.
std::string CellsCsv(const ReproducePlan& plan, const std::vector<SceneResults>& results);

}  // namespace regolith

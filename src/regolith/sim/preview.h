// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/sensor/image.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/sim/scene.h"

namespace regolith {

/// The ground around a path (m, world, on the ground), from above and behind, with the path as a
/// bright line where nothing hides it; 1280 × 720.
Image RenderPreview(const Scene& scene, const Photometry& photometry,
                    Span<const Eigen::Vector3d> path, ThreadPool* pool);

}  // namespace regolith

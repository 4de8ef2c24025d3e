// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "regolith/core/thread_pool.h"
#include "regolith/terrain/surface.h"

namespace regolith {

/// The ground's colour without any light on it, as a PNG of `pixels`² over the square of `side` m
/// about `centre` (m), north up: the planet's tint times the albedo, whose mean has a middle grey.
/// `planet`: "moon" or "mars". Throws OutputError.
void WriteTerrainTexture(const std::string& path, const Surface& surface,
                         const Eigen::Vector2d& centre, double side, int pixels,
                         const std::string& planet, ThreadPool* pool);

}  // namespace regolith

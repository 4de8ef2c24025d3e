// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "regolith/features/feature_extractor.h"

namespace regolith {

/// Corners by the smaller eigenvalue of the gradient matrix (Shi & Tomasi 1994), no nearer than
/// min_distance, spread over the cells. No descriptors. Scores are shares of the strongest corner.
std::unique_ptr<FeatureExtractor> CreateShiTomasiExtractor(const FeatureOptions& options);

}  // namespace regolith

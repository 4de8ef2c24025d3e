// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "regolith/features/feature_extractor.h"
#include "regolith/features/feature_network.h"
#include "regolith/features/feature_options.h"
#include "regolith/features/model_manifest.h"

namespace regolith {

/// Keypoints and descriptors of a SuperPoint-like network, with adaptive thresholds. Throws
/// InputError where the network's file is not what the manifest says.
std::unique_ptr<FeatureExtractor> CreateNetworkExtractor(const FeatureOptions& options,
                                                         const ModelManifest& manifest);

/// The descriptors of an image's cells at pixels, bilinear between the centres of cells, unit
/// length again. Beyond the outermost centres they are those of the edge.
void SampleDescriptors(const NetworkOutput& output, const std::vector<Eigen::Vector2f>& pixels,
                       Descriptors* descriptors);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/features/descriptor_matcher.h"
#include "regolith/features/feature_options.h"

namespace regolith {

/// Clears those of `inliers` that move otherwise than their neighbours: robust affine motion of the
/// nearest inliers in the first image says where a match should lead, whatever the image's
/// rotation and zoom. Fewer than eight inliers say nothing of each other and stay.
void RejectAgainstNeighbours(const std::vector<Eigen::Vector2f>& first,
                             const std::vector<Eigen::Vector2f>& second,
                             const OutlierRejectionOptions& options, std::vector<uint8_t>* inliers);

/// Where `places` of the first image should lie in the second by the motion of the inliers around
/// them, with the radius within which RejectAgainstNeighbours would take a match. False, and
/// `guide` as it was, where there are too few inliers to say.
bool PredictFromNeighbours(const std::vector<Eigen::Vector2f>& first,
                           const std::vector<Eigen::Vector2f>& second,
                           const std::vector<uint8_t>& inliers,
                           const std::vector<Eigen::Vector2f>& places,
                           const OutlierRejectionOptions& options, MatchGuide* guide);

}  // namespace regolith

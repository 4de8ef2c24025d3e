// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/stereo/stereo_map.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// Brings a keyframe, those that see most of the same, and the landmarks that they see into
/// agreement (local bundle adjustment, Mur-Artal & Tardós 2017, equation 4): Huber's loss, Schur's
/// complement, one thread, so that it is the same on every run. Sightings that do not fit
/// afterwards are taken out of the map.
void AdjustAround(KeyframeId newest, const LocalAdjustmentOptions& options,
                  const SightingNoise& noise, StereoMap* map);

}  // namespace regolith

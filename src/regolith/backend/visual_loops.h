// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <utility>

#include "regolith/backend/backend.h"
#include "regolith/backend/visual_places.h"
#include "regolith/features/place_index.h"

namespace regolith {

/// Tries loops of a back end that a camera proposes: what it saw at the newest keyframe is looked
/// for among what it saw before (VisualPlaces), and the lidar has the word (Backend::TryLoop). It
/// finds a place again however far the odometry has gone astray, as long as the rover looks at it
/// from about the same side.
class VisualLoops {
 public:
  explicit VisualLoops(const VisualPlacesOptions& options) : places_(options) {}

  /// What the camera saw at the newest keyframe; its global descriptor is made here. Where the back
  /// end has found a loop there by itself, or has no scan to confirm one, the view is only
  /// remembered.
  void Add(PlaceView view, Backend* backend);

 private:
  PlaceIndex index_;
  VisualPlaces places_;
  std::deque<std::pair<size_t, PlaceView>> unnamed_;  ///< from before there is a vocabulary
};

}  // namespace regolith

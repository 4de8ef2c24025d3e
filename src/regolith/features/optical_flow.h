// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "regolith/features/feature_options.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// Where points of one image went in the next.
struct FlowResult {
  std::vector<Eigen::Vector2f> pixels;  ///< one a point asked for
  std::vector<uint8_t>
      found;  ///< 0 where lost: left the image, no texture, or the way back ended elsewhere
  std::vector<float> errors;  ///< mean grey difference of the patches, forward
};

/// Pyramidal Lucas–Kanade (Bouguet 2001) with a forward–backward check (Kalal et al. 2010). Keeps
/// the pyramid of the last image, so that each is built once.
class OpticalFlow {
 public:
  explicit OpticalFlow(const OpticalFlowOptions& options);
  ~OpticalFlow();
  OpticalFlow(OpticalFlow&&) noexcept;
  OpticalFlow& operator=(OpticalFlow&&) noexcept;

  /// Takes the next image; the one before becomes the one tracked from.
  void Advance(const Image& image);
  /// Forgets both images.
  void Reset();

  /// Tracks points of the last image but one into the last. `guess`, where not empty, is where they
  /// are looked for first. Nothing is found where there is no earlier image of the same size.
  void Track(const std::vector<Eigen::Vector2f>& points, const std::vector<Eigen::Vector2f>& guess,
             FlowResult* result) const;

 private:
  struct State;
  OpticalFlowOptions options_;
  std::unique_ptr<State> state_;
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/feature_options.h"

#include <algorithm>

#include "regolith/core/check.h"

namespace regolith {

void AdaptiveThresholdOptions::Check() const {
  REGOLITH_CHECK(cell_size >= 16, "adaptive.cell_size=", cell_size);
  REGOLITH_CHECK(initial > 0.0 && initial < 1.0, "adaptive.initial=", initial);
  REGOLITH_CHECK(floor > 0.0 && floor <= initial, "adaptive.floor=", floor);
  REGOLITH_CHECK(min_contrast >= 0.0, "adaptive.min_contrast=", min_contrast);
  REGOLITH_CHECK(evenness >= 0.0 && evenness <= 1.0, "adaptive.evenness=", evenness);
  REGOLITH_CHECK(memory >= 0.0 && memory <= 1.0, "adaptive.memory=", memory);
}

void NetworkOptions::Check() const {
  REGOLITH_CHECK(precision == "auto" || precision == "f32" || precision == "bf16",
                 "precision=", precision, "; expected auto, f32 or bf16");
  REGOLITH_CHECK(threads >= 1 && threads <= 64, "threads=", threads);
}

void OpticalFlowOptions::Check() const {
  REGOLITH_CHECK(window >= 5 && window % 2 == 1, "optical_flow.window=", window);
  REGOLITH_CHECK(pyramid_levels >= 0 && pyramid_levels <= 8,
                 "optical_flow.pyramid_levels=", pyramid_levels);
  REGOLITH_CHECK(max_iterations >= 1, "optical_flow.max_iterations=", max_iterations);
  REGOLITH_CHECK(forward_backward > 0.0, "optical_flow.forward_backward=", forward_backward);
  REGOLITH_CHECK(min_eigenvalue >= 0.0, "optical_flow.min_eigenvalue=", min_eigenvalue);
}

void OrbOptions::Check() const {
  REGOLITH_CHECK(levels >= 1 && levels <= 16, "orb.levels=", levels);
  REGOLITH_CHECK(scale_factor > 1.0 && scale_factor <= 2.0, "orb.scale_factor=", scale_factor);
  REGOLITH_CHECK(fast_floor >= 1 && fast_floor <= fast_threshold && fast_threshold < 256,
                 "orb.fast_threshold=", fast_threshold, " orb.fast_floor=", fast_floor);
}

void ShiTomasiOptions::Check() const {
  REGOLITH_CHECK(quality > 0.0 && quality < 1.0, "shi_tomasi.quality=", quality);
  REGOLITH_CHECK(block >= 3, "shi_tomasi.block=", block);
}

void DescriptorMatcherOptions::Check() const {
  REGOLITH_CHECK(ratio > 0.0 && ratio <= 1.0, "matcher.ratio=", ratio);
  REGOLITH_CHECK(min_similarity >= -1.0 && min_similarity < 1.0,
                 "matcher.min_similarity=", min_similarity);
  REGOLITH_CHECK(guided_ratio > 0.0 && guided_ratio <= 1.0, "matcher.guided_ratio=", guided_ratio);
  REGOLITH_CHECK(guided_similarity >= -1.0 && guided_similarity < 1.0,
                 "matcher.guided_similarity=", guided_similarity);
  REGOLITH_CHECK(max_hamming >= 0 && max_hamming <= 256, "matcher.max_hamming=", max_hamming);
}

void OutlierRejectionOptions::Check() const {
  REGOLITH_CHECK(epipolar_sigma > 0.0, "rejection.epipolar_sigma=", epipolar_sigma);
  REGOLITH_CHECK(confidence > 0.0 && confidence < 1.0, "rejection.confidence=", confidence);
  REGOLITH_CHECK(max_iterations >= 1, "rejection.max_iterations=", max_iterations);
  REGOLITH_CHECK(min_matches >= 8, "rejection.min_matches=", min_matches);
  REGOLITH_CHECK(neighbours == 0 || neighbours >= 3, "rejection.neighbours=", neighbours);
  REGOLITH_CHECK(neighbour_spread >= 0.0, "rejection.neighbour_spread=", neighbour_spread);
  REGOLITH_CHECK(neighbour_pixels > 0.0, "rejection.neighbour_pixels=", neighbour_pixels);
}

void TrackMemoryOptions::Check() const {
  REGOLITH_CHECK(frames >= 0, "memory.frames=", frames);
  REGOLITH_CHECK(search_radius > 0.0, "memory.search_radius=", search_radius);
}

void FeatureOptions::Check() const {
  const bool known =
      std::any_of(kFrontends.begin(), kFrontends.end(),
                  [&](const FrontendName& candidate) { return frontend == candidate.name; });
  REGOLITH_CHECK(known, "frontend=", frontend);
  REGOLITH_CHECK(max_keypoints >= 1 && max_keypoints <= kMaxKeypoints,
                 "max_keypoints=", max_keypoints, " of at most ", kMaxKeypoints);
  REGOLITH_CHECK(min_distance >= 1, "min_distance=", min_distance);
  REGOLITH_CHECK(nms_radius >= 1, "nms_radius=", nms_radius);
  REGOLITH_CHECK(border >= 0, "border=", border);
  REGOLITH_CHECK(redetect_share > 0.0 && redetect_share <= 1.0, "redetect_share=", redetect_share);
  adaptive.Check();
  network.Check();
  optical_flow.Check();
  orb.Check();
  shi_tomasi.Check();
  matcher.Check();
  rejection.Check();
  memory.Check();
}

}  // namespace regolith

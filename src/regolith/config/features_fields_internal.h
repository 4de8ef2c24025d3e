// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/features/feature_options.h"

// The keys of `features:`, for a document of their own and for a pipeline.

namespace regolith {

template <typename Archive>
void Fields(Archive& archive, AdaptiveThresholdOptions& adaptive) {
  archive("enabled", adaptive.enabled);
  archive("cell_size", adaptive.cell_size);
  archive("initial", adaptive.initial);
  archive("floor", adaptive.floor);
  archive("min_contrast", adaptive.min_contrast);
  archive("evenness", adaptive.evenness);
  archive("memory", adaptive.memory);
}

template <typename Archive>
void Fields(Archive& archive, OpticalFlowOptions& flow) {
  archive("window", flow.window);
  archive("pyramid_levels", flow.pyramid_levels);
  archive("max_iterations", flow.max_iterations);
  archive("forward_backward", flow.forward_backward);
  archive("min_eigenvalue", flow.min_eigenvalue);
}

template <typename Archive>
void Fields(Archive& archive, OrbOptions& orb) {
  archive("levels", orb.levels);
  archive("scale_factor", orb.scale_factor);
  archive("fast_threshold", orb.fast_threshold);
  archive("fast_floor", orb.fast_floor);
}

template <typename Archive>
void Fields(Archive& archive, ShiTomasiOptions& shi_tomasi) {
  archive("quality", shi_tomasi.quality);
  archive("block", shi_tomasi.block);
}

template <typename Archive>
void Fields(Archive& archive, DescriptorMatcherOptions& matcher) {
  archive("ratio", matcher.ratio);
  archive("min_similarity", matcher.min_similarity);
  archive("max_hamming", matcher.max_hamming);
  archive("mutual", matcher.mutual);
  archive("guided", matcher.guided);
  archive("guided_ratio", matcher.guided_ratio);
  archive("guided_similarity", matcher.guided_similarity);
  archive("second_look", matcher.second_look);
}

template <typename Archive>
void Fields(Archive& archive, OutlierRejectionOptions& rejection) {
  archive("epipolar_sigma", rejection.epipolar_sigma);
  archive("confidence", rejection.confidence);
  archive("max_iterations", rejection.max_iterations);
  archive("min_matches", rejection.min_matches);
  archive("neighbours", rejection.neighbours);
  archive("neighbour_spread", rejection.neighbour_spread);
  archive("neighbour_pixels", rejection.neighbour_pixels);
}

template <typename Archive>
void Fields(Archive& archive, TrackMemoryOptions& memory) {
  archive("frames", memory.frames);
  archive("search_radius", memory.search_radius);
}

template <typename Archive>
void FrontendField(Archive& archive, std::string& frontend) {
  archive("frontend", frontend);
  if constexpr (Archive::kReading) {
    std::string names;
    for (const FrontendName& known : kFrontends) {
      if (frontend == known.name) return;
      names += std::string(names.empty() ? "" : ", ") + known.name;
    }
    archive.Fail("frontend", "`" + frontend + "`: expected one of " + names);
  }
}

/// The network's own keys stand flat among the others: `features.precision` is what users set.
template <typename Archive>
void Fields(Archive& archive, FeatureOptions& features) {
  FrontendField(archive, features.frontend);
  archive("max_keypoints", features.max_keypoints);
  archive("min_distance", features.min_distance);
  archive("nms_radius", features.nms_radius);
  archive("border", features.border);
  archive("redetect_share", features.redetect_share);
  archive("model", features.network.model);
  archive("precision", features.network.precision);
  archive("threads", features.network.threads);
  archive("cache", features.network.cache);
  archive("normalise_contrast", features.network.normalise_contrast);
  archive("adaptive", features.adaptive);
  archive("optical_flow", features.optical_flow);
  archive("orb", features.orb);
  archive("shi_tomasi", features.shi_tomasi);
  archive("matcher", features.matcher);
  archive("rejection", features.rejection);
  archive("memory", features.memory);
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regolith/core/stopwatch.h"
#include "regolith/features/feature_options.h"
#include "regolith/features/feature_set.h"
#include "regolith/features/model_manifest.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// What the adaptive thresholds did in one frame.
struct DetectionStatus {
  int cells = 0;               ///< of the grid
  int cells_filled = 0;        ///< that hold a keypoint
  int rounds = 0;              ///< in which thresholds moved within the frame
  double threshold_min = 0.0;  ///< over the cells
  double threshold_median = 0.0;
  double threshold_max = 0.0;
};

/// Finds keypoints in an image and describes them. Remembers its thresholds from frame to frame,
/// and nothing else.
class FeatureExtractor {
 public:
  virtual ~FeatureExtractor() = default;

  /// At most `max_keypoints` keypoints, into `features` (its storage is used again). `mask`, where
  /// given, is as large as the image and 0 where no keypoint may lie. An image too small for any
  /// keypoint gives none.
  virtual void Extract(const Image& image, const Image* mask, int max_keypoints,
                       FeatureSet* features) = 0;

  /// Descriptors of the last image at any pixels; empty for extractors that have none there.
  virtual Descriptors Describe(const std::vector<Eigen::Vector2f>& pixels) const = 0;

  /// Of the last Extract: what the thresholds did, and how long each stage took.
  virtual const DetectionStatus& status() const = 0;
  virtual const std::vector<StageTime>& stages() const = 0;

  /// Numbers in which a network computes, "f32" or "bf16"; empty where there is none.
  virtual std::string precision() const { return {}; }

  /// Forgets the thresholds.
  virtual void Reset() = 0;

  /// The extractor of options.frontend: a network (which needs its manifest), ORB, or Shi–Tomasi.
  /// Throws InputError where the network's file is not what the manifest says.
  static std::unique_ptr<FeatureExtractor> Create(const FeatureOptions& options,
                                                  const std::optional<ModelManifest>& manifest);
};

}  // namespace regolith

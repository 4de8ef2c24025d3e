// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "regolith/features/feature_options.h"
#include "regolith/features/model_manifest.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// What a feature network says of one image. Cells are 8 × 8 pixels, row by row; the pointers are
/// good until the next call.
struct NetworkOutput {
  int rows = 0;                        ///< of cells
  int columns = 0;                     ///< of cells
  int dimension = 0;                   ///< of a descriptor
  const float* logits = nullptr;       ///< cells × 65: the cell's pixels row by row, then "none"
  const float* descriptors = nullptr;  ///< cells × dimension, each that of its cell's centre
};

/// A feature network on OpenVINO. Images of any size: their sides are padded to multiples of 8 by
/// their last pixels. The network is compiled once a size, and kept on disk where options.cache
/// names a folder.
class FeatureNetwork {
 public:
  /// Throws InputError where the file is missing, is not the one that the manifest describes
  /// (sha256), is no network, or has other inputs or outputs.
  FeatureNetwork(const ModelManifest& manifest, const NetworkOptions& options);
  ~FeatureNetwork();

  NetworkOutput Run(const Image& image);

  /// "f32" or "bf16".
  const std::string& precision() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace regolith

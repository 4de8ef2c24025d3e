// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace regolith {

/// A named tensor of a network. -1 stands for a size that may vary.
struct TensorDescription {
  std::string name;
  std::vector<int> shape;
};

/// Files (.npy, float32) of one input of a network and the outputs that its exporter had for it;
/// empty where the manifest names none.
struct ModelParity {
  std::string input;
  std::string logits;
  std::string descriptors;
};

/// A network's file and what it must be: models/NAME.yaml, made by `python -m regolith_train
/// export`. Input: grey, 1 × 1 × height × width, sides divisible by 8, values (grey / 255 − mean) /
/// scale, or more (per_image). Outputs: detector logits, 1 × 65 × height/8 × width/8 (64 pixels of
/// a cell row by row, then "none"), and descriptors, 1 × dimension × height/8 × width/8.
struct ModelManifest {
  std::string name;
  std::string path;    ///< of the ONNX file
  std::string sha256;  ///< of the ONNX file, lower-case hexadecimal
  TensorDescription input;
  TensorDescription logits;
  TensorDescription descriptors;
  double mean = 0.0;
  double scale = 1.0;
  /// Values are first taken by the image's own mean and deviation, (v − mean(v)) / √(var(v) +
  /// 0.02²), so that exposure does not matter.
  bool per_image = false;
  ModelParity parity;
};

}  // namespace regolith

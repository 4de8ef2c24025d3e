// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace regolith {

/// An array of NumPy, last axis fastest.
struct NpyArray {
  std::vector<size_t> shape;  ///< empty: one number
  std::vector<float> values;
};

/// A .npy file (format versions 1 and 2) of little-endian float32 in C order: what `numpy.save`
/// writes for such an array. Throws InputError for anything else, and where the file is shorter or
/// longer than its header says.
NpyArray ReadNpy(const std::string& path);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

namespace regolith {

/// A text file of three lines of three numbers (as in Oxford's and HPatches' data): takes
/// homogeneous pixels of image 1 to image 2. Throws InputError where it is anything else or cannot
/// be inverted.
Eigen::Matrix3d ReadHomography(const std::string& path);

}  // namespace regolith

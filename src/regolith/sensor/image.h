// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "regolith/core/time.h"

namespace regolith {

/// An 8-bit grey image, rows one after the other. Pixel centres lie at integer coordinates.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> data;  ///< height × width

  uint8_t At(int column, int row) const {
    return data[static_cast<size_t>(row) * static_cast<size_t>(width) +
                static_cast<size_t>(column)];
  }
};

/// An image as a camera of the rig took it.
struct CameraFrame {
  TimeNs time = 0;     ///< mid-exposure, as stamped
  std::string camera;  ///< its name in the rig: "mono", "left", "right"
  Image image;
};

}  // namespace regolith

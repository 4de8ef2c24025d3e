// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/terrain/height_grid.h"

namespace regolith {

/// A square cut from a raster, pixels.
struct RasterCrop {
  int column = 0;  ///< of its centre
  int row = 0;     ///< of its centre
  int size = 0;    ///< side
};

/// Side of the central square that is read where no crop is asked for, pixels.
inline constexpr int kDefaultCropSize = 2500;

/// The heights of an elevation model in any format of GDAL. Posts are the pixels' centres. The
/// file's vertical unit, scale and offset are applied; no-data becomes NaN; degrees become metres
/// with the radius of the body in the file. Without `crop` the central kDefaultCropSize², or the
/// whole along an axis that is shorter. Throws InputError for a file that is no raster, pixels that
/// are rotated, not square in metres or of unknown size, a crop that leaves the raster, or a crop
/// of no-data alone.
HeightGrid ReadHeights(const std::string& path, const std::optional<RasterCrop>& crop = {});

/// A GeoTIFF of float32 heights in metres, NaN for no-data, in grid.crs or, where that is empty, in
/// local metres. Throws OutputError.
void WriteHeights(const std::string& path, const HeightGrid& grid);

/// Two bands of one size, rows one after the other.
struct TwoBands {
  int width = 0;
  int height = 0;
  std::vector<float> first;
  std::vector<float> second;
};

/// A raster of two bands, such as WriteTwoBands makes; no-data becomes NaN. Throws InputError for a
/// file that is no raster or has another number of bands.
TwoBands ReadTwoBands(const std::string& path);

/// A GeoTIFF of two float32 bands, `width` × height pixels each, row by row. Throws OutputError.
void WriteTwoBands(const std::string& path, int width, const std::vector<float>& first,
                   const std::vector<float>& second);

}  // namespace regolith

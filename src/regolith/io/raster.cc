// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>

#include <cpl_conv.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"

namespace regolith {
namespace {

/// No body of the solar system has relief beyond this, m; fill values that a file fails to declare
/// (-3.4e38, 1e30) do.
constexpr double kLargestHeight = 1e5;
/// Relative difference of the two sides of a pixel that still counts as square.
constexpr double kSquareTolerance = 1e-3;
/// The same where degrees were converted: a map true at one latitude only.
constexpr double kGeographicTolerance = 1e-2;

struct DatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, DatasetCloser>;

/// GDAL's complaints go into our messages, not to the terminal.
class QuietGdal {
 public:
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

std::string LastError() {
  std::string message = CPLGetLastErrorMsg();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "no reason given" : message;
}

struct Window {
  int column = 0;
  int row = 0;
  int columns = 0;
  int rows = 0;
};

Window ChooseWindow(const std::string& path, int columns, int rows,
                    const std::optional<RasterCrop>& crop) {
  if (!crop) {
    const int width = std::min(columns, kDefaultCropSize);
    const int height = std::min(rows, kDefaultCropSize);
    return {(columns - width) / 2, (rows - height) / 2, width, height};
  }
  const int64_t left = int64_t{crop->column} - crop->size / 2;
  const int64_t top = int64_t{crop->row} - crop->size / 2;
  if (crop->size < 2) {
    throw InputError(path, Concatenate("crop of side ", crop->size, "; expected 2 pixels or more"));
  }
  if (left < 0 || top < 0 || left + crop->size > columns || top + crop->size > rows) {
    throw InputError(path, Concatenate("crop of side ", crop->size, " about column ", crop->column,
                                       ", row ", crop->row, " leaves the raster of ", columns,
                                       " x ", rows, " pixels; move it or make it smaller"));
  }
  return {static_cast<int>(left), static_cast<int>(top), crop->size, crop->size};
}

/// Metres a unit of the map, across and down, at the latitude of `row` (pixels).
std::array<double, 2> MetresPerUnit(const std::string& path, const OGRSpatialReference* reference,
                                    const std::array<double, 6>& transform, double row) {
  if (reference == nullptr || reference->IsEmpty()) return {1.0, 1.0};
  if (!reference->IsGeographic()) {
    const double unit = reference->GetLinearUnits();
    return {unit, unit};
  }
  OGRErr error = OGRERR_NONE;
  const double radius = reference->GetSemiMajor(&error);
  if (error != OGRERR_NONE || !(radius > 0.0)) {
    throw InputError(path, "is in degrees and names no body; reproject it to metres (gdalwarp)");
  }
  const double radians = reference->GetAngularUnits();
  const double latitude = (transform[3] + row * transform[5]) * radians;
  return {radians * radius * std::cos(latitude), radians * radius};
}

/// Metres a pixel, the same both ways.
double PixelSize(const std::string& path, GDALDataset& dataset, const Window& window) {
  std::array<double, 6> transform{};
  if (dataset.GetGeoTransform(transform.data()) != CE_None) {
    throw InputError(path,
                     "does not say how large its pixels are; set it with gdal_translate -a_ullr");
  }
  if (transform[2] != 0.0 || transform[4] != 0.0) {
    throw InputError(path, "is rotated against its map; make it north-up with gdalwarp");
  }
  const OGRSpatialReference* const reference = dataset.GetSpatialRef();
  const auto metres = MetresPerUnit(path, reference, transform, window.row + 0.5 * window.rows);
  const double across = transform[1] * metres[0];
  const double down = -transform[5] * metres[1];
  if (!(across > 0.0) || !(down > 0.0)) {
    throw InputError(path, "is not north-up; turn it with gdalwarp");
  }
  const bool geographic = reference != nullptr && reference->IsGeographic();
  const double tolerance = geographic ? kGeographicTolerance : kSquareTolerance;
  if (std::abs(across / down - 1.0) > tolerance) {
    throw InputError(path, Concatenate("has pixels of ", across, " x ", down,
                                       " m; expected square ones: resample with gdalwarp -t_srs to "
                                       "a metric projection and -tr"));
  }
  return down;
}

/// Metres a unit of height.
double HeightUnit(const std::string& path, GDALRasterBand& band) {
  static const std::map<std::string, double> kUnits = {{"", 1.0},
                                                       {"m", 1.0},
                                                       {"metre", 1.0},
                                                       {"metres", 1.0},
                                                       {"meter", 1.0},
                                                       {"meters", 1.0},
                                                       {"km", 1000.0},
                                                       {"kilometer", 1000.0},
                                                       {"ft", 0.3048},
                                                       {"foot", 0.3048},
                                                       {"feet", 0.3048},
                                                       {"us survey foot", 1200.0 / 3937.0},
                                                       {"us-ft", 1200.0 / 3937.0},
                                                       {"cm", 0.01},
                                                       {"mm", 0.001}};
  std::string unit = band.GetUnitType();
  std::transform(unit.begin(), unit.end(), unit.begin(),
                 [](char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = kUnits.find(unit);
  if (found == kUnits.end()) {
    throw InputError(path, "heights in unit '" + unit + "'; expected metres, kilometres or feet");
  }
  return found->second;
}

void ReadBand(const std::string& path, GDALRasterBand& band, const Window& window,
              HeightGrid* grid) {
  const size_t count = static_cast<size_t>(window.columns) * static_cast<size_t>(window.rows);
  std::vector<double> values(count);
  std::vector<uint8_t> valid(count);
  const auto read = [&](GDALRasterBand& source, void* target, GDALDataType type) {
    return source.RasterIO(GF_Read, window.column, window.row, window.columns, window.rows, target,
                           window.columns, window.rows, type, 0, 0, nullptr) == CE_None;
  };
  if (!read(band, values.data(), GDT_Float64) ||
      !read(*band.GetMaskBand(), valid.data(), GDT_Byte)) {
    throw InputError(path, "cannot be read (" + LastError() + "); is it whole?");
  }
  const double unit = HeightUnit(path, band);
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  grid->heights.resize(count);
  size_t with_data = 0;
  for (size_t i = 0; i < count; ++i) {
    const double height = (values[i] * scale + offset) * unit;
    const bool good = valid[i] != 0 && std::abs(height) <= kLargestHeight;
    grid->heights[i] = good ? static_cast<float>(height) : std::numeric_limits<float>::quiet_NaN();
    with_data += good ? 1 : 0;
  }
  if (with_data == 0) {
    throw InputError(path, Concatenate("holds no data in the ", window.columns, " x ", window.rows,
                                       " pixels wanted; choose another crop"));
  }
}

std::string WellKnownText(const OGRSpatialReference* reference) {
  if (reference == nullptr || reference->IsLocal()) return {};
  char* text = nullptr;
  reference->exportToWkt(&text);
  const std::string result = text == nullptr ? "" : text;
  CPLFree(text);
  return result;
}

/// `kind` says what the file should be. Throws InputError.
Dataset OpenRaster(const std::string& path, const std::string& kind) {
  if (!std::filesystem::exists(path)) throw InputError(path, "no such file");
  GDALAllRegister();
  Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr,
                                    nullptr, nullptr));
  if (dataset == nullptr) {
    throw InputError(path, "is not " + kind + " that GDAL can read (" + LastError() + ")");
  }
  return dataset;
}

}  // namespace

HeightGrid ReadHeights(const std::string& path, const std::optional<RasterCrop>& crop) {
  const QuietGdal quiet;
  const Dataset dataset = OpenRaster(path, "an elevation model");
  if (dataset->GetRasterCount() < 1) throw InputError(path, "has no raster band");
  const Window window =
      ChooseWindow(path, dataset->GetRasterXSize(), dataset->GetRasterYSize(), crop);
  HeightGrid grid;
  grid.columns = window.columns;
  grid.rows = window.rows;
  grid.spacing = PixelSize(path, *dataset, window);
  std::array<double, 6> transform{};
  dataset->GetGeoTransform(transform.data());
  // In metres of the file's own axes, so that crops of one file share one frame.
  grid.origin.x() = grid.spacing * (transform[0] / transform[1] + window.column + 0.5);
  grid.origin.y() = grid.spacing * (transform[3] / -transform[5] - window.row - 0.5);
  grid.crs = WellKnownText(dataset->GetSpatialRef());
  ReadBand(path, *dataset->GetRasterBand(1), window, &grid);
  return grid;
}

void WriteHeights(const std::string& path, const HeightGrid& grid) {
  REGOLITH_CHECK(grid.columns > 0 && grid.rows > 0, grid.columns, " x ", grid.rows);
  REGOLITH_CHECK(
      grid.heights.size() == static_cast<size_t>(grid.columns) * static_cast<size_t>(grid.rows),
      grid.heights.size());
  TemporaryOutput output(path);
  const QuietGdal quiet;
  GDALAllRegister();
  const auto check = [&](bool good) {
    if (!good) throw OutputError(path, "cannot be written: " + LastError());
  };
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const std::array<const char*, 3> options = {"COMPRESS=DEFLATE", "PREDICTOR=3", nullptr};
  Dataset dataset(driver->Create(output.temporary_path().c_str(), grid.columns, grid.rows, 1,
                                 GDT_Float32, options.data()));
  check(dataset != nullptr);
  std::array<double, 6> transform = {
      grid.origin.x() - 0.5 * grid.spacing, grid.spacing, 0.0,
      grid.origin.y() + 0.5 * grid.spacing, 0.0,          -grid.spacing};
  dataset->SetGeoTransform(transform.data());
  const std::string crs =
      grid.crs.empty() ? R"(LOCAL_CS["local metres",UNIT["metre",1]])" : grid.crs;
  check(dataset->SetProjection(crs.c_str()) == CE_None);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  band.SetUnitType("m");
  check(band.RasterIO(GF_Write, 0, 0, grid.columns, grid.rows,
                      const_cast<float*>(grid.heights.data()), grid.columns, grid.rows, GDT_Float32,
                      0, 0, nullptr) == CE_None);
  CPLErrorReset();
  dataset.reset();
  // Closing writes the rest; it reports a full disk through the error state alone.
  check(CPLGetLastErrorType() < CE_Failure);
  output.Commit();
}

TwoBands ReadTwoBands(const std::string& path) {
  const QuietGdal quiet;
  const Dataset dataset = OpenRaster(path, "a raster");
  if (dataset->GetRasterCount() != 2) {
    throw InputError(path, Concatenate("has ", dataset->GetRasterCount(),
                                       " raster bands; expected two, x and y"));
  }
  TwoBands bands{dataset->GetRasterXSize(), dataset->GetRasterYSize(), {}, {}};
  const size_t count = static_cast<size_t>(bands.width) * static_cast<size_t>(bands.height);
  for (int number = 1; number <= 2; ++number) {
    std::vector<float>& values = number == 1 ? bands.first : bands.second;
    values.resize(count);
    GDALRasterBand& band = *dataset->GetRasterBand(number);
    if (band.RasterIO(GF_Read, 0, 0, bands.width, bands.height, values.data(), bands.width,
                      bands.height, GDT_Float32, 0, 0, nullptr) != CE_None) {
      throw InputError(path, "cannot be read (" + LastError() + "); is it whole?");
    }
    int has_no_data = 0;
    const auto no_data = static_cast<float>(band.GetNoDataValue(&has_no_data));
    if (has_no_data == 0) continue;
    std::replace(values.begin(), values.end(), no_data, std::numeric_limits<float>::quiet_NaN());
  }
  return bands;
}

void WriteTwoBands(const std::string& path, int width, const std::vector<float>& first,
                   const std::vector<float>& second) {
  REGOLITH_CHECK(
      width > 0 && first.size() == second.size() && first.size() % static_cast<size_t>(width) == 0,
      first.size(), " and ", second.size(), " pixels in lines of ", width);
  TemporaryOutput output(path);
  const QuietGdal quiet;
  GDALAllRegister();
  const auto check = [&](bool good) {
    if (!good) throw OutputError(path, "cannot be written: " + LastError());
  };
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const std::array<const char*, 3> options = {"COMPRESS=DEFLATE", "PREDICTOR=3", nullptr};
  const auto height = static_cast<int>(first.size() / static_cast<size_t>(width));
  Dataset dataset(driver->Create(output.temporary_path().c_str(), width, height, 2, GDT_Float32,
                                 options.data()));
  check(dataset != nullptr);
  for (int band = 1; band <= 2; ++band) {
    const std::vector<float>& values = band == 1 ? first : second;
    check(dataset->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, width, height,
                                                 const_cast<float*>(values.data()), width, height,
                                                 GDT_Float32, 0, 0, nullptr) == CE_None);
  }
  CPLErrorReset();
  dataset.reset();
  check(CPLGetLastErrorType() < CE_Failure);
  output.Commit();
}

}  // namespace regolith

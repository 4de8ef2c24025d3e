// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gdal_priv.h>

#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/test_folder.h"

namespace regolith {
namespace {

using testing::HasSubstr;

struct RasterRecipe {
  int columns = 6;
  int rows = 4;
  std::array<double, 6> transform = {100.0, 2.0, 0.0, 50.0, 0.0, -2.0};
  std::string crs;
  std::string unit;
  double scale = 1.0;
  double offset = 0.0;
  double fill = NAN;
  bool georeferenced = true;
};

/// Pixel i holds the value i; -9999 is no-data.
std::string MakeRaster(const TestFolder& folder, const RasterRecipe& recipe) {
  GDALAllRegister();
  const std::string path = folder.Path("made.tif");
  GDALDataset* const dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), recipe.columns, recipe.rows, 1, GDT_Float32, nullptr);
  if (recipe.georeferenced) {
    std::array<double, 6> transform = recipe.transform;
    dataset->SetGeoTransform(transform.data());
  }
  if (!recipe.crs.empty()) dataset->SetProjection(recipe.crs.c_str());
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  band.SetNoDataValue(-9999.0);
  if (!recipe.unit.empty()) band.SetUnitType(recipe.unit.c_str());
  band.SetScale(recipe.scale);
  band.SetOffset(recipe.offset);
  std::vector<float> values(static_cast<size_t>(recipe.columns * recipe.rows));
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = std::isnan(recipe.fill) ? static_cast<float>(i) : static_cast<float>(recipe.fill);
  }
  EXPECT_EQ(band.RasterIO(GF_Write, 0, 0, recipe.columns, recipe.rows, values.data(),
                          recipe.columns, recipe.rows, GDT_Float32, 0, 0, nullptr),
            CE_None);
  GDALClose(dataset);
  return path;
}

std::string ErrorOf(const std::string& path, const std::optional<RasterCrop>& crop = {}) {
  try {
    ReadHeights(path, crop);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Raster, WritesWhatItReads) {
  const TestFolder folder;
  HeightGrid grid;
  grid.columns = 5;
  grid.rows = 3;
  grid.spacing = 0.05;
  grid.origin = {-1.25, 7.5};
  for (int i = 0; i < 15; ++i) grid.heights.push_back(0.1F * static_cast<float>(i));
  grid.At(2, 1) = NAN;
  WriteHeights(folder.Path("terrain.tif"), grid);
  const HeightGrid read = ReadHeights(folder.Path("terrain.tif"));
  EXPECT_EQ(read.columns, 5);
  EXPECT_EQ(read.rows, 3);
  EXPECT_DOUBLE_EQ(read.spacing, 0.05);
  EXPECT_NEAR((read.origin - grid.origin).norm(), 0.0, 1e-9);
  EXPECT_EQ(read.crs, "");
  for (size_t i = 0; i < 15; ++i) {
    if (i == 7) {
      EXPECT_TRUE(std::isnan(read.heights[i]));
    } else {
      EXPECT_EQ(read.heights[i], grid.heights[i]);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder.Path("terrain.tif.tmp")));
}

TEST(Raster, AppliesScaleOffsetUnitAndNoData) {
  const TestFolder folder;
  RasterRecipe recipe;
  recipe.scale = 0.5;
  recipe.offset = -3.0;
  recipe.unit = "ft";
  const HeightGrid grid = ReadHeights(MakeRaster(folder, recipe));
  EXPECT_NEAR(grid.At(1, 1), (7 * 0.5 - 3.0) * 0.3048, 1e-6);
  EXPECT_NEAR(grid.origin.x(), 101.0, 1e-9);
  EXPECT_NEAR(grid.origin.y(), 49.0, 1e-9);
  recipe.unit = "parsec";
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("unit 'parsec'"));
}

TEST(Raster, CropsAboutAPixel) {
  const TestFolder folder;
  const std::string path = MakeRaster(folder, {});
  const HeightGrid grid = ReadHeights(path, RasterCrop{3, 2, 2});
  EXPECT_EQ(grid.columns, 2);
  EXPECT_EQ(grid.At(0, 0), 8.0F);
  EXPECT_NEAR(grid.origin.x(), 100.0 + 2.5 * 2.0, 1e-9);
  EXPECT_NEAR(grid.origin.y(), 50.0 - 1.5 * 2.0, 1e-9);
  EXPECT_THAT(ErrorOf(path, RasterCrop{0, 2, 2}), HasSubstr("leaves the raster of 6 x 4"));
  EXPECT_THAT(ErrorOf(path, RasterCrop{3, 2, 5}), HasSubstr("leaves the raster"));
  EXPECT_THAT(ErrorOf(path, RasterCrop{3, 2, 0}), HasSubstr("2 pixels or more"));
}

TEST(Raster, RefusesWhatIsNoElevationModel) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf(folder.Path("absent.tif")), HasSubstr("no such file"));
  WriteFile(folder.Path("text.tif"), "heights");
  EXPECT_THAT(ErrorOf(folder.Path("text.tif")), HasSubstr("is not an elevation model"));
  RasterRecipe recipe;
  recipe.fill = -9999.0;
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("holds no data"));
  recipe.fill = -3.4e38;
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("holds no data"));
}

TEST(Raster, RefusesPixelsThatAreNotSquareAndUpright) {
  const TestFolder folder;
  RasterRecipe recipe;
  recipe.transform = {0.0, 2.0, 0.1, 0.0, 0.1, -2.0};
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("rotated"));
  recipe.transform = {0.0, 2.0, 0.0, 0.0, 0.0, -3.0};
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("expected square"));
  recipe.transform = {0.0, 2.0, 0.0, 0.0, 0.0, 2.0};
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("north-up"));
  recipe.georeferenced = false;
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("how large its pixels"));
}

TEST(Raster, ConvertsDegreesWithTheBodysRadius) {
  const TestFolder folder;
  RasterRecipe recipe;
  recipe.crs =
      R"(GEOGCS["Moon",DATUM["D_Moon",SPHEROID["Moon",1737400,0]],PRIMEM["Reference_Meridian",0],)"
      R"(UNIT["degree",0.0174532925199433]])";
  recipe.transform = {10.0, 0.001, 0.0, 0.002, 0.0, -0.001};
  EXPECT_NEAR(ReadHeights(MakeRaster(folder, recipe)).spacing, 1737400.0 * 0.001 * M_PI / 180.0,
              1e-6);
  recipe.transform[3] = 60.0;
  EXPECT_THAT(ErrorOf(MakeRaster(folder, recipe)), HasSubstr("expected square"));
}

TEST(Raster, ReadsRealElevationModels) {
  const std::string folder = DataFolder() + "/dem/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "NO REAL DATA in " << folder;
  const HeightGrid moon = ReadHeights(folder + "moon_lola_88S_10m.tif");
  EXPECT_EQ(moon.columns, 513);
  EXPECT_NEAR(moon.spacing, 10.0, 1e-6);
  const HeightGrid mars = ReadHeights(folder + "mars_gale_ctx_20m.tif");
  EXPECT_EQ(mars.columns, 720);
  EXPECT_EQ(mars.rows, 1735);
  EXPECT_NEAR(mars.spacing, 20.0, 0.1);
  const HeightGrid yard =
      ReadHeights(folder + "marsyard_2021_0.094m.tif", RasterCrop{250, 250, 400});
  EXPECT_EQ(yard.columns, 400);
  EXPECT_NEAR(yard.spacing, 0.094, 0.001);
  const auto [low, high] = std::minmax_element(yard.heights.begin(), yard.heights.end());
  EXPECT_LT(*high - *low, 10.0F);
  EXPECT_GT(*high - *low, 0.5F);
}

TEST(Raster, ReadsTheTwoBandsThatItWrites) {
  const TestFolder folder;
  const std::string path = folder.Path("flow.tif");
  WriteTwoBands(path, 3, {0, 1, NAN, 3, 4, 5}, {10, 11, NAN, 13, 14, -15.25});
  const TwoBands bands = ReadTwoBands(path);
  EXPECT_EQ(bands.width, 3);
  EXPECT_EQ(bands.height, 2);
  EXPECT_THAT(bands.first, testing::Pointwise(testing::NanSensitiveFloatEq(),
                                              std::vector<float>{0, 1, NAN, 3, 4, 5}));
  EXPECT_THAT(bands.second, testing::Pointwise(testing::NanSensitiveFloatEq(),
                                               std::vector<float>{10, 11, NAN, 13, 14, -15.25}));
}

TEST(Raster, RefusesWhatIsNotTwoBands) {
  const TestFolder folder;
  const auto error_of = [](const std::string& path) -> std::string {
    try {
      ReadTwoBands(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(error_of(folder.Path("absent.tif")), HasSubstr("no such file"));
  EXPECT_THAT(error_of(MakeRaster(folder, {})), HasSubstr("has 1 raster bands; expected two"));
  WriteFile(folder.Path("text.tif"), "flow");
  EXPECT_THAT(error_of(folder.Path("text.tif")), HasSubstr("is not a raster"));
  WriteTwoBands(folder.Path("flow.tif"), 64, std::vector<float>(4096, 1.5F),
                std::vector<float>(4096, 2.5F));
  const auto size = std::filesystem::file_size(folder.Path("flow.tif"));
  std::filesystem::resize_file(folder.Path("flow.tif"), size / 2);
  EXPECT_NE(error_of(folder.Path("flow.tif")), "");
}

TEST(Raster, UnwritableFolderIsAnOutputError) {
  HeightGrid grid;
  grid.columns = grid.rows = 1;
  grid.heights = {1.0F};
  EXPECT_THROW(WriteHeights("/no/such/folder/terrain.tif", grid), OutputError);
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/terrain.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "regolith/apps/output_folder.h"
#include "regolith/config/install_paths.h"
#include "regolith/config/scenario_config.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/core/random.h"
#include "regolith/core/stop.h"
#include "regolith/core/thread_pool.h"
#include "regolith/core/version.h"
#include "regolith/exports/gazebo_package.h"
#include "regolith/exports/height_map.h"
#include "regolith/exports/mesh_file.h"
#include "regolith/exports/shaded_relief.h"
#include "regolith/exports/terrain_posts.h"
#include "regolith/exports/terrain_texture.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/image_file.h"
#include "regolith/io/raster.h"
#include "regolith/terrain/dem_quality.h"
#include "regolith/terrain/surface.h"

namespace regolith {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kInterrupted = 130;
constexpr int kPreviewPixels = 1024;
constexpr int kTexturePixels = 2048;
constexpr int kLargestRaster = 8193;  // posts a side of generated ground
constexpr int kSlopeSamples = 4000;
constexpr double kDegreesPerRadian = 57.29577951308232;
constexpr std::array<double, 3> kSlopeBaselines = {1.0, 10.0, 100.0};  // m
constexpr std::array<const char*, 5> kExports = {"heightmap", "dae", "obj", "sdf", "urdf"};

bool Wants(const TerrainArguments& arguments, const std::string& name) {
  return std::find(arguments.exports.begin(), arguments.exports.end(), name) !=
         arguments.exports.end();
}

void CheckExports(const TerrainArguments& arguments) {
  for (const std::string& name : arguments.exports) {
    if (std::find(kExports.begin(), kExports.end(), name) == kExports.end()) {
      throw InputError("--export",
                       "`" + name + "` is not known; expected of heightmap, dae, obj, sdf, urdf");
    }
  }
  const int posts = arguments.mesh_posts;
  if (posts < 2 || posts > kLargestRaster) {
    throw InputError("--mesh-posts", Concatenate(posts, ": expected 2 to ", kLargestRaster));
  }
  const bool height_map = Wants(arguments, "heightmap") || Wants(arguments, "sdf");
  if (height_map && !IsHeightMapSize(posts)) {
    throw InputError("--mesh-posts",
                     Concatenate(posts,
                                 ": a height map has 2^n + 1 posts a side: 17, 33, 65, 129, "
                                 "257, 513, 1025, 2049, 4097 or 8193"));
  }
}

void CheckArguments(const TerrainArguments& arguments) {
  CheckExports(arguments);
  if (arguments.dem.empty() && arguments.statistics.empty()) {
    throw InputError("terrain", "has nothing to show; give --dem FILE or --statistics moon|mars");
  }
  if (!arguments.statistics.empty() && arguments.statistics != "moon" &&
      arguments.statistics != "mars") {
    throw InputError("--statistics", "`" + arguments.statistics + "`: expected moon or mars");
  }
  if (arguments.repair && arguments.dem.empty()) {
    throw InputError("--repair", "is for elevation models; add --dem FILE");
  }
  const double posts = arguments.side / arguments.pixel + 1.0;
  if (!(arguments.side > 0.0) || !(arguments.pixel > 0.0) || !(posts >= 4.0) ||
      posts > kLargestRaster) {
    throw InputError("--side", Concatenate(arguments.side, " m in pixels of ", arguments.pixel,
                                           " m: expected 4 to ", kLargestRaster, " posts a side"));
  }
}

std::optional<RasterCrop> CropOf(const TerrainArguments& arguments) {
  if (arguments.crop.empty()) return {};
  REGOLITH_CHECK(arguments.crop.size() == 3, arguments.crop.size());
  return RasterCrop{arguments.crop[0], arguments.crop[1], arguments.crop[2]};
}

// The body that a map's coordinate system names; the Moon where it names none.
std::string BodyOf(const HeightGrid& dem) {
  std::string crs = dem.crs;
  std::transform(crs.begin(), crs.end(), crs.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (crs.find("mars") != std::string::npos) return "mars";
  if (crs.find("moon") == std::string::npos) {
    LogInfo("the elevation model names no body: taken for the Moon; --statistics mars says else");
  }
  return "moon";
}

// A planet's ground, gravity, sun and rover are those of its short scenario.
ScenarioOptions ResolvePlanet(const TerrainArguments& arguments, const std::string& planet) {
  const std::string name = planet == "mars" ? "mars_short" : "lunar_short";
  YamlDocument document = YamlDocument::FromFile(FindConfig("scenarios", name));
  if (!arguments.config.empty()) document.Overlay(YamlDocument::FromFile(arguments.config));
  for (const std::string& assignment : arguments.set) document.Set(assignment);
  ScenarioOptions options = LoadScenario(document);
  if (arguments.seed) options.seed = *arguments.seed;
  options.Check();
  return options;
}

// Ground as a raster and as a surface, and how their frames lie to each other.
struct Ground {
  ScenarioOptions options;
  HeightGrid raster;
  DemQuality quality;                 ///< of the raster as delivered
  std::vector<std::string> repaired;  ///< what was done to it
  std::unique_ptr<Surface> surface;
  Eigen::Vector2d centre =
      Eigen::Vector2d::Zero();  ///< m, frame of the surface: the exports' middle
  double side = 0.0;            ///< m, of the exports' square
  double height_shift = 0.0;    ///< m, raster minus surface
  Eigen::Vector2d raster_centre = Eigen::Vector2d::Zero();  ///< m, the same place in the raster
};

Eigen::Vector2d MiddleOf(const HeightGrid& grid) {
  return grid.origin + 0.5 * grid.spacing * Eigen::Vector2d(grid.columns - 1, -(grid.rows - 1.0));
}

// A surface stands on a height of its own choice; posts of the raster tell how far apart they are.
double HeightShift(const HeightGrid& raster, const Surface& surface) {
  const Eigen::Vector2d middle = MiddleOf(raster);
  const int step = std::max(1, std::min(raster.columns, raster.rows) / 32);
  double sum = 0.0;
  int count = 0;
  for (int row = step / 2; row < raster.rows; row += step) {
    for (int column = step / 2; column < raster.columns; column += step) {
      const float height = raster.At(column, row);
      if (!std::isfinite(height)) continue;
      const Eigen::Vector2d place =
          raster.origin + raster.spacing * Eigen::Vector2d(column, -row) - middle;
      sum += static_cast<double>(height) - surface.Height(place.x(), place.y(), raster.spacing);
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

void Repair(Ground* ground) {
  const DemQuality& quality = ground->quality;
  ground->raster = Repaired(ground->raster, quality);
  if (quality.no_data > 0) ground->repaired.emplace_back("no_data");
  if (!quality.spikes.empty()) ground->repaired.emplace_back("spikes");
  if (quality.rows.striped || quality.columns.striped) ground->repaired.emplace_back("stripes");
  if (quality.rows.tracked || quality.columns.tracked) ground->repaired.emplace_back("tracks");
}

Ground ReadGround(const TerrainArguments& arguments) {
  Ground ground;
  ground.raster = ReadHeights(arguments.dem, CropOf(arguments));
  const std::string planet =
      arguments.statistics.empty() ? BodyOf(ground.raster) : arguments.statistics;
  ground.options = ResolvePlanet(arguments, planet);
  ground.quality = AssessDem(ground.raster);
  if (arguments.repair) Repair(&ground);
  try {
    ground.surface = CreateDemSurface(ground.raster, ground.options.terrain, ground.options.seed);
  } catch (const InputError& error) {
    throw InputError(arguments.dem, error.what());
  }
  ground.height_shift = HeightShift(ground.raster, *ground.surface);
  return ground;
}

HeightGrid CutOut(const HeightGrid& grid, const RasterCrop& crop) {
  const int64_t left = int64_t{crop.column} - crop.size / 2;
  const int64_t top = int64_t{crop.row} - crop.size / 2;
  if (crop.size < 4 || left < 0 || top < 0 || left + crop.size > grid.columns ||
      top + crop.size > grid.rows) {
    throw InputError(
        "--crop", Concatenate("side ", crop.size, " about column ", crop.column, ", row ", crop.row,
                              " leaves the ground of ", grid.columns, " x ", grid.rows,
                              " pixels; expected 4 pixels or more inside it"));
  }
  HeightGrid cut;
  cut.columns = cut.rows = crop.size;
  cut.spacing = grid.spacing;
  cut.origin = grid.origin +
               grid.spacing * Eigen::Vector2d(static_cast<double>(left), -static_cast<double>(top));
  return cut;
}

Ground GenerateGround(const TerrainArguments& arguments, ThreadPool* pool) {
  Ground ground;
  ground.options = ResolvePlanet(arguments, arguments.statistics);
  HeightGrid& raster = ground.raster;
  raster.spacing = arguments.pixel;
  raster.columns = raster.rows =
      static_cast<int>(std::lround(arguments.side / arguments.pixel)) + 1;
  const double half = 0.5 * raster.spacing * (raster.columns - 1);
  raster.origin = {-half, half};
  if (const auto crop = CropOf(arguments)) raster = CutOut(raster, *crop);
  const Eigen::Vector2d corner(half, half);
  ground.surface = CreateGeneratedSurface(ground.options.terrain, ground.options.seed,
                                          Eigen::AlignedBox2d(-corner, corner));
  ground.centre = MiddleOf(raster);
  const TerrainPosts posts =
      SampleTerrain(*ground.surface, ground.centre, raster.spacing * (raster.columns - 1),
                    raster.columns, 0.0, pool);
  raster.heights.reserve(posts.heights.size());
  for (int j = posts.count - 1; j >= 0; --j) {
    for (int i = 0; i < posts.count; ++i) {
      raster.heights.push_back(static_cast<float>(posts.Height(i, j)));
    }
  }
  ground.quality.posts = raster.heights.size();
  return ground;
}

Ground MakeGround(const TerrainArguments& arguments, ThreadPool* pool) {
  Ground ground = arguments.dem.empty() ? GenerateGround(arguments, pool) : ReadGround(arguments);
  const HeightGrid& raster = ground.raster;
  ground.side = raster.spacing * (std::min(raster.columns, raster.rows) - 1);
  ground.raster_centre = MiddleOf(raster);
  return ground;
}

// Slopes of profiles in all directions at seeded places; holes, which a surface fills, are left
// out.
std::vector<double> SampleSlopes(const Ground& ground, double baseline) {
  std::vector<double> slopes;
  Random random(ground.options.seed, "terrain slopes");
  const double half = 0.5 * (ground.side - baseline);
  for (int i = 0; i < kSlopeSamples; ++i) {
    const double x = ground.centre.x() + random.Uniform(-half, half);
    const double y = ground.centre.y() + random.Uniform(-half, half);
    const double direction = random.Uniform(0.0, M_PI);
    if (ground.quality.no_data > 0 && !ground.surface->Known(x, y, baseline)) continue;
    const double dx = 0.5 * baseline * std::cos(direction);
    const double dy = 0.5 * baseline * std::sin(direction);
    const double rise =
        ground.surface->Height(x + dx, y + dy, 0.0) - ground.surface->Height(x - dx, y - dy, 0.0);
    slopes.push_back(std::abs(rise) / baseline);
  }
  return slopes;
}

Json SlopesJson(const Ground& ground) {
  Json json;
  for (const double baseline : kSlopeBaselines) {
    const std::string key = Concatenate(baseline, "_m");
    json[key] = nullptr;
    if (4.0 * baseline > ground.side) continue;
    std::vector<double> slopes = SampleSlopes(ground, baseline);
    if (slopes.size() < 100) continue;
    double sum = 0.0;
    for (const double slope : slopes) sum += slope * slope;
    const double rms = std::atan(std::sqrt(sum / static_cast<double>(slopes.size())));
    const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
    std::nth_element(slopes.begin(), middle, slopes.end());
    json[key] = {{"rms_deg", rms * kDegreesPerRadian},
                 {"median_deg", std::atan(*middle) * kDegreesPerRadian}};
  }
  return json;
}

Json RasterJson(const HeightGrid& raster, const DemQuality& quality) {
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  for (const float height : raster.heights) {
    if (!std::isfinite(height)) continue;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  Json json;
  json["columns"] = raster.columns;
  json["rows"] = raster.rows;
  json["pixel_m"] = raster.spacing;
  json["crs"] = raster.crs;
  json["no_data"] = quality.no_data;
  json["no_data_percent"] =
      100.0 * static_cast<double>(quality.no_data) / static_cast<double>(quality.posts);
  json["spikes"] = quality.spikes.size();
  json["stripes_rms_m"] = {{"rows", quality.rows.offsets}, {"columns", quality.columns.offsets}};
  json["tracks_rms_m"] = {{"rows", quality.rows.tracks}, {"columns", quality.columns.tracks}};
  json["quantisation_m"] = quality.quantisation;
  json["effective_resolution_m"] = quality.effective_resolution;
  json["lowest_m"] = lowest;
  json["highest_m"] = highest;
  return json;
}

const char* StatisticName(const Ground& ground) {
  return ground.options.terrain.relief.statistic == SlopeStatistic::kRms ? "rms" : "median";
}

Json ReliefJson(const Ground& ground) {
  const SurfaceReport report = ground.surface->Report();
  return {{"hurst", report.hurst},
          {"hurst_clamped", report.hurst_clamped},
          {"slope_at_1m_deg", report.slope_at_1m_deg},
          {"statistic", StatisticName(ground)},
          {"pixel_m", report.pixel},
          {"effective_resolution_m", report.effective_resolution}};
}

Json Describe(const TerrainArguments& arguments, const Ground& ground) {
  Json json;
  json["complete"] = true;
  json["version"] = ProgramVersion();
  json["source"] = arguments.dem.empty() ? "statistics" : arguments.dem;
  json["planet"] = ground.options.planet;
  json["seed"] = ground.options.seed;
  json["crop"] = arguments.crop.empty() ? Json(nullptr)
                                        : Json{{"column", arguments.crop[0]},
                                               {"row", arguments.crop[1]},
                                               {"side", arguments.crop[2]}};
  json["raster"] = RasterJson(ground.raster, ground.quality);
  json["repaired"] = ground.repaired;
  json["relief"] = ReliefJson(ground);
  json["slopes"] = SlopesJson(ground);
  return json;
}

void PrintRelief(const Ground& ground) {
  const SurfaceReport report = ground.surface->Report();
  if (report.pixel <= 0.0) {
    std::printf("relief: Hurst exponent %.2f, %s slope over 1 m %.2f degrees\n", report.hurst,
                StatisticName(ground), report.slope_at_1m_deg);
    return;
  }
  const char* const bound =
      report.hurst > 0.5 ? " (a bound: the model is rougher)" : " (a bound: the model is smoother)";
  const ReliefOptions& options = ground.options.terrain.relief;
  std::printf(
      "relief below %.3g m is added: Hurst exponent %.2f%s, %s slope over 1 m %.2f degrees "
      "(statistics: %.2f and %.2f)\n",
      report.effective_resolution, report.hurst, report.hurst_clamped ? bound : "",
      StatisticName(ground), report.slope_at_1m_deg, options.hurst, options.slope_deg);
}

void ReportStripes(const std::string& lines, const Stripes& stripes, const std::string& advice) {
  if (stripes.striped) {
    LogWarning(
        Concatenate("stripes along ", lines, ", offsets of ", stripes.offsets, " m RMS: ", advice));
  }
  if (stripes.tracked) {
    LogWarning(Concatenate("tracks along ", lines, ", rougher than the rest by ", stripes.tracks,
                           " m RMS: ", advice));
  }
}

// A line for each flaw that the model has.
void ReportFlaws(const Ground& ground, bool repair) {
  const DemQuality& quality = ground.quality;
  const std::string advice = repair ? "repaired" : "they stay; --repair takes them out";
  if (quality.no_data > 0) {
    LogWarning(Concatenate(quality.no_data, " posts without data: ",
                           repair ? "filled"
                                  : "they stay so in terrain.tif, exports take their neighbours' "
                                    "heights; --repair fills them"));
  }
  if (!quality.spikes.empty()) {
    LogWarning(Concatenate(quality.spikes.size(),
                           " spikes, posts far off all their neighbours: ", advice));
  }
  ReportStripes("rows", quality.rows, advice);
  ReportStripes("columns", quality.columns, advice);
  if (quality.quantisation > 0.0) {
    LogInfo(Concatenate("heights come in steps of ", quality.quantisation, " m"));
  }
  if (quality.effective_resolution > 2.5 * ground.raster.spacing) {
    LogInfo(Concatenate("the model is smoother than its pixels: it carries wavelengths from ",
                        quality.effective_resolution, " m on"));
  }
}

void PrintSummary(const Json& summary) {
  const Json& raster = summary["raster"];
  std::printf("%d x %d pixels of %.4g m, heights %.2f to %.2f m, %.2f %% without data\n",
              raster["columns"].get<int>(), raster["rows"].get<int>(),
              raster["pixel_m"].get<double>(), raster["lowest_m"].get<double>(),
              raster["highest_m"].get<double>(), raster["no_data_percent"].get<double>());
  for (const auto& [baseline, slope] : summary["slopes"].items()) {
    if (slope.is_null()) continue;
    std::printf("slopes over %s m: median %.2f, RMS %.2f degrees\n",
                baseline.substr(0, baseline.size() - 2).c_str(), slope["median_deg"].get<double>(),
                slope["rms_deg"].get<double>());
  }
}

// Everything that --export names, into one folder that is a catkin package.
Json WriteExports(const TerrainArguments& arguments, const Ground& ground, ThreadPool* pool) {
  // Near zero, or single precision would cost millimetres on an elevation of kilometres.
  TerrainPosts posts = SampleTerrain(*ground.surface, ground.centre, ground.side,
                                     arguments.mesh_posts, ground.height_shift, pool);
  const int middle = posts.count / 2;
  const double origin_height = arguments.dem.empty() ? 0.0 : posts.Height(middle, middle);
  for (double& height : posts.heights) height -= origin_height;
  const std::string out = arguments.out + "/";
  const bool sdf = Wants(arguments, "sdf");
  const bool mesh = Wants(arguments, "dae") || Wants(arguments, "obj");
  Json json;
  json["origin"] = {{"x_m", ground.raster_centre.x()},
                    {"y_m", ground.raster_centre.y()},
                    {"height_m", origin_height}};
  json["posts"] = posts.count;
  json["spacing_m"] = posts.spacing;
  json["side_m"] = posts.side();
  HeightRange range = RangeOf(posts);
  if (Wants(arguments, "heightmap") || sdf) {
    range = WriteHeightMap(out + "heightmap.png", posts);
    json["heightmap"] = {{"black_m", range.lowest}, {"white_m", range.highest}};
  }
  if (mesh || sdf) {
    WriteTerrainTexture(out + kTextureName, *ground.surface, ground.centre, ground.side,
                        kTexturePixels, ground.options.planet, pool);
  }
  if (Wants(arguments, "dae")) WriteCollada(out + "terrain.dae", posts, kTextureName);
  if (Wants(arguments, "obj")) WriteObj(out + "terrain.obj", posts, kTextureName);
  const Place start = FlattestPlace(posts, 2.0);
  json["start"] = {{"x_m", start.x}, {"y_m", start.y}, {"height_m", start.ground}};
  WorldDescription world;
  world.ground_side = posts.side();
  world.range = range;
  world.start = start;
  world.has_mesh = Wants(arguments, "dae");
  if (sdf) WriteGazeboWorlds(arguments.out, ground.options, world);
  if (Wants(arguments, "urdf")) WriteRoverPackage(arguments.out, ground.options, world, sdf);
  return json;
}

}  // namespace

int Terrain(const TerrainArguments& arguments) {
  CheckArguments(arguments);
  SetQuiet(arguments.quiet);
  ThreadPool pool(arguments.threads);
  const Ground ground = MakeGround(arguments, &pool);
  PrepareOutputFolder(arguments.out, arguments.overwrite);

  Json summary = Describe(arguments, ground);
  PrintSummary(summary);
  PrintRelief(ground);
  ReportFlaws(ground, arguments.repair);
  WriteHeights(arguments.out + "/terrain.tif", ground.raster);
  WriteFile(arguments.out + "/terrain.yaml", WriteScenario(ground.options));
  WritePng(arguments.out + "/preview.png", ShadedRelief(ground.raster, {}, kPreviewPixels));
  if (!arguments.exports.empty() && !StopRequested()) {
    summary["exports"] = WriteExports(arguments, ground, &pool);
    summary["exports"]["files"] = arguments.exports;
  }
  summary["complete"] = !StopRequested();
  const bool complete = summary["complete"];
  // Names of files and coordinate systems come from outside and need not be UTF-8.
  WriteFile(arguments.out + "/summary.json",
            summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  std::printf("terrain: %s\n", arguments.out.c_str());
  return complete ? 0 : kInterrupted;
}

}  // namespace regolith

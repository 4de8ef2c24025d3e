// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/drive_planner.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/core/random.h"
#include "regolith/sim/drive_map.h"
#include "regolith/sim/route_layout.h"
#include "regolith/sim/rover_motion.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;

// Gentle waves with scattered rocks of 15 to 35 cm.
class Rocky : public Surface {
 public:
  explicit Rocky(double rocks_a_square_metre) {
    Random random(7);
    const int count = static_cast<int>(rocks_a_square_metre * box().volume());
    for (int i = 0; i < count; ++i) {
      Rock rock;
      rock.centre = {random.Uniform(-70, 70), random.Uniform(-70, 70)};
      rock.diameter = 0.15 / std::sqrt(1.0 - 0.8 * random.Uniform());
      rock.ground = Height(rock.centre.x(), rock.centre.y(), 0.0);
      rocks_.push_back(rock);
    }
  }
  double Height(double x, double y, double) const override {
    return 0.5 * std::sin(0.3 * x) * std::cos(0.25 * y);
  }
  double Albedo(double, double, double) const override { return 0.1; }
  bool Known(double x, double y, double margin) const override {
    return std::max(std::abs(x), std::abs(y)) + margin < 70.0;
  }
  Eigen::AlignedBox2d box() const override {
    return {Eigen::Vector2d(-70, -70), Eigen::Vector2d(70, 70)};
  }
  std::vector<Rock> Rocks(const Eigen::AlignedBox2d& box, double min_diameter) const override {
    std::vector<Rock> found;
    for (const Rock& rock : rocks_) {
      if (rock.diameter >= min_diameter && box.contains(rock.centre)) found.push_back(rock);
    }
    return found;
  }

 private:
  std::vector<Rock> rocks_;
};

DriveOptions LunarLoops() {
  DriveOptions options;
  options.route = "loops";
  options.length = 360.0;
  options.leg_duration = 30.0;
  return options;
}

DriveOptions MarsLoops() {
  DriveOptions options = LunarLoops();
  options.length = 200.0;
  options.speed = 0.65;
  options.leg_duration = 20.0;
  return options;
}

Drive PlanOnGenerated(const TerrainOptions& terrain, const DriveOptions& options, uint64_t seed,
                      double duration) {
  const auto surface = CreateGeneratedSurface(terrain, seed, DriveBox(options, seed));
  return PlanDrive(*surface, options, RoverOptions{}, seed, duration, kMotionInterval);
}

TerrainOptions Mars() {
  TerrainOptions terrain;
  terrain.relief.hurst = 0.6;
  terrain.relief.slope_deg = 5.0;
  terrain.relief.statistic = SlopeStatistic::kRms;
  terrain.craters.density = 0.016;
  terrain.craters.max_diameter = 20.0;
  terrain.rocks.law = RockLaw::kGolombek;
  terrain.rocks.clustering = 0.0;
  return terrain;
}

void ExpectBothRevisits(const Drive& drive) {
  ASSERT_EQ(drive.revisits.size(), 2U);
  EXPECT_TRUE(drive.revisits[0].same_direction);
  EXPECT_FALSE(drive.revisits[1].same_direction);
}

constexpr uint64_t kSeeds = 5;

TEST(PlanDrive, LunarLoopsAreLongRevisitTwiceAndStayBelowTheSteepest) {
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Drive drive = PlanOnGenerated(TerrainOptions{}, LunarLoops(), seed, 700.0);
    EXPECT_GT(drive.length, 300.0) << seed;
    ExpectBothRevisits(drive);
    EXPECT_LT(drive.steepest, 15.0 * kDegree) << seed;
    EXPECT_GT(drive.steepest, 10.0 * kDegree) << seed;
    EXPECT_LE(drive.cleared.size(), 5U) << seed;
    EXPECT_EQ(drive.path.front().yaw, 0.0);
  }
}

TEST(PlanDrive, MarsLoopsAreLongAndRevisitTwice) {
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Drive drive = PlanOnGenerated(Mars(), MarsLoops(), seed, 300.0);
    EXPECT_GT(drive.length, 150.0) << seed;
    ExpectBothRevisits(drive);
    EXPECT_LT(drive.steepest, 15.0 * kDegree) << seed;
    EXPECT_LE(drive.cleared.size(), 10U) << seed;
    for (const PlanarPose& pose : drive.path) ASSERT_LT(pose.speed, 0.77);
  }
}

TEST(PlanDrive, WanderingCoversItsLengthInTime) {
  DriveOptions mars;
  mars.speed = 0.65;
  mars.length = 100.0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    EXPECT_GT(PlanOnGenerated(TerrainOptions{}, DriveOptions{}, seed, 40.0).length, 17.0) << seed;
    EXPECT_GT(PlanOnGenerated(TerrainOptions{}, DriveOptions{}, seed, 120.0).length, 45.0) << seed;
    EXPECT_GT(PlanOnGenerated(Mars(), mars, seed, 40.0).length, 20.0) << seed;
  }
}

TEST(PlanDrive, CurvesAreNoSharperThanAllowed) {
  const Rocky surface(0.5);
  const DriveOptions options = MarsLoops();
  const Drive drive = PlanDrive(surface, options, RoverOptions{}, 1, 300.0, kMotionInterval);
  double sharpest = 0.0;
  for (size_t i = 1; i < drive.path.size(); ++i) {
    const double step = (drive.path[i].position - drive.path[i - 1].position).norm();
    if (step < 0.02) continue;
    sharpest = std::max(sharpest, std::abs(drive.path[i].yaw - drive.path[i - 1].yaw) / step);
  }
  EXPECT_LT(sharpest, 1.05 * options.curvature);
  EXPECT_GT(sharpest, 0.5 * options.curvature);
}

TEST(PlanDrive, ALongerDriveBeginsAsTheShorterOne) {
  const Rocky surface(0.0);
  const DriveOptions options;
  const Drive shorter = PlanDrive(surface, options, RoverOptions{}, 2, 20.0, kMotionInterval);
  const Drive longer = PlanDrive(surface, options, RoverOptions{}, 2, 60.0, kMotionInterval);
  for (size_t i = 0; i < shorter.path.size(); ++i) {
    ASSERT_EQ(shorter.path[i].position, longer.path[i].position) << i;
    ASSERT_EQ(shorter.path[i].yaw, longer.path[i].yaw) << i;
  }
}

TEST(PlanDrive, GoesRoundMostRocksAndReportsTheOthers) {
  const Rocky surface(0.5);
  const Drive drive = PlanDrive(surface, MarsLoops(), RoverOptions{}, 1, 300.0, kMotionInterval);
  EXPECT_LE(drive.cleared.size(), 12U);
  for (const PlanarPose& pose : drive.path) {
    if (pose.speed == 0.0) continue;
    const Eigen::Vector2d ahead(std::cos(pose.yaw), std::sin(pose.yaw));
    for (const Rock& rock : surface.Rocks(surface.box(), 0.15)) {
      const Eigen::Vector2d offset = rock.centre - pose.position;
      if (offset.norm() > 1.0 || std::abs(offset.dot(ahead)) > 0.05) continue;
      const double aside = ahead.x() * offset.y() - ahead.y() * offset.x();
      EXPECT_TRUE(!OnWheelTrack(aside, rock.diameter) || drive.Clears(rock.centre));
    }
  }
}

TEST(PlanDrive, RefusesSlopesThatAreTooSteepEverywhere) {
  TerrainOptions terrain;
  terrain.relief.slope_deg = 18.0;
  DriveOptions options;
  options.max_slope_deg = 8.0;
  options.wanted_slope_deg = 5.0;
  EXPECT_THROW(PlanOnGenerated(terrain, options, 3, 40.0), InputError);
}

TEST(PlanDrive, RefusesAModelThatIsTooSmall) {
  HeightGrid dem;
  dem.columns = 20;
  dem.rows = 20;
  dem.spacing = 0.5;
  dem.heights.assign(400, 0.0F);
  const auto surface = CreateDemSurface(dem, TerrainOptions{}, 3);
  EXPECT_THROW(PlanDrive(*surface, DriveOptions{}, RoverOptions{}, 3, 40.0, kMotionInterval),
               InputError);
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "regolith/exports/gazebo_world.h"
#include "regolith/exports/height_map.h"
#include "regolith/exports/rover_urdf.h"
#include "regolith/exports/shaded_relief.h"
#include "regolith/exports/terrain_posts.h"
#include "regolith/exports/xml_writer.h"

namespace regolith {
namespace {

/// A plane that rises to the east, with one rock in the middle.
class Plane : public Surface {
 public:
  double Height(double x, double, double) const override { return 0.1 * x; }
  double Albedo(double, double, double) const override { return 0.12; }
  bool Known(double, double, double) const override { return true; }
  Eigen::AlignedBox2d box() const override {
    return {Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(50.0, 50.0)};
  }
  std::vector<Rock> Rocks(const Eigen::AlignedBox2d&, double min_diameter) const override {
    Rock rock;
    rock.diameter = 4.0;
    return min_diameter <= rock.diameter ? std::vector<Rock>{rock} : std::vector<Rock>{};
  }
  std::vector<RockShape> RockShapes() const override {
    RockShape shape;
    shape.vertices = {{-0.5F, -0.5F, 0.5F}, {0.5F, -0.5F, 0.5F}, {0.0F, 0.5F, 0.5F}};
    shape.triangles = {{0, 1, 2}};
    return {shape};
  }
};

TEST(TerrainPosts, CarryGroundAndRocks) {
  ThreadPool pool(2);
  const TerrainPosts posts = SampleTerrain(Plane(), {0.0, 0.0}, 64.0, 65, 100.0, &pool);
  EXPECT_NEAR(posts.Height(0, 10), 100.0 - 3.2, 1e-9);
  EXPECT_NEAR(posts.Height(64, 10), 100.0 + 3.2, 1e-9);
  EXPECT_NEAR(posts.Height(32, 32), 102.0, 1e-6);
  EXPECT_NEAR(posts.Normal(5, 5).x(), -0.1 / std::sqrt(1.01), 1e-9);
}

TEST(HeightMap, GivesHeightsBackToHalfAStep) {
  ThreadPool pool(1);
  const TerrainPosts posts = SampleTerrain(Plane(), {0.0, 0.0}, 64.0, 65, 0.0, &pool);
  const std::string path = testing::TempDir() + "/heightmap.png";
  const HeightRange range = WriteHeightMap(path, posts);
  const cv::Mat image = cv::imread(path, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(image.type(), CV_16UC1);
  ASSERT_EQ(image.rows, 65);
  const double step = (range.highest - range.lowest) / 65535.0;
  for (int i = 0; i < 65; ++i) {
    const double height = range.lowest + step * image.at<uint16_t>(64 - 3, i);
    EXPECT_NEAR(height, posts.Height(i, 3), 0.5 * step + 1e-12);
  }
}

TEST(HeightMap, KnowsItsSizes) {
  for (const int good : {17, 129, 1025, 8193}) EXPECT_TRUE(IsHeightMapSize(good)) << good;
  for (const int bad : {-1, 0, 1, 2, 16, 100, 1024, 16385})
    EXPECT_FALSE(IsHeightMapSize(bad)) << bad;
}

TEST(ShadedRelief, CastsAShadowAwayFromTheSun) {
  HeightGrid grid;
  grid.columns = grid.rows = 41;
  grid.heights.assign(41 * 41, 0.0F);
  for (int row = 0; row < 41; ++row) grid.At(20, row) = 2.0F;  // a wall
  const Image image = ShadedRelief(grid, {30.0, 270.0}, 100);  // the sun in the west
  // 2 m / tan 30° = 3.5 m
  EXPECT_LT(image.At(22, 20), 20);
  EXPECT_LT(image.At(23, 20), 20);
  EXPECT_GT(image.At(25, 20), 20);
  EXPECT_GT(image.At(17, 20), 20);
}

TEST(RoverUrdf, InertiasAreThoseOfBodies) {
  for (const Inertia& inertia :
       {BoxInertia(35.0, {0.9, 0.5, 0.2}), WheelInertia(2.5, 0.15, 0.12)}) {
    const Eigen::Vector3d& m = inertia.moments;
    EXPECT_GT(m.minCoeff(), 0.0);
    EXPECT_GT(m.sum() - m.maxCoeff(), m.maxCoeff());  // triangle inequality
  }
}

TEST(RoverUrdf, HasThePluginsOfThePaperAndTheTopicsOfTheRig) {
  const std::string urdf = RoverUrdf(ScenarioOptions());
  for (const char* const word :
       {"libgazebo_ros_camera.so", "libgazebo_ros_depth_camera.so", "libgazebo_ros_imu.so",
        "libgazebo_ros_laser.so", "libgazebo_ros_multicamera.so", "libgazebo_ros_control.so",
        "libgazebo_ros_diff_drive.so", "/imu/data", "/velodyne_points", "camera/mono"}) {
    EXPECT_NE(urdf.find(word), std::string::npos) << word;
  }
}

TEST(RoverUrdf, HasTheCamerasOfTheRigAlone) {
  ScenarioOptions options;
  options.camera.stereo = false;
  const std::string urdf = RoverUrdf(options);
  EXPECT_NE(urdf.find("mono_head"), std::string::npos);
  for (const char* const word : {"left_head", "right_head", "libgazebo_ros_multicamera.so"}) {
    EXPECT_EQ(urdf.find(word), std::string::npos) << word;
  }
}

TEST(GazeboWorld, HasTheScenariosGravityAndSun) {
  ScenarioOptions options;
  options.gravity = 3.72;
  options.sun.elevation_deg = 90.0;
  const std::string world = GazeboWorld(options, WorldDescription(), false);
  EXPECT_NE(world.find("<gravity>0 0 -3.72</gravity>"), std::string::npos);
  EXPECT_NE(world.find(" -1</direction>"), std::string::npos);
  EXPECT_EQ(world.find("<include>"), std::string::npos);
}

TEST(XmlWriter, EscapesAndCloses) {
  XmlWriter xml(true);
  xml.Open("a", {{"key", "\"<&>"}});
  xml.Leaf("b", "1 < 2");
  xml.Close();
  EXPECT_EQ(xml.Text(), "<a key=\"&quot;&lt;&amp;&gt;\">\n  <b>1 &lt; 2</b>\n</a>\n");
}

}  // namespace
}  // namespace regolith

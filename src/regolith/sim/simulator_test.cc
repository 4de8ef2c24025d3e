// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/simulator.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"
#include "regolith/sim/drive_planner.h"
#include "regolith/sim/lidar_simulator.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/renderer.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

// Small images and a coarse mesh: the whole chain in seconds.
ScenarioOptions Draft() {
  ScenarioOptions options;
  options.duration = 4.5;
  options.camera.width = 160;
  options.camera.height = 120;
  options.camera.rate = 5.0;
  options.mesh.spacing = 0.04;
  options.mesh.reach = 110.0;
  return options;
}

void Add(uint64_t value, uint64_t* hash) { *hash = (*hash ^ value) * 1099511628211ULL; }

/// Of all that is measured; of the cameras perhaps the middle one alone.
uint64_t Fingerprint(const ScenarioOptions& options, int threads, bool mono_alone = false) {
  ThreadPool pool(threads);
  const auto simulator = Simulator::Create(options, nullptr, &pool);
  uint64_t hash = 14695981039346656037ULL;
  const auto add_bytes = [&hash](const void* data, size_t size) {
    const auto* bytes = static_cast<const uint8_t*>(data);
    for (size_t i = 0; i < size; ++i) Add(bytes[i], &hash);
  };
  while (const auto event = simulator->Next()) {
    const auto* image = std::get_if<CameraFrame>(&*event);
    if (mono_alone && image != nullptr && image->camera != "mono") continue;
    Add(static_cast<uint64_t>(EventTime(*event)), &hash);
    if (const auto* imu = std::get_if<ImuSample>(&*event)) {
      add_bytes(imu->specific_force.data(), sizeof(double) * 3);
    } else if (const auto* scan = std::get_if<LidarScan>(&*event)) {
      for (const LidarPoint& point : scan->points) {
        add_bytes(point.position.data(), sizeof(float) * 3);
      }
    } else if (image != nullptr) {
      add_bytes(image->image.data.data(), image->image.data.size());
    } else {
      add_bytes(std::get<WheelOdometry>(*event).T_odom_base.translation.data(), sizeof(double) * 3);
    }
  }
  return hash;
}

TEST(Simulator, IsTheSameForAnyNumberOfThreadsAndDiffersBetweenSeeds) {
  ScenarioOptions options = Draft();
  const uint64_t one = Fingerprint(options, 1);
  EXPECT_EQ(one, Fingerprint(options, 2));
  options.seed = 2;
  EXPECT_NE(one, Fingerprint(options, 2));
}

TEST(Simulator, WithoutStereoTheOtherSensorsMeasureTheSame) {
  ScenarioOptions options = Draft();
  const uint64_t with_stereo = Fingerprint(options, 2, true);
  options.camera.stereo = false;
  EXPECT_EQ(Fingerprint(options, 2), with_stereo);
  ThreadPool pool(2);
  EXPECT_EQ(Simulator::Create(options, nullptr, &pool)->rig().cameras.size(), 1U);
}

TEST(Simulator, YieldsAllSensorsInOrderAtTheirRates) {
  ThreadPool pool(2);
  const ScenarioOptions options = Draft();
  const auto simulator = Simulator::Create(options, nullptr, &pool);
  int imu = 0;
  int scans = 0;
  int wheels = 0;
  size_t points = 0;
  std::set<std::string> cameras;
  int frames = 0;
  TimeNs last = simulator->start_time();
  while (const auto event = simulator->Next()) {
    EXPECT_GE(EventTime(*event), last);
    last = EventTime(*event);
    if (const auto* frame = std::get_if<CameraFrame>(&*event)) {
      cameras.insert(frame->camera);
      ++frames;
      // The hidden clock: 4 ms after a multiple of the period.
      EXPECT_EQ((frame->time - simulator->start_time()) % 200'000'000, 4'000'000);
    } else if (const auto* scan = std::get_if<LidarScan>(&*event)) {
      ++scans;
      points += scan->points.size();
      EXPECT_EQ((scan->stamp - simulator->start_time()) % 100'000'000, 0);
      for (const LidarPoint& point : scan->points) {
        ASSERT_GE(point.time, 0.0F);
        ASSERT_LT(point.time, 0.1F);
        ASSERT_LT(point.ring, 16);
      }
    } else {
      ++(std::holds_alternative<ImuSample>(*event) ? imu : wheels);
    }
  }
  EXPECT_EQ(imu, 901);
  EXPECT_EQ(wheels, 226);
  EXPECT_EQ(scans, 45);
  EXPECT_EQ(cameras, (std::set<std::string>{"left", "mono", "right"}));
  EXPECT_EQ(frames, 3 * 23);
  const double mean = static_cast<double>(points) / scans;
  EXPECT_GT(mean, 11000.0);
  EXPECT_LT(mean, 16000.0);
}

TEST(Simulator, RigIsValidAndKeepsTheErrorsHidden) {
  ThreadPool pool(2);
  const auto simulator = Simulator::Create(Draft(), nullptr, &pool);
  const RigCalibration rig = simulator->rig();
  EXPECT_NO_THROW(rig.Check());
  EXPECT_EQ(rig.cameras.at("mono").time_offset, 0.0);
  EXPECT_EQ(rig.cameras.at("mono").time_offset_sigma, 0.005);
  EXPECT_EQ(rig.gravity, 1.62);
  const SE3 T_left_right =
      rig.cameras.at("left").T_imu_camera.Inverse() * rig.cameras.at("right").T_imu_camera;
  EXPECT_LT((T_left_right.translation - Eigen::Vector3d(0.12, 0, 0)).norm(), 1e-9);
}

TEST(Simulator, TerrainAndTruthShareTheirFrame) {
  ThreadPool pool(2);
  const auto simulator = Simulator::Create(Draft(), nullptr, &pool);
  const HeightGrid terrain = simulator->TerrainAroundPath();
  EXPECT_DOUBLE_EQ(terrain.spacing, 0.05);
  const Trajectory truth = simulator->Truth();
  EXPECT_EQ(truth.size(), 451U);
  for (const StampedPose& pose : truth.poses()) {
    const Eigen::Vector3d base = (pose.T_world_body * BaseFromImu().Inverse()).translation;
    const auto column =
        static_cast<int>(std::lround((base.x() - terrain.origin.x()) / terrain.spacing));
    const auto row =
        static_cast<int>(std::lround((terrain.origin.y() - base.y()) / terrain.spacing));
    EXPECT_NEAR(terrain.At(column, row), base.z(), 0.12);
  }
}

TEST(Simulator, RefusesWhatCannotBeDriven) {
  ThreadPool pool(1);
  ScenarioOptions options = Draft();
  options.sun.elevation_deg = -1.0;
  EXPECT_THROW(Simulator::Create(options, nullptr, &pool), InputError);
  options = Draft();
  options.duration = 2.0;
  EXPECT_THROW(Simulator::Create(options, nullptr, &pool), InputError);
}

class LidarTest : public testing::Test {
 protected:
  LidarTest()
      : pool_(2),
        surface_(CreateGeneratedSurface(TerrainOptions{}, 3,
                                        {Eigen::Vector2d(-40, -40), Eigen::Vector2d(40, 40)})),
        path_(PlanDrive(*surface_, DriveOptions{}, RoverOptions{}, 3, 20.0, kMotionInterval).path),
        motion_(*surface_, path_, RoverOptions{}, VibrationOptions{}, 3),
        ground_(*surface_, motion_.origin()) {
    MeshOptions mesh;
    mesh.spacing = 0.04;
    mesh.reach = 110.0;
    std::vector<Eigen::Vector2d> places;
    for (double time = 0.0; time < 20.0; time += 0.5) {
      places.emplace_back(motion_.PoseAt(time).translation.head<2>());
    }
    scene_ = Scene::Create(ground_, places, {}, photometry_, mesh, &pool_);
  }

  ThreadPool pool_;
  std::unique_ptr<Surface> surface_;
  std::vector<PlanarPose> path_;
  RoverMotion motion_;
  Ground ground_;
  Photometry photometry_{"moon", SunOptions{}, 0.12};
  std::unique_ptr<Scene> scene_;
};

// Each point, put into the world with the true pose of its own time, lies on the ground: firing
// poses, times, rings and extrinsics at once.
TEST_F(LidarTest, PointsLieOnTheGroundAtTheirOwnTimes) {
  LidarOptions options;
  options.range_sigma = 0.0;
  options.dropout = 0.0;
  const LidarSimulator lidar(options, *scene_, motion_, 1, &pool_);
  const SE3 T_imu_lidar = BaseFromImu().Inverse() * BaseFromLidar(options);
  const double start = 12.0;
  const LidarScan scan = lidar.Scan(start, 0);
  int near = 0;
  for (const LidarPoint& point : scan.points) {
    const Eigen::Vector3d place = motion_.PoseAt(start + static_cast<double>(point.time)) *
                                  (T_imu_lidar * point.position.cast<double>());
    const double elevation =
        std::asin(static_cast<double>(point.position.z() / point.position.norm())) * 180.0 / M_PI;
    EXPECT_NEAR(elevation, -15.0 + 2.0 * point.ring, 1e-3);
    if (point.position.norm() > 6.0F) continue;
    ++near;
    // Beams have a footprint.
    EXPECT_NEAR(place.z(), ground_.Height(place.x(), place.y(), 0.04), 0.03);
  }
  EXPECT_GT(near, 2000);
}

// Lidar and camera see one surface: a lidar point, projected into an image, and the place that this
// pixel sees are one place, by their parallax in an image from half a metre further on.
TEST_F(LidarTest, PointsAndPixelsAreTheSamePlaces) {
  LidarOptions options;
  options.range_sigma = 0.0;
  options.dropout = 0.0;
  const CameraOptions camera;
  const auto model = CameraModel::Create(MakeIntrinsics(camera));
  const SE3 T_imu_lidar = BaseFromImu().Inverse() * BaseFromLidar(options);
  const SE3 T_imu_camera = BaseFromImu().Inverse() * BaseFromCamera(camera, "mono");
  const double start = 12.0;
  const SE3 T_world_camera = motion_.PoseAt(start + 0.05) * T_imu_camera;
  const SE3 T_later_world = (motion_.PoseAt(start + 1.05) * T_imu_camera).Inverse();
  RenderedView view;
  Renderer(MakeIntrinsics(camera), *scene_, photometry_, &pool_)
      .Render(T_world_camera, Surroundings{}, &view);
  const LidarScan scan = LidarSimulator(options, *scene_, motion_, 1, &pool_).Scan(start, 0);
  std::vector<double> errors;
  for (const LidarPoint& point : scan.points) {
    const Eigen::Vector3d place = motion_.PoseAt(start + static_cast<double>(point.time)) *
                                  (T_imu_lidar * point.position.cast<double>());
    const auto pixel = model->Project(T_world_camera.Inverse() * place);
    if (!pixel || (pixel->array() < 0.0).any() || pixel->x() >= 639.0 || pixel->y() >= 479.0) {
      continue;
    }
    // Inverse distances are linear between the pixels of a plane.
    const Eigen::Array2d low = pixel->array().floor();
    const Eigen::Array2d share = pixel->array() - low;
    double inverse = 0.0;
    for (const int i : {0, 1}) {
      for (const int j : {0, 1}) {
        const double weight = (i ? share.x() : 1.0 - share.x()) * (j ? share.y() : 1.0 - share.y());
        const auto at = (static_cast<size_t>(low.y()) + static_cast<size_t>(j)) * 640 +
                        static_cast<size_t>(low.x()) + static_cast<size_t>(i);
        inverse += weight / static_cast<double>(view.distance[at]);
      }
    }
    if (inverse <= 0.0) continue;
    const Eigen::Vector3d seen = T_world_camera * (*model->Unproject(*pixel) / inverse);
    const auto of_point = model->Project(T_later_world * place);
    const auto of_pixel = model->Project(T_later_world * seen);
    if (of_point && of_pixel) errors.push_back((*of_point - *of_pixel).norm());
  }
  ASSERT_GT(errors.size(), 1000U);
  std::nth_element(errors.begin(), errors.begin() + static_cast<int64_t>(errors.size() / 2),
                   errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.1);
}

TEST_F(LidarTest, RangesHaveTheirNoise) {
  LidarOptions exact;
  exact.range_sigma = 0.0;
  exact.dropout = 0.0;
  LidarOptions noisy = exact;
  noisy.range_sigma = 0.02;
  const LidarScan clean = LidarSimulator(exact, *scene_, motion_, 1, &pool_).Scan(9.0, 4);
  const LidarScan scan = LidarSimulator(noisy, *scene_, motion_, 1, &pool_).Scan(9.0, 4);
  ASSERT_EQ(clean.points.size(), scan.points.size());
  double squares = 0.0;
  for (size_t i = 0; i < scan.points.size(); ++i) {
    const double error = scan.points[i].position.norm() - clean.points[i].position.norm();
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(scan.points.size())), 0.02, 0.001);
}

TEST_F(LidarTest, LosesFivePercentWithinThirtyMetres) {
  LidarSimulator lidar(LidarOptions{}, *scene_, motion_, 1, &pool_);
  lidar.CalibrateDropout({0.0, 7.0, 14.0});
  double sum = 0.0;
  int scans = 0;
  for (double start = 1.0; start < 19.0; start += 3.0) sum += lidar.DropoutShare(start, scans++);
  EXPECT_NEAR(sum / scans, 0.05, 0.01);
}

SurfacePoint Level(const Photometry& photometry, float albedo, float sunlit) {
  SurfacePoint point;
  point.albedo = albedo;
  point.light = sunlit * photometry.sun().direction.z();
  return point;
}

TEST(Photometry, MoonIsBlackAboveAndBrightestInOpposition) {
  const Photometry moon("moon", SunOptions{}, 0.12);
  EXPECT_EQ(moon.Sky(Eigen::Vector3f(-1.0F, 0.0F, 0.3F).normalized()), 0.0F);
  const Eigen::Vector3f sun = moon.sun().direction;
  const Eigen::Vector3f mirrored(-sun.x(), -sun.y(), sun.z());
  const SurfacePoint lit = Level(moon, 0.12F, 1.0F);
  EXPECT_GT(moon.Ground(lit, sun), 1.5F * moon.Ground(lit, mirrored));
  EXPECT_EQ(moon.Ground(Level(moon, 0.12F, 0.0F), mirrored), 0.0F);
}

// Appelbaum & Flood 1990: at tau .5 and a zenith angle of 60 degrees .53 of the light is diffuse.
TEST(Photometry, MarsHasASkyThatSendsItsShareOfTheLight) {
  SunOptions sun;
  sun.elevation_deg = 30.0;
  sun.tau = 0.5;
  const Photometry mars("mars", sun, 0.2);
  double sky = 0.0;
  constexpr int kRays = 2000;
  for (int i = 0; i < kRays; ++i) {
    const double share = (i + 0.5) / kRays;
    const double angle = 2.399963 * i;
    sky += static_cast<double>(mars.SkyWithoutSun(
               Eigen::Vector3d(std::sqrt(share) * std::cos(angle),
                               std::sqrt(share) * std::sin(angle), std::sqrt(1.0 - share))
                   .cast<float>())) /
           kRays;
  }
  const double direct = std::exp(-sun.tau / 0.5) * 0.5;
  EXPECT_NEAR(sky / (sky + direct), 0.53, 0.06);
}

}  // namespace
}  // namespace regolith

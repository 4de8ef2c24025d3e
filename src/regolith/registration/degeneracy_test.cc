// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/degeneracy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

/// Ground of the given amplitude of relief, sampled by noisy points every 0.1 m.
std::vector<VoxelMap> GroundMap(double amplitude, double noise) {
  Random random(7);
  std::vector<Eigen::Vector3d> points;
  for (double x = -12.0; x <= 12.0; x += 0.1) {
    for (double y = -12.0; y <= 12.0; y += 0.1) {
      const double height = amplitude * (std::sin(0.6 * x) + std::cos(0.5 * y + 0.3 * x));
      points.emplace_back(x, y, height + random.Gaussian(0.0, noise));
    }
  }
  std::vector<VoxelMap> maps;
  maps.emplace_back(VoxelMapOptions());
  maps[0].Add(points, Eigen::Vector3d::Zero());
  return maps;
}

ObservableSystem Observe(double amplitude, double noise) {
  Random random(8);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 1500; ++i) {
    const double x = random.Uniform(-10, 10);
    const double y = random.Uniform(-10, 10);
    const double height = amplitude * (std::sin(0.6 * x) + std::cos(0.5 * y + 0.3 * x));
    points.emplace_back(x, y, height + random.Gaussian(0.0, noise));
  }
  ThreadPool threads(1);
  std::vector<PlaneMatch> planes;
  const std::vector<VoxelMap> maps = GroundMap(amplitude, noise);
  FindPlanes(points, SE3(), maps, {}, &threads, &planes);
  return RemoveDegenerateDirections(LinearizePointToPlane(points, planes, SE3(), {}, &threads),
                                    2.0);
}

TEST(Degeneracy, NoiseOnAPlaneIsNoInformation) {
  for (const double noise : {0.002, 0.01, 0.02}) {
    const ObservableSystem plane = Observe(0.0, noise);
    EXPECT_EQ(plane.degenerate_directions, 3) << noise;
    EXPECT_NEAR(plane.weakest_ratio, 1.0, 0.25) << noise;
    EXPECT_LT(std::abs(plane.weakest_position.z()), 0.1) << noise;
    EXPECT_LT(plane.information(3, 3), 1e-4 * plane.information(5, 5)) << noise;
  }
}

TEST(Degeneracy, ReliefIsInformation) {
  const ObservableSystem hills = Observe(0.3, 0.01);
  EXPECT_EQ(hills.degenerate_directions, 0);
  EXPECT_GT(hills.weakest_ratio, 10.0);
  const Matrix6d covariance = ObservedCovariance(hills);
  EXPECT_TRUE((covariance * hills.information).isIdentity(1e-6));
}

TEST(Degeneracy, TheCovarianceOfAPlaneIsZeroWhereItSaysNothing) {
  const ObservableSystem plane = Observe(0.0, 0.01);
  const Matrix6d covariance = ObservedCovariance(plane);
  EXPECT_GT(covariance(5, 5), 0.0);
  EXPECT_LT(covariance(3, 3), 1e-9);
}

TEST(Degeneracy, ADegenerateGradientIsLeftOut) {
  PointToPlaneSystem system;
  system.information = Matrix6d::Identity();
  system.noise = 0.8 * Matrix6d::Identity();
  system.noise(5, 5) = 0.01;
  system.gradient.setOnes();
  const ObservableSystem observable = RemoveDegenerateDirections(system, 2.0);
  EXPECT_EQ(observable.degenerate_directions, 5);
  EXPECT_LT(observable.gradient.head<5>().norm(), 1e-12);
  EXPECT_NEAR(observable.gradient[5], 1.0, 0.02);
  EXPECT_THROW(RemoveDegenerateDirections(system, 0.5), CheckError);
}

}  // namespace
}  // namespace regolith

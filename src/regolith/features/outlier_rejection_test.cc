// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/outlier_rejection.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kWidth = 640.0;
constexpr double kHeight = 480.0;
const double kFocal = 320.0 / std::tan(40.0 * M_PI / 180.0);  // 80 degrees across

/// How the camera moved, and over what.
struct Motion {
  const char* name;
  Eigen::Matrix3d R_second_first = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_second_first = Eigen::Vector3d::Zero();  ///< m
  double roughness = 0.12;  ///< share of the distance by which a point stands off the plane
};

Eigen::Matrix3d Rotation(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(degrees * M_PI / 180.0, axis).toRotationMatrix();
}

std::vector<Motion> Motions() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d slight = Rotation(1.5, y) * Rotation(0.7, x);
  return {{"forward", slight, {0.02, 0.05, -0.4}},
          {"sideways", slight, {-0.3, 0.02, 0.03}},
          {"turn and drive", Rotation(12.0, y), {0.1, 0.0, -0.25}},
          {"pure rotation", Rotation(9.0, y) * Rotation(4.0, x), Eigen::Vector3d::Zero()},
          {"at rest", Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()},
          {"plane", slight, {-0.25, 0.05, -0.2}, 0.0},
          {"rolled by 90 degrees", Rotation(90.0, z), {-0.2, 0.05, 0.05}},
          {"rolled by 180 degrees", Rotation(180.0, z), {0.1, 0.1, -0.1}},
          {"twice as near", Rotation(1.0, z), {0.0, 0.75, -0.75}}};
}

struct Scene {
  Correspondences matches;
  Eigen::Quaterniond R_second_first = Eigen::Quaterniond::Identity();
  std::vector<uint8_t> truth;  ///< 1 where the match is true
};

Eigen::Vector3d Bearing(const Eigen::Vector2f& pixel) {
  return Eigen::Vector3d((pixel.x() - kWidth / 2) / kFocal, (pixel.y() - kHeight / 2) / kFocal, 1.0)
      .normalized();
}

/// Rough ground seen from a mast 1.3 m high that looks 25 degrees down, every place known to half
/// a pixel; a share of the matches lead to anywhere in the second image.
Scene MakeScene(const Motion& motion, size_t size, double outlier_share, uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.R_second_first = Eigen::Quaterniond(motion.R_second_first);
  const Eigen::Vector3d down = Rotation(-25.0, Eigen::Vector3d::UnitX()) * Eigen::Vector3d::UnitY();
  const auto noisy = [&](double x, double y) {
    return Eigen::Vector2d(x + random.Gaussian(0.0, 0.5), y + random.Gaussian(0.0, 0.5))
        .cast<float>()
        .eval();
  };
  while (scene.truth.size() < size) {
    const double u = random.Uniform(0.0, kWidth);
    const double v = random.Uniform(0.0, kHeight);
    const Eigen::Vector3d ray((u - kWidth / 2) / kFocal, (v - kHeight / 2) / kFocal, 1.0);
    const double slope = ray.dot(down);
    const double distance = slope > 1.3 / 30.0 ? 1.3 / slope : 30.0;
    const Eigen::Vector3d point = ray * distance * (1.0 + motion.roughness * random.Gaussian());
    const Eigen::Vector3d moved = motion.R_second_first * point + motion.t_second_first;
    if (point.z() < 0.1 || moved.z() < 0.1) continue;
    const double u_second = kFocal * moved.x() / moved.z() + kWidth / 2;
    const double v_second = kFocal * moved.y() / moved.z() + kHeight / 2;
    if (u_second < 0.0 || v_second < 0.0 || u_second > kWidth || v_second > kHeight) continue;
    Eigen::Vector2f second = noisy(u_second, v_second);
    const bool outlier = random.Uniform() < outlier_share;
    if (outlier) second = noisy(random.Uniform(0.0, kWidth), random.Uniform(0.0, kHeight));
    scene.matches.first.push_back(noisy(u, v));
    scene.matches.second.push_back(second);
    scene.truth.push_back(outlier ? 0 : 1);
  }
  for (size_t i = 0; i < size; ++i) {
    scene.matches.first_bearings.push_back(Bearing(scene.matches.first[i]));
    scene.matches.second_bearings.push_back(Bearing(scene.matches.second[i]));
  }
  return scene;
}

OutlierRejection Reject(Scene scene, const std::string& model,
                        const OutlierRejectionOptions& options = {}) {
  std::optional<Eigen::Quaterniond> rotation;
  if (model == "rotation") rotation = scene.R_second_first;
  if (model == "fundamental") {
    scene.matches.first_bearings.clear();
    scene.matches.second_bearings.clear();
  }
  OutlierRejection result = RejectOutliers(scene.matches, kFocal, rotation, options);
  EXPECT_EQ(result.inliers.size(), scene.truth.size());
  EXPECT_EQ(result.inlier_count,
            std::count(result.inliers.begin(), result.inliers.end(), uint8_t{1}));
  return result;
}

struct Quality {
  double recall = 0.0;     ///< share of the true matches that were kept
  double precision = 0.0;  ///< share of the kept matches that are true
};

Quality Assess(const Scene& scene, const OutlierRejection& result) {
  double kept = 0.0;
  double kept_true = 0.0;
  double all_true = 0.0;
  for (size_t i = 0; i < scene.truth.size(); ++i) {
    kept += result.inliers[i];
    kept_true += result.inliers[i] * scene.truth[i];
    all_true += scene.truth[i];
  }
  return {kept_true / all_true, kept_true / kept};
}

const std::vector<std::string> kModels = {"fundamental", "essential", "rotation"};

TEST(OutlierRejection, KeepsTrueMatchesAndDropsFalseOnes) {
  for (const std::string& model : kModels) {
    for (const Motion& motion : Motions()) {
      for (const double share : {0.0, 0.2, 0.4}) {
        for (uint64_t seed = 1; seed <= 3; ++seed) {
          const Scene scene = MakeScene(motion, 500, share, seed);
          const OutlierRejection result = Reject(scene, model);
          EXPECT_EQ(result.model, model);
          const Quality quality = Assess(scene, result);
          EXPECT_GE(quality.recall, 0.97) << model << ", " << motion.name << ", " << share;
          EXPECT_GE(quality.precision, 0.98) << model << ", " << motion.name << ", " << share;
        }
      }
    }
  }
}

TEST(OutlierRejection, HoldsWhereMostMatchesAreFalse) {
  for (const std::string& model : kModels) {
    for (const Motion& motion : Motions()) {
      const Scene scene = MakeScene(motion, 500, 0.6, 9);
      const Quality quality = Assess(scene, Reject(scene, model));
      EXPECT_GE(quality.recall, 0.95) << model << ", " << motion.name;
      EXPECT_GE(quality.precision, 0.95) << model << ", " << motion.name;
    }
  }
}

TEST(OutlierRejection, HoldsForFewMatches) {
  for (const std::string& model : kModels) {
    const Scene scene = MakeScene(Motions()[1], 40, 0.2, 3);
    const Quality quality = Assess(scene, Reject(scene, model));
    EXPECT_GE(quality.recall, 0.85) << model;
    EXPECT_GE(quality.precision, 0.92) << model;
  }
}

TEST(OutlierRejection, NeighboursExposeFalseMatchesOnTheirEpipolarLine) {
  // Sideways motion: epipolar lines are rows, and a match moved along its row is on the line.
  const Motion motion = {"sideways", Eigen::Matrix3d::Identity(), {-0.3, 0.0, 0.0}};
  Scene scene = MakeScene(motion, 400, 0.0, 5);
  for (size_t i = 0; i < scene.truth.size(); i += 10) {
    scene.matches.second[i].x() += scene.matches.second[i].x() < 320.0F ? 250.0F : -250.0F;
    scene.matches.second_bearings[i] = Bearing(scene.matches.second[i]);
    scene.truth[i] = 0;
  }
  for (const std::string& model : kModels) {
    const Quality quality = Assess(scene, Reject(scene, model));
    EXPECT_GE(quality.recall, 0.97) << model;
    EXPECT_GE(quality.precision, 0.99) << model;
    OutlierRejectionOptions options;
    options.neighbours = 0;
    EXPECT_LE(Assess(scene, Reject(scene, model, options)).precision, 0.97) << model;
  }
}

TEST(OutlierRejection, IsDeterministic) {
  for (const std::string& model : kModels) {
    for (const Motion& motion : Motions()) {
      const Scene scene = MakeScene(motion, 300, 0.5, 2);
      EXPECT_EQ(Reject(scene, model).inliers, Reject(scene, model).inliers) << model;
    }
  }
}

TEST(OutlierRejection, FewerMatchesThanAskedForAreJudgedByTheirNeighboursAlone) {
  Scene scene = MakeScene(Motions()[1], 11, 0.0, 4);
  scene.matches.second[3] = {630.0F, 5.0F};
  scene.matches.first[3] = {300.0F, 400.0F};
  const OutlierRejection result = Reject(scene, "rotation");
  EXPECT_STREQ(result.model, "none");
  EXPECT_FALSE(result.inliers[3]);
  EXPECT_GE(result.inlier_count, 9);

  for (size_t size = 0; size < 8; ++size) {
    const OutlierRejection few = Reject(MakeScene(Motions()[1], size, 0.5, 4), "fundamental");
    EXPECT_EQ(few.inlier_count, static_cast<int>(size));
    EXPECT_STREQ(few.model, "none");
  }
}

TEST(OutlierRejection, NeverFailsOnDegenerateMatches) {
  for (const std::string& model : kModels) {
    Scene scene = MakeScene(Motions()[0], 60, 0.0, 4);
    const auto place_all = [&](const auto& first, const auto& second) {
      for (size_t i = 0; i < scene.truth.size(); ++i) {
        scene.matches.first[i] = first(static_cast<float>(i));
        scene.matches.second[i] = second(static_cast<float>(i));
        scene.matches.first_bearings[i] = Bearing(scene.matches.first[i]);
        scene.matches.second_bearings[i] = Bearing(scene.matches.second[i]);
      }
    };
    const auto same = [](float) { return Eigen::Vector2f(100.0F, 100.0F); };
    const auto line = [](float i) { return Eigen::Vector2f(3.0F * i, 50.0F + i); };
    scene.R_second_first.setIdentity();
    place_all(same, same);
    EXPECT_EQ(Reject(scene, model).inlier_count, 60) << model;
    place_all(line, line);
    EXPECT_EQ(Reject(scene, model).inlier_count, 60) << model;
    place_all(same, line);
    Reject(scene, model);
  }
}

TEST(OutlierRejection, MatchesThatAreNoNumbersOrLieBehindAreOutliers) {
  for (const std::string& model : kModels) {
    Scene scene = MakeScene(Motions()[1], 200, 0.0, 4);
    scene.matches.first[5].x() = NAN;
    scene.matches.second[6].y() = INFINITY;
    scene.matches.first_bearings[7] = {0.0, 0.6, -0.8};
    scene.matches.second_bearings[8] = {0.0, NAN, 1.0};
    const OutlierRejection result = Reject(scene, model);
    EXPECT_FALSE(result.inliers[5]) << model;
    EXPECT_FALSE(result.inliers[6]) << model;
    if (model != "fundamental") {
      EXPECT_FALSE(result.inliers[7]) << model;
      EXPECT_FALSE(result.inliers[8]) << model;
    }
    EXPECT_GE(result.inlier_count, 190) << model;
  }
}

TEST(OutlierRejection, RefusesRowsThatDoNotCorrespond) {
  Scene scene = MakeScene(Motions()[0], 20, 0.0, 4);
  scene.matches.first.pop_back();
  EXPECT_THROW(RejectOutliers(scene.matches, kFocal, {}, {}), CheckError);
  scene = MakeScene(Motions()[0], 20, 0.0, 4);
  scene.matches.second_bearings.pop_back();
  EXPECT_THROW(RejectOutliers(scene.matches, kFocal, {}, {}), CheckError);
}

}  // namespace
}  // namespace regolith

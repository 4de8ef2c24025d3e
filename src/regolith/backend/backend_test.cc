// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/backend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "regolith/backend/keyframe_selector.h"
#include "regolith/backend/test_ground_internal.h"
#include "regolith/core/check.h"

namespace regolith {
namespace {

/// One scan of a drive: where the rover is, and on which ground.
struct Moment {
  SE3 T_world_body;
  const TestGround* ground = nullptr;
};

struct Odometry {
  double yaw_drift = 0.0;        ///< rad a keyframe
  double scale = 1.0;            ///< of each step's length
  double rotation_sigma = 1e-3;  ///< rad a keyframe, as the odometry states it
  double position_sigma = 0.01;  ///< m a keyframe, likewise
};

std::vector<Moment> Laps(const TestGround& ground, int laps) {
  std::vector<Moment> drive;
  for (int lap = 0; lap < laps; ++lap) {
    for (const SE3& pose : OvalLap(ground, 0.6 * lap, lap % 2 == 1)) {
      drive.push_back({pose, &ground});
    }
  }
  return drive;
}

/// Runs a back end over a drive with an odometry that drifts as told.
class Driver {
 public:
  explicit Driver(const BackendOptions& options = BackendOptions())
      : threads_(2), selector_(options.keyframes), backend_(options, &threads_) {}

  void Drive(const std::vector<Moment>& drive, const Odometry& odometry) {
    Vector6d step_variances;
    step_variances << Eigen::Vector3d::Constant(std::pow(odometry.rotation_sigma, 2)),
        Eigen::Vector3d::Constant(std::pow(odometry.position_sigma, 2));
    for (const Moment& moment : drive) {
      if (!truth_.empty()) {
        SE3 step = truth_.back().Inverse() * moment.T_world_body;
        step.rotation = step.rotation * ExpSo3({0.0, 0.0, odometry.yaw_drift});
        step.translation *= odometry.scale;
        const Matrix6d adjoint = AdjointSe3(step.Inverse());
        covariance_ = adjoint * covariance_ * adjoint.transpose();
        covariance_.diagonal() += step_variances;
        T_odom_body_ = T_odom_body_ * step;
      } else {
        T_odom_body_ = moment.T_world_body;
      }
      truth_.push_back(moment.T_world_body);
      KeyframeInput input;
      input.time = FromSeconds(3.0 * static_cast<double>(truth_.size()));
      input.T_odom_body = T_odom_body_;
      input.covariance = ExpToPlusCovariance(covariance_, T_odom_body_);
      input.is_level = true;
      input.points_body = moment.ground->Scan(moment.T_world_body, truth_.size());
      odometry_.Append({input.time, T_odom_body_});
      EXPECT_TRUE(selector_.Select(input.time, input.T_odom_body));
      backend_.Add(input);
    }
  }

  /// Largest distance (m) of a keyframe from where it was.
  double Error(const Trajectory& trajectory) const {
    double error = 0.0;
    for (size_t i = 0; i < truth_.size(); ++i) {
      const SE3& pose = trajectory.poses()[i].T_world_body;
      error = std::max(error, (pose.translation - truth_[i].translation).norm());
    }
    return error;
  }

  Backend& backend() { return backend_; }
  const Trajectory& odometry() const { return odometry_; }
  Trajectory corrected() const { return backend_.Corrected(odometry_); }
  const std::vector<SE3>& truth() const { return truth_; }

 private:
  ThreadPool threads_;
  KeyframeSelector selector_;
  Backend backend_;
  std::vector<SE3> truth_;
  Trajectory odometry_;
  SE3 T_odom_body_;
  Matrix6d covariance_ = Matrix6d::Zero();
};

Odometry Drifting() {
  Odometry odometry;
  odometry.yaw_drift = 0.002;
  odometry.scale = 1.01;
  odometry.rotation_sigma = 0.004;
  odometry.position_sigma = 0.03;
  return odometry;
}

TEST(Backend, LoopsTakeTheDriftAwayThoughTheRoverFacesTheOtherWay) {
  const TestGround ground(MoonGround(), 1);
  Driver driver;
  driver.Drive(Laps(ground, 2), Drifting());
  EXPECT_GT(driver.Error(driver.odometry()), 0.6);
  EXPECT_LT(driver.Error(driver.corrected()), 0.35 * driver.Error(driver.odometry()));
  EXPECT_GT(driver.backend().loops_accepted(), 20U);
  for (const LoopRecord& loop : driver.backend().loops()) {
    if (loop.verdict.outcome != LoopOutcome::kAccepted) continue;
    const SE3 T_old_new =
        driver.truth()[loop.old_keyframe].Inverse() * driver.truth()[loop.new_keyframe];
    EXPECT_LT((loop.verdict.T_target_query.T_a_b.translation - T_old_new.translation).norm(), 0.15);
  }
}

TEST(Backend, AnOdometryThatIsRightIsLeftAlone) {
  const TestGround ground(MoonGround(), 2);
  Driver driver;
  driver.Drive(Laps(ground, 2), Odometry());
  EXPECT_GT(driver.backend().loops_accepted(), 20U);
  EXPECT_LT(driver.Error(driver.corrected()), 0.01);
}

TEST(Backend, OnExploredGroundNeitherGraphNorPointsGrow) {
  const TestGround ground(MoonGround(), 3);
  Driver driver;
  const std::vector<Moment> drive = Laps(ground, 3);
  const size_t lap = drive.size() / 3;
  driver.Drive({drive.begin(), drive.begin() + static_cast<std::ptrdiff_t>(2 * lap)}, Odometry());
  const size_t after_two = driver.backend().graph().active_node_count();
  driver.Drive({drive.begin() + static_cast<std::ptrdiff_t>(2 * lap), drive.end()}, Odometry());
  EXPECT_LE(driver.backend().graph().active_node_count(), after_two + lap / 3);
  EXPECT_LT(driver.Error(driver.corrected()), 0.05);
  size_t with_points = 0;
  for (size_t i = 0; i < driver.backend().keyframes().size(); ++i) {
    with_points += driver.backend().keyframes()[i].points_body.empty() ? 0 : 1;
  }
  EXPECT_EQ(with_points, driver.backend().graph().active_node_count());
}

TEST(Backend, ARunIsTheSameEachTime) {
  const TestGround ground(MoonGround(), 4);
  std::vector<Trajectory> runs;
  for (int run = 0; run < 2; ++run) {
    Driver driver;
    driver.Drive(Laps(ground, 2), Drifting());
    runs.push_back(driver.corrected());
  }
  for (size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0].poses()[i].T_world_body.translation,
              runs[1].poses()[i].T_world_body.translation);
  }
}

/// The most similar pairs of keyframes that are of different places.
std::vector<LoopCandidate> HardestPairs(const Driver& driver, const KeyframeStore& keyframes,
                                        size_t first_new, size_t end_new, bool same_ground,
                                        size_t count, std::vector<size_t>* new_keyframes) {
  struct Pair {
    double distance;
    size_t old_keyframe;
    size_t new_keyframe;
  };
  std::vector<Pair> pairs;
  for (size_t i = first_new; i < end_new; ++i) {
    for (size_t old = 0; old <= std::min<size_t>(i - 1, 30); ++old) {
      const double apart = (driver.truth()[i].translation - driver.truth()[old].translation).norm();
      if (same_ground && apart < 10.0) continue;
      pairs.push_back({PolarDistance(keyframes[i].descriptor, keyframes[old].descriptor), old, i});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  pairs.resize(std::min(pairs.size(), count));
  std::vector<LoopCandidate> candidates;
  for (const Pair& pair : pairs) {
    LoopCandidate candidate;
    candidate.old_keyframe = pair.old_keyframe;
    candidate.guess.position_radius = 3.0;
    candidate.guess.yaw_radius = 0.3;
    candidates.push_back(candidate);
    new_keyframes->push_back(pair.new_keyframe);
  }
  return candidates;
}

struct FalseLoopResult {
  int proposed = 0;
  int passed = 0;  ///< the lidar's verification and the odometry
  int accepted = 0;
  double bent = 0.0;  ///< m, error after all of it
  int revisits = 0;   ///< keyframes of the last lap
  int recalled = 0;   ///< of them, with an accepted loop
};

// A lap; a lap that odometry places on the same track, but on the ground of another seed (so that
// all its 34 proposals agree with each other); the same ground again, facing back. Odometry states
// so much doubt that it refuses nothing by itself.
FalseLoopResult TryFalseLoops(const TerrainOptions& terrain, uint64_t seed) {
  const TestGround ground(terrain, seed);
  const TestGround other(terrain, seed + 1000);
  Odometry odometry;
  odometry.rotation_sigma = 0.02;
  odometry.position_sigma = 0.2;
  BackendOptions options;
  options.search.max_candidates = 1;
  options.merge.enabled = false;
  Driver driver(options);
  FalseLoopResult result;
  // Around the change of ground submaps hold some of both: keyframes 31 to 36 make true loops too,
  // and the second lap ends where it began.
  constexpr size_t kWrongFrom = 37;
  constexpr size_t kWrongTo = 68;
  constexpr size_t kLastOld = 30;
  const auto is_wrong = [&](const LoopRecord& loop) {
    const bool is_other_ground = loop.new_keyframe >= kWrongFrom && loop.new_keyframe < kWrongTo &&
                                 loop.old_keyframe <= kLastOld;
    const double apart = (driver.truth()[loop.new_keyframe].translation -
                          driver.truth()[loop.old_keyframe].translation)
                             .norm();
    return is_other_ground || (loop.new_keyframe < kWrongFrom && apart > 10.0);
  };
  const auto count_wrong = [&] {
    for (const LoopRecord& loop : driver.backend().loops()) {
      if (!is_wrong(loop)) continue;
      const LoopOutcome outcome = loop.verdict.outcome;
      ++result.proposed;
      if (outcome == LoopOutcome::kAccepted) {
        ADD_FAILURE() << loop.old_keyframe << " to " << loop.new_keyframe << ", agreement "
                      << loop.verdict.agreement << " over " << loop.verdict.relief.runner_up;
      }
      result.accepted += outcome == LoopOutcome::kAccepted ? 1 : 0;
      result.passed += outcome == LoopOutcome::kAccepted || outcome == LoopOutcome::kInconsistent ||
                               outcome == LoopOutcome::kUnsupported
                           ? 1
                           : 0;
    }
  };
  driver.Drive(Laps(ground, 1), odometry);
  std::vector<Moment> elsewhere = Laps(ground, 1);
  for (Moment& moment : elsewhere) moment.ground = &other;
  driver.Drive(elsewhere, odometry);

  const KeyframeStore& keyframes = driver.backend().keyframes();
  std::vector<size_t> news;
  std::vector<LoopCandidate> wrong = HardestPairs(driver, keyframes, 20, 34, true, 40, &news);
  for (const LoopCandidate& candidate :
       HardestPairs(driver, keyframes, kWrongFrom, kWrongTo, false, 40, &news)) {
    wrong.push_back(candidate);
  }
  for (size_t i = 0; i < wrong.size(); ++i) driver.backend().TryLoop(wrong[i], news[i]);
  count_wrong();

  std::vector<Moment> back;
  for (const SE3& pose : OvalLap(ground, 0.6, true)) back.push_back({pose, &ground});
  const size_t before = driver.backend().loops().size();
  driver.Drive(back, odometry);
  result.bent = driver.Error(driver.corrected());
  result.revisits = static_cast<int>(back.size());
  const std::vector<LoopRecord>& loops = driver.backend().loops();
  for (size_t i = before; i < loops.size(); ++i) {
    result.recalled += loops[i].verdict.outcome == LoopOutcome::kAccepted ? 1 : 0;
  }
  return result;
}

void ExpectNoFalseLoop(const TerrainOptions& terrain, uint64_t seed) {
  const FalseLoopResult result = TryFalseLoops(terrain, seed);
  EXPECT_GE(result.proposed, 100);
  EXPECT_EQ(result.passed, 0);
  EXPECT_EQ(result.accepted, 0);
  EXPECT_LT(result.bent, 0.05);
  EXPECT_GE(result.recalled, result.revisits * 6 / 10);
  std::printf(
      "seed %d: %d false loops proposed, %d verified, %d accepted; %d of %d revisits; %.3f m\n",
      static_cast<int>(seed), result.proposed, result.passed, result.accepted, result.recalled,
      result.revisits, result.bent);
}

TEST(Backend, HardFalseLoopsAreRefusedOnTheMoon) { ExpectNoFalseLoop(MoonGround(), 11); }

// scripts/test.sh --long: other seeds, Mars, and ground with less to see.
TEST(Backend, HardFalseLoopsAreRefusedOnAllKindsOfGround) {
  if (std::getenv("REGOLITH_LONG_TESTS") == nullptr) GTEST_SKIP() << "a long test";
  TerrainOptions flat = MoonGround();
  flat.relief.slope_deg = 1.0;
  TerrainOptions dunes = MarsGround();
  dunes.rocks.law = RockLaw::kNone;
  dunes.ripples.mega_height = 0.1;
  for (uint64_t seed = 20; seed < 25; ++seed) {
    for (const TerrainOptions& terrain : {MoonGround(), MarsGround(), flat, dunes}) {
      ExpectNoFalseLoop(terrain, seed);
    }
  }
}

TEST(Backend, WithoutLoopsItGivesTheOdometryBack) {
  const TestGround ground(MoonGround(), 5);
  BackendOptions options;
  options.close_loops = false;
  Driver driver(options);
  driver.Drive(Laps(ground, 1), Drifting());
  const Trajectory corrected = driver.corrected();
  for (size_t i = 0; i < corrected.size(); ++i) {
    EXPECT_LT((corrected.poses()[i].T_world_body.translation -
               driver.odometry().poses()[i].T_world_body.translation)
                  .norm(),
              1e-9);
  }
  EXPECT_LT(driver.backend().T_world_odom().translation.norm(), 1e-9);
  EXPECT_TRUE(driver.backend().loops().empty());
}

TEST(Backend, PosesBetweenKeyframesFollowBoth) {
  ThreadPool threads(1);
  Backend backend(BackendOptions(), &threads);
  KeyframeSelector selector((KeyframeOptions()));
  const auto at = [](double x) { return SE3(Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}); };
  Trajectory odometry;
  for (int i = 0; i <= 20; ++i) {
    odometry.Append({FromSeconds(0.1 * i), at(0.1 * i)});
    if (!selector.Select(FromSeconds(0.1 * i), at(0.1 * i))) continue;
    KeyframeInput input;
    input.time = FromSeconds(0.1 * i);
    input.T_odom_body = at(0.1 * i);
    backend.Add(input);
  }
  ASSERT_EQ(backend.keyframes().size(), 3U);
  // A height from elsewhere lifts the second keyframe, and with it those around it.
  Matrix6d height = Matrix6d::Zero();
  height(5, 5) = 1e12;
  const SE3 raised(Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.5});
  backend.graph().AddFactor(MakePosePrior(1, raised, height));
  backend.graph().Solve();
  const Trajectory corrected = backend.Corrected(odometry);
  const auto lifted = [&](size_t i) { return corrected.poses()[i].T_world_body.translation.z(); };
  EXPECT_NEAR(lifted(0), 0.0, 1e-9);
  EXPECT_NEAR(lifted(10), 0.5, 1e-3);
  EXPECT_GT(lifted(5), 0.15);
  EXPECT_LT(lifted(5), 0.35);
  EXPECT_GT(lifted(6), lifted(5));
}

}  // namespace
}  // namespace regolith

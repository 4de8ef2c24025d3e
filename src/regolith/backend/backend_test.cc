// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/backend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "regolith/backend/keyframe_selector.h"
#include "regolith/backend/test_drive_internal.h"
#include "regolith/core/check.h"

namespace regolith {
namespace {

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

TEST(Backend, AMergedKeyframeStandsForTheOneThatItWasMergedInto) {
  const TestGround ground(MoonGround(), 3);
  Driver driver;
  driver.Drive(Laps(ground, 2), Odometry());
  Backend& backend = driver.backend();
  const size_t newest = backend.keyframes().size() - 1;
  size_t merged = newest;
  while (merged > 0 && !backend.graph().is_merged(merged)) --merged;
  ASSERT_GT(merged, 30U);
  // As if the newest stood there: the guess is right, but its place was left three keyframes ago.
  size_t near = 0;
  for (size_t i = 34; i <= merged; ++i) {
    const auto distance = [&](size_t k) {
      return (driver.truth()[k].translation - driver.truth()[newest].translation).norm();
    };
    if (backend.graph().is_merged(i) && (near == 0 || distance(i) < distance(near))) near = i;
  }
  LoopCandidate candidate;
  candidate.old_keyframe = near;
  candidate.guess.T_target_query = driver.truth()[near].Inverse() * driver.truth()[newest];
  backend.TryLoop(candidate, newest);
  EXPECT_EQ(backend.loops().back().old_keyframe, backend.graph().standing(near));
  EXPECT_LT(backend.loops().back().old_keyframe, 34U);
  EXPECT_NE(backend.loops().back().verdict.outcome, LoopOutcome::kTooLittleOverlap);
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

/// Two rounds of a square, 1 m a keyframe, with an odometry that turns too far; no lidar.
class ConfirmedLoops : public testing::Test {
 protected:
  static constexpr size_t kRound = 24;

  static SE3 Truth(size_t keyframe) {
    const double angle = 2.0 * M_PI * static_cast<double>(keyframe) / kRound;
    return {ExpSo3({0.0, 0.0, angle}), {4.0 * std::sin(angle), 4.0 - 4.0 * std::cos(angle), 0.0}};
  }

  void SetUp() override {
    BackendOptions options;
    options.close_loops = false;
    backend_ = std::make_unique<Backend>(options, &threads_);
    UncertainPose drift;
    for (size_t i = 0; i < 2 * kRound; ++i) {
      UncertainPose step;
      if (i > 0) step.T_a_b = Truth(i - 1).Inverse() * Truth(i);
      step.T_a_b.rotation = step.T_a_b.rotation * ExpSo3({0.0, 0.0, 0.004});
      step.covariance.diagonal().head<3>().setConstant(1e-4);
      step.covariance.diagonal().tail<3>().setConstant(1e-4);
      drift = Compose(drift, step);
      KeyframeInput input;
      input.time = FromSeconds(2.0 * static_cast<double>(i));
      input.T_odom_body = drift.T_a_b;
      input.covariance = ExpToPlusCovariance(drift.covariance, drift.T_a_b);
      backend_->Add(input);
    }
  }

  LoopMeasurement Loop(size_t new_keyframe) const {
    LoopMeasurement loop;
    loop.old_keyframe = new_keyframe - kRound;
    loop.new_keyframe = new_keyframe;
    loop.T_old_new.covariance.diagonal().head<3>().setConstant(4e-5);
    loop.T_old_new.covariance.diagonal().tail<3>().setConstant(2.5e-3);
    return loop;
  }

  double LastError() const {
    return (backend_->T_world_body(2 * kRound - 1).translation -
            backend_->T_world_body(kRound - 1).translation)
        .norm();
  }

  ThreadPool threads_{1};
  std::unique_ptr<Backend> backend_;
};

TEST_F(ConfirmedLoops, LoopsThatAgreeBendTheGraph) {
  ASSERT_GT(LastError(), 0.25);
  backend_->AddLoop(Loop(40));
  EXPECT_EQ(backend_->loops_accepted(), 0U);  // one alone is not believed
  for (const size_t keyframe : {42U, 44U, 46U}) backend_->AddLoop(Loop(keyframe));
  EXPECT_EQ(backend_->loops_accepted(), 4U);
  EXPECT_LT(LastError(), 0.15);
}

TEST_F(ConfirmedLoops, OneThatOdometryCannotHaveDrivenIsRefused) {
  for (const size_t keyframe : {40U, 42U, 44U}) backend_->AddLoop(Loop(keyframe));
  LoopMeasurement wrong = Loop(46);
  wrong.T_old_new.T_a_b.translation.x() = 6.0;
  backend_->AddLoop(wrong);
  EXPECT_EQ(backend_->loops_accepted(), 3U);
  EXPECT_EQ(backend_->loops().back().verdict.outcome, LoopOutcome::kInconsistent);
  EXPECT_LT(LastError(), 0.2);
}

}  // namespace
}  // namespace regolith

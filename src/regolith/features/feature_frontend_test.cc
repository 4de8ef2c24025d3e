// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/feature_frontend.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/random.h"
#include "regolith/features/lk_frontend.h"
#include "regolith/features/test_texture_internal.h"
#include "regolith/features/view_warp.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr TimeNs kStart = 1700000000000000000;
constexpr double kPeriod = 0.1;

TimeNs TimeOf(int frame) { return AddSeconds(kStart, kPeriod * frame); }

FeatureOptions OptionsOf(const std::string& name) {
  FeatureOptions options;
  options.frontend = name;
  options.max_keypoints = 300;
  return options;
}

CameraIntrinsics Pinhole() {
  CameraIntrinsics intrinsics;
  intrinsics.width = kWidth;
  intrinsics.height = kHeight;
  intrinsics.focal = {460.0, 460.0};
  intrinsics.principal_point = {0.5 * (kWidth - 1), 0.5 * (kHeight - 1)};
  return intrinsics;
}

/// A camera above a plane of spots that drifts and turns, with the truth of it.
class Sequence {
 public:
  explicit Sequence(uint64_t seed) : texture_(seed) {}

  static Eigen::Vector2d Shift(int frame) { return {4.3 * frame, -1.7 * frame}; }
  static double Turn(int frame) { return 0.01 * frame; }

  Image At(int frame) const { return texture_.View(kWidth, kHeight, Shift(frame), Turn(frame)); }

  /// The place on the plane that a pixel shows.
  Eigen::Vector2d Place(int frame, const Eigen::Vector2f& pixel) const {
    return texture_.InTexture(kWidth, kHeight, pixel.cast<double>(), Shift(frame), Turn(frame));
  }

 private:
  TestTexture texture_;
};

TrackedFrame TrackAt(FeatureFrontend& frontend, int frame, const Image& image,
                     const Image* mask = nullptr) {
  FrontendInput input;
  input.time = TimeOf(frame);
  input.image = &image;
  input.mask = mask;
  return frontend.Track(input);
}

std::set<int64_t> Ids(const TrackedFrame& frame) {
  std::set<int64_t> ids;
  for (const TrackedFeature& feature : frame.features) ids.insert(feature.id);
  return ids;
}

void CheckFrame(const TrackedFrame& frame, const FeatureOptions& options) {
  EXPECT_LE(frame.features.size(), static_cast<size_t>(options.max_keypoints));
  EXPECT_EQ(Ids(frame).size(), frame.features.size());
  EXPECT_TRUE(std::is_sorted(frame.features.begin(), frame.features.end(),
                             [](const auto& a, const auto& b) { return a.id < b.id; }));
  const FrontendStatus& status = frame.status;
  EXPECT_EQ(status.tracked + status.recovered + status.started,
            static_cast<int>(frame.features.size()));
  if (frame.descriptors.type != DescriptorType::kNone) {
    EXPECT_EQ(frame.descriptors.size(), frame.features.size());
  }
  EXPECT_FALSE(frame.stages.empty());
  for (const StageTime& stage : frame.stages) {
    EXPECT_EQ(stage.name.rfind("features_", 0), 0U) << stage.name;
  }
}

class Frontends : public testing::TestWithParam<std::string> {
 protected:
  FeatureOptions options_ = OptionsOf(GetParam());
  std::unique_ptr<FeatureFrontend> frontend_ =
      FeatureFrontend::Create(options_, nullptr, std::nullopt);
};

TEST_P(Frontends, FollowPlacesOverManyFrames) {
  const Sequence sequence(1);
  std::map<int64_t, Eigen::Vector2d> first_places;
  TrackedFrame frame;
  int drifted = 0;
  for (int i = 0; i < 20; ++i) {
    frame = TrackAt(*frontend_, i, sequence.At(i));
    CheckFrame(frame, options_);
    for (const TrackedFeature& feature : frame.features) {
      const Eigen::Vector2d place = sequence.Place(i, feature.pixel);
      const auto [entry, is_new] = first_places.try_emplace(feature.id, place);
      EXPECT_EQ(is_new, feature.age == 1);
      if ((place - entry->second).norm() > 3.0) ++drifted;
    }
  }
  int long_tracks = 0;
  double speed_error = 0.0;
  for (const TrackedFeature& feature : frame.features) {
    if (feature.age >= 15) ++long_tracks;
    if (feature.age < 2 || feature.recovered) continue;
    // The middle moves by −R(−turn) shift a frame; the turn adds up to 3 pixels elsewhere.
    const Eigen::Vector2d expected =
        Eigen::Rotation2Dd(-Sequence::Turn(19)) * Eigen::Vector2d(-43.0, 17.0);
    speed_error = std::max(speed_error, (feature.velocity - expected).norm());
  }
  RecordProperty("long_tracks", long_tracks);
  RecordProperty("drifted", drifted);
  RecordProperty("mean_age_tenths", static_cast<int>(10.0 * frame.status.mean_age));
  // ORB finds two thirds of its corners again, and those of coarse levels to some pixels.
  const bool flow = GetParam() == "st_lk";
  EXPECT_GT(long_tracks, flow ? 180 : 12);
  EXPECT_LT(drifted, flow ? 10 : 250);  // of some 5500
  EXPECT_LT(speed_error, 90.0);
  EXPECT_GT(frame.status.mean_age, flow ? 12.0 : 4.0);
}

TEST_P(Frontends, SpreadFeaturesAndCountTheCells) {
  const Sequence sequence(2);
  TrackedFrame frame;
  for (int i = 0; i < 5; ++i) frame = TrackAt(*frontend_, i, sequence.At(i));
  EXPECT_EQ(frame.status.detection.cells, 48);
  EXPECT_GE(frame.status.detection.cells_filled, 46);
  EXPECT_GT(frame.features.size(), 240U);
}

TEST_P(Frontends, KeepOffTheMask) {
  const Sequence sequence(3);
  Image mask = FlatImage(kWidth, kHeight, 255);
  std::fill(mask.data.begin() + 300 * kWidth, mask.data.end(), uint8_t{0});
  for (int i = 0; i < 5; ++i) {
    const TrackedFrame frame = TrackAt(*frontend_, i, sequence.At(i), &mask);
    EXPECT_GT(frame.features.size(), 100U);
    for (const TrackedFeature& feature : frame.features) EXPECT_LT(feature.pixel.y(), 299.6F);
  }
  const Image other = FlatImage(10, 10, 255);
  EXPECT_THROW(TrackAt(*frontend_, 6, sequence.At(6), &other), CheckError);
}

TEST_P(Frontends, GiveTheSameForTheSameImages) {
  const Sequence sequence(4);
  const auto other = FeatureFrontend::Create(options_, nullptr, std::nullopt);
  for (int i = 0; i < 6; ++i) {
    const Image image = sequence.At(i);
    const TrackedFrame first = TrackAt(*frontend_, i, image);
    const TrackedFrame second = TrackAt(*other, i, image);
    ASSERT_EQ(first.features.size(), second.features.size());
    EXPECT_EQ(first.descriptors.bits, second.descriptors.bits);
    for (size_t k = 0; k < first.features.size(); ++k) {
      EXPECT_EQ(first.features[k].id, second.features[k].id);
      EXPECT_EQ(first.features[k].pixel, second.features[k].pixel);
      EXPECT_EQ(first.features[k].velocity, second.features[k].velocity);
    }
  }
}

TEST_P(Frontends, SurviveEmptyAndTinyImages) {
  const Sequence sequence(5);
  int frame = 0;
  EXPECT_EQ(TrackAt(*frontend_, frame++, FlatImage(1, 1, 0)).features.size(), 0U);
  EXPECT_EQ(TrackAt(*frontend_, frame++, FlatImage(0, 0, 0)).features.size(), 0U);
  EXPECT_GT(TrackAt(*frontend_, frame, sequence.At(frame)).features.size(), 0U);
  ++frame;
  EXPECT_EQ(TrackAt(*frontend_, frame++, FlatImage(kWidth, kHeight, 0)).features.size(), 0U);
  EXPECT_EQ(TrackAt(*frontend_, frame++, FlatImage(kWidth, kHeight, 255)).features.size(), 0U);
  EXPECT_GT(TrackAt(*frontend_, frame, sequence.At(frame)).features.size(), 0U);
  Image broken = FlatImage(kWidth, kHeight, 0);
  broken.data.pop_back();
  EXPECT_THROW(TrackAt(*frontend_, ++frame, broken), InputError);
}

TEST_P(Frontends, StartAnewWhereSizeOrTimeBreakTheStream) {
  const Sequence sequence(6);
  const std::set<int64_t> before = Ids(TrackAt(*frontend_, 5, sequence.At(0)));
  const auto expect_new = [&](const TrackedFrame& frame) {
    EXPECT_EQ(frame.status.tracked, 0);
    EXPECT_EQ(frame.status.recovered, 0);
    for (const TrackedFeature& feature : frame.features) {
      EXPECT_EQ(before.count(feature.id), 0U);
      EXPECT_EQ(feature.velocity, Eigen::Vector2d::Zero());
    }
  };
  expect_new(TrackAt(*frontend_, 5, sequence.At(0)));  // the same time
  expect_new(TrackAt(*frontend_, 2, sequence.At(1)));  // earlier
  expect_new(TrackAt(*frontend_, 3, TestTexture(6).View(320, 240, {0, 0})));
  frontend_->Reset();
  expect_new(TrackAt(*frontend_, 4, TestTexture(6).View(320, 240, {0, 0})));
  EXPECT_GT(TrackAt(*frontend_, 5, TestTexture(6).View(320, 240, {1, 0})).status.tracked, 30);
}

// The picture shifts sideways without a turn; a window in its middle shows what goes another way.
TEST_P(Frontends, RejectWhatMovesOnItsOwn) {
  const auto camera = CameraModel::Create(Pinhole());
  const auto frontend = FeatureFrontend::Create(options_, camera.get(), std::nullopt);
  const TestTexture texture(7);
  const TestTexture other(70);
  int rejected = 0;
  int strayed = 0;
  for (int i = 0; i < 8; ++i) {
    Image image = texture.View(kWidth, kHeight, {5.0 * i, 0.0});
    const Image moving = other.View(kWidth, kHeight, {-4.0 * i, 9.0 * i});
    for (int row = 170; row < 310; ++row) {
      std::copy(moving.data.begin() + row * kWidth + 230, moving.data.begin() + row * kWidth + 410,
                image.data.begin() + row * kWidth + 230);
    }
    FrontendInput input;
    input.time = TimeOf(i);
    input.image = &image;
    input.R_previous_current = Eigen::Quaterniond::Identity();
    const TrackedFrame frame = frontend->Track(input);
    rejected += frame.status.rejected;
    for (const TrackedFeature& feature : frame.features) {
      if (feature.age == 1 || feature.recovered) continue;
      if ((feature.velocity - Eigen::Vector2d(40.0, -90.0)).norm() < 30.0) ++strayed;
    }
  }
  RecordProperty("rejected", rejected);
  RecordProperty("strayed", strayed);
  EXPECT_GT(rejected, 30);
  EXPECT_LT(strayed, rejected / 10);
}

TEST_P(Frontends, KnowTheBearingsOfTheirCamera) {
  const auto camera = CameraModel::Create(Pinhole());
  const auto frontend = FeatureFrontend::Create(options_, camera.get(), std::nullopt);
  const Sequence sequence(8);
  for (int i = 0; i < 3; ++i) {
    for (const TrackedFeature& feature : TrackAt(*frontend, i, sequence.At(i)).features) {
      EXPECT_NEAR(feature.bearing.norm(), 1.0, 1e-9);
      EXPECT_LT((*camera->Project(feature.bearing) - feature.pixel.cast<double>()).norm(), 1e-3);
    }
  }
  EXPECT_THROW(TrackAt(*frontend, 3, FlatImage(320, 240, 7)), InputError);
}

// The camera turns by 90 pixels a frame: further than is searched around the last place.
TEST_P(Frontends, FollowAFastTurnThatIsKnown) {
  CameraIntrinsics intrinsics = Pinhole();
  intrinsics.focal = {2000.0, 2000.0};  // so narrow that a turn is nearly a shift
  const auto camera = CameraModel::Create(intrinsics);
  const TestTexture texture(9);
  int known = 0;
  for (const bool tell : {true, false}) {
    const auto frontend = FeatureFrontend::Create(options_, camera.get(), std::nullopt);
    for (int i = 0; i < 4; ++i) {
      const Image image = texture.View(kWidth, kHeight, {90.0 * i, 0.0});
      FrontendInput input;
      input.time = TimeOf(i);
      input.image = &image;
      // The picture moves to the left, so the camera turns to the right, about its y axis.
      if (tell) {
        input.R_previous_current =
            Eigen::Quaterniond(ExpSo3(Eigen::Vector3d(0.0, std::atan(90.0 / 2000.0), 0.0)));
      }
      const TrackedFrame frame = frontend->Track(input);
      if (i == 0) continue;
      if (tell) {
        EXPECT_GT(frame.status.tracked, 100);
        known += frame.status.tracked;
      } else {
        known -= frame.status.tracked;
      }
    }
  }
  EXPECT_GT(known, 300);
}

TEST_P(Frontends, MatchPairsApartFromTheStream) {
  const Sequence sequence(10);
  const Image first = sequence.At(0);
  const Image second = sequence.At(3);
  const PairMatches pair = frontend_->MatchPair(first, second);
  ASSERT_EQ(pair.inliers.size(), pair.matches.size());
  int right = 0;
  int inliers = 0;
  for (size_t i = 0; i < pair.matches.size(); ++i) {
    if (pair.inliers[i] == 0) continue;
    ++inliers;
    const auto& one = pair.first.pixels[static_cast<size_t>(pair.matches[i].first)];
    const auto& other = pair.second.pixels[static_cast<size_t>(pair.matches[i].second)];
    right += (sequence.Place(0, one) - sequence.Place(3, other)).norm() < 3.0 ? 1 : 0;
  }
  EXPECT_GT(inliers, 80);
  EXPECT_GT(right, 0.97 * inliers);
  std::set<std::string> names;
  for (const StageTime& stage : pair.stages) names.insert(stage.name);
  EXPECT_EQ(names.size(), pair.stages.size());
  EXPECT_EQ(names.count("match") + names.count("reject"), 2U);
  TrackAt(*frontend_, 0, first);
  const PairMatches again = frontend_->MatchPair(first, second);
  EXPECT_EQ(again.second.pixels, pair.second.pixels);
  EXPECT_EQ(again.inliers, pair.inliers);
  EXPECT_GT(TrackAt(*frontend_, 1, sequence.At(1)).status.tracked, 100);
  EXPECT_EQ(frontend_->MatchPair(FlatImage(1, 1, 0), second).matches.size(), 0U);
  EXPECT_EQ(frontend_->MatchPair(first, FlatImage(kWidth, kHeight, 0)).matches.size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(All, Frontends, testing::Values("orb", "st_lk"));

/// How many of a pair's inliers are right within 3 pixels, by the homography between the images.
int CountRight(const PairMatches& pair, const Eigen::Matrix3d& H_second_first) {
  int right = 0;
  for (size_t i = 0; i < pair.matches.size(); ++i) {
    const Eigen::Vector2d one =
        pair.first.pixels[static_cast<size_t>(pair.matches[i].first)].cast<double>();
    const Eigen::Vector2d other =
        pair.second.pixels[static_cast<size_t>(pair.matches[i].second)].cast<double>();
    const Eigen::Vector2d expected = (H_second_first * one.homogeneous()).hnormalized();
    right += pair.inliers[i] != 0 && (expected - other).norm() < 3.0 ? 1 : 0;
  }
  return right;
}

// Whichever image is the farther one.
TEST(MatchingFrontend, LooksAgainAtGroundThatTheWayAheadStretches) {
  const Image farther = TestTexture(21).View(kWidth, kHeight, Eigen::Vector2d::Zero());
  const Eigen::Matrix3d H_near_far =
      (Eigen::Matrix3d() << 1.1, 0.0, -32.0, 0.0, 1.5, -120.0, 0.0, 0.0, 1.0).finished();
  const Image nearer = WarpImage(farther, H_near_far, kWidth, kHeight, 0).image;
  FeatureOptions options = OptionsOf("orb");
  const auto twice = FeatureFrontend::Create(options, nullptr, std::nullopt);
  options.matcher.second_look = false;
  const auto once = FeatureFrontend::Create(options, nullptr, std::nullopt);
  const int right_once = CountRight(once->MatchPair(farther, nearer), H_near_far);
  const PairMatches pair = twice->MatchPair(farther, nearer);
  testing::Test::RecordProperty("right_once", right_once);
  testing::Test::RecordProperty("right_twice", CountRight(pair, H_near_far));
  EXPECT_GT(CountRight(pair, H_near_far), 2 * right_once);
  EXPECT_GT(CountRight(twice->MatchPair(nearer, farther), H_near_far.inverse()), 2 * right_once);
  EXPECT_LE(pair.first.size(), static_cast<size_t>(options.max_keypoints));
  EXPECT_EQ(pair.looked_again, 1);
  EXPECT_EQ(twice->MatchPair(nearer, farther).looked_again, 2);
  EXPECT_EQ(once->MatchPair(farther, nearer).looked_again, 0);
  for (const Eigen::Vector2f& pixel : pair.first.pixels) {
    EXPECT_GE(pixel.minCoeff(), 0.0F);
    EXPECT_LT(pixel.x(), static_cast<float>(kWidth));
    EXPECT_LT(pixel.y(), static_cast<float>(kHeight));
  }
}

/// Shi–Tomasi's corners with descriptors of the place that they show: what a perfect network would
/// say.
class PlaceExtractor final : public FeatureExtractor {
 public:
  PlaceExtractor(const Sequence* sequence, const int* frame)
      : sequence_(sequence), frame_(frame), corners_(Create(OptionsOf("st_lk"), std::nullopt)) {}

  void Extract(const Image& image, const Image* mask, int max_keypoints,
               FeatureSet* features) override {
    corners_->Extract(image, mask, max_keypoints, features);
    features->descriptors = Describe(features->pixels);
  }

  Descriptors Describe(const std::vector<Eigen::Vector2f>& pixels) const override {
    Descriptors descriptors;
    descriptors.type = DescriptorType::kFloat;
    descriptors.dimension = 64;
    for (const Eigen::Vector2f& pixel : pixels) {
      const Eigen::Vector2d place = sequence_->Place(*frame_, pixel);
      for (uint64_t i = 0; i < 32; ++i) {
        // Waves of random directions, some 20 pixels long.
        const Eigen::Vector2d wave(0.3 * HashGaussian(1, i), 0.3 * HashGaussian(2, i));
        descriptors.values.push_back(static_cast<float>(std::cos(wave.dot(place)) / 5.7));
        descriptors.values.push_back(static_cast<float>(std::sin(wave.dot(place)) / 5.7));
      }
    }
    return descriptors;
  }

  const DetectionStatus& status() const override { return corners_->status(); }
  const std::vector<StageTime>& stages() const override { return corners_->stages(); }
  void Reset() override {}

 private:
  const Sequence* sequence_;
  const int* frame_;
  std::unique_ptr<FeatureExtractor> corners_;
};

// For three frames the right half shows nothing.
void FindHiddenTracksAgain(FeatureFrontend& frontend, const Sequence& sequence, int* current) {
  std::map<int64_t, Eigen::Vector2d> hidden;
  int right = 0;
  int wrong = 0;
  for (int i = 0; i < 9; ++i) {
    *current = i;
    Image image = sequence.At(i);
    if (i >= 4 && i < 7) {
      for (int row = 0; row < kHeight; ++row) {
        std::fill(image.data.begin() + row * kWidth + kWidth / 2,
                  image.data.begin() + (row + 1) * kWidth, uint8_t{20});
      }
    }
    const TrackedFrame frame = TrackAt(frontend, i, image);
    CheckFrame(frame, OptionsOf("orb"));
    for (const TrackedFeature& feature : frame.features) {
      if (i == 3 && feature.pixel.x() > 360.0F && feature.age >= 3) {
        hidden.emplace(feature.id, sequence.Place(i, feature.pixel));
      }
      if (i != 7 || !feature.recovered || hidden.count(feature.id) == 0) continue;
      (sequence.Place(i, feature.pixel) - hidden[feature.id]).norm() < 4.0 ? ++right : ++wrong;
    }
  }
  testing::Test::RecordProperty("hidden", static_cast<int>(hidden.size()));
  testing::Test::RecordProperty("right", right);
  testing::Test::RecordProperty("wrong", wrong);
  EXPECT_GT(right, static_cast<int>(hidden.size()) / 3);
  EXPECT_LE(wrong, right / 20);
}

TEST(MatchingFrontend, FindsTracksAgainThatWereHidden) {
  const auto frontend = FeatureFrontend::Create(OptionsOf("orb"), nullptr, std::nullopt);
  int frame = 0;
  FindHiddenTracksAgain(*frontend, Sequence(11), &frame);
}

TEST(LkFrontend, FindsTracksAgainThatWereHidden) {
  const Sequence sequence(11);
  int frame = 0;
  const auto frontend = CreateLkFrontend(OptionsOf("st_lk"), nullptr,
                                         std::make_unique<PlaceExtractor>(&sequence, &frame));
  FindHiddenTracksAgain(*frontend, sequence, &frame);
}

TEST(MatchingFrontend, ForgetsWhatWasLostForLong) {
  const Sequence sequence(12);
  FeatureOptions options = OptionsOf("orb");
  options.memory.frames = 2;
  const auto frontend = FeatureFrontend::Create(options, nullptr, std::nullopt);
  TrackAt(*frontend, 0, sequence.At(0));
  int frame = 1;
  for (; frame <= 3; ++frame) TrackAt(*frontend, frame, FlatImage(kWidth, kHeight, 9));
  EXPECT_EQ(TrackAt(*frontend, frame, sequence.At(0)).status.recovered, 0);
}

TEST(FeatureFrontend, NamesWhatItCannotMake) {
  EXPECT_THROW(FeatureFrontend::Create(OptionsOf("sift"), nullptr, std::nullopt), CheckError);
  EXPECT_THROW(FeatureFrontend::Create(OptionsOf("ghost_lk"), nullptr, std::nullopt), InputError);
}

}  // namespace
}  // namespace regolith

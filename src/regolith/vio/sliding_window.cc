// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/sliding_window.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/median.h"
#include "regolith/factors/imu_factor.h"
#include "regolith/factors/normal_equations.h"
#include "regolith/factors/relative_pose_factor.h"
#include "regolith/factors/reprojection_factor.h"
#include "regolith/factors/scalar_factor.h"
#include "regolith/factors/stereo_factor.h"
#include "regolith/factors/wheel_motion_factor.h"
#include "regolith/factors/zero_velocity_factor.h"
#include "regolith/vio/triangulation.h"

namespace regolith {
namespace {

/// Noise of samples that a gap or saturation spoils: rates and forces may be anything that a rover
/// does.
constexpr double kDoubtfulRate = 0.1;   // rad/s/√Hz
constexpr double kDoubtfulForce = 0.3;  // of gravity, 1/√Hz
/// While a rover stands, this much of it says all.
constexpr double kLongestRest = 2.0;  // s
/// A landmark this far off is as good as at infinity; one behind the camera is wrong.
constexpr double kFarthest = 1e4;  // m
constexpr double kNearest = 0.05;  // m

void Add(const WindowResidual& residual, NormalEquations* equations) {
  equations->Add(*residual.factor, residual.loss.get(), residual.blocks);
}

void Add(Landmark* landmark, NormalEquations* equations) {
  equations->BeginLandmark(&landmark->inverse_distance);
  for (const LandmarkSighting& sighting : landmark->sightings) {
    for (const WindowResidual& residual : sighting.residuals) Add(residual, equations);
  }
  equations->EndLandmark();
}

}  // namespace

SlidingWindow::SlidingWindow(const VioOptions& options, const VioCalibration& calibration)
    : options_(options),
      calibration_(calibration),
      visual_loss_(std::make_shared<ceres::CauchyLoss>(options.loss_scale)),
      wheel_loss_(std::make_shared<ceres::HuberLoss>(options.wheel.loss_scale)),
      T_imu_camera_(ToPoseBlock(calibration.T_imu_camera)),
      T_imu_right_(ToPoseBlock(calibration.T_imu_right.value_or(SE3()))) {}

std::vector<std::pair<double*, int>> SlidingWindow::SharedBlocks() {
  std::vector<std::pair<double*, int>> blocks = {{tilt_.data(), kTiltBlockSize}};
  if (options_.refine_extrinsics) blocks.emplace_back(T_imu_camera_.data(), kPoseBlockSize);
  if (refines_time_offset()) blocks.emplace_back(&time_offset_, 1);
  return blocks;
}

std::vector<std::pair<double*, int>> SlidingWindow::FixedBlocks() {
  std::vector<std::pair<double*, int>> blocks = {{T_imu_right_.data(), kPoseBlockSize}};
  if (!options_.refine_extrinsics) blocks.emplace_back(T_imu_camera_.data(), kPoseBlockSize);
  if (!refines_time_offset()) blocks.emplace_back(&time_offset_, 1);
  return blocks;
}

void SlidingWindow::Stop() {
  for (const auto& left : frames_) history_.Move(left->record, FromPoseBlock(left->pose.data()));
  frames_.clear();
  landmarks_.clear();
}

void SlidingWindow::Start(const NavState& state, const Eigen::Vector2d& tilt,
                          const StartUncertainty& sigma, TimeNs stamp) {
  Stop();
  frames_.push_back(std::make_unique<WindowFrame>());
  WindowFrame& frame = newest();
  frame.stamp = stamp;
  frame.time = state.time;
  frame.time_offset = time_offset_;
  frame.SetState(state);
  frame.is_keyframe = true;
  frame.record = history_.Add(frame.time, state.T_world_imu);
  tilt_ = tilt;

  prior_ = LinearPrior();
  std::vector<double> sigmas;
  const auto know = [&](double* block, int size, const std::vector<double>& block_sigmas) {
    prior_.blocks.push_back({block, Eigen::Map<Eigen::VectorXd>(block, size)});
    sigmas.insert(sigmas.end(), block_sigmas.begin(), block_sigmas.end());
  };
  const double r = sigma.rotation;
  const double p = sigma.position;
  const double v = sigma.velocity;
  const double g = sigma.gyro_bias;
  const double a = sigma.accelerometer_bias;
  know(frame.pose.data(), kPoseBlockSize, {r, r, r, p, p, p});
  know(frame.motion.data(), kMotionBlockSize, {v, v, v, g, g, g, a, a, a});
  if (uses_slip()) know(&frame.slip, 1, {options_.wheel.slip_sigma});
  know(tilt_.data(), kTiltBlockSize, {sigma.tilt, sigma.tilt});
  if (options_.refine_extrinsics) {
    const double rotation = options_.extrinsics_rotation_sigma;
    const double position = options_.extrinsics_position_sigma;
    know(T_imu_camera_.data(), kPoseBlockSize,
         {rotation, rotation, rotation, position, position, position});
  }
  if (refines_time_offset()) know(&time_offset_, 1, {calibration_.time_offset_sigma});
  const Eigen::VectorXd root =
      Eigen::Map<const Eigen::VectorXd>(sigmas.data(), static_cast<Eigen::Index>(sigmas.size()))
          .cwiseInverse();
  prior_.jacobian = root.asDiagonal();
  prior_.residual = Eigen::VectorXd::Zero(root.size());
  SetPriorFactor();
}

void SlidingWindow::SetPriorFactor() {
  prior_factor_ = std::make_shared<LinearPriorFactor>(prior_);
  prior_blocks_.clear();
  for (const LinearisedBlock& block : prior_.blocks) prior_blocks_.push_back(block.block);
}

std::optional<WindowResidual> SlidingWindow::PriorResidual() const {
  if (!prior_factor_) return std::nullopt;
  return WindowResidual{prior_factor_, nullptr, prior_blocks_};
}

void SlidingWindow::Append(TimeNs stamp, TimeNs time, FrameMotion motion,
                           Span<const WheelOdometry> wheels) {
  auto frame = std::make_unique<WindowFrame>();
  frame->stamp = stamp;
  frame->time = time;
  frame->time_offset = time_offset_;
  frame->since = std::move(motion);
  frame->at_rest = frame->since.at_rest;
  if (!newest().is_keyframe) {
    frame->since.Prepend(newest().since);
    ForgetFrame(&newest());
    const WindowFrame& keyframe = *frames_[frames_.size() - 2];
    history_.Attach(
        newest().record, keyframe.record,
        FromPoseBlock(keyframe.pose.data()).Inverse() * FromPoseBlock(newest().pose.data()));
    frames_.pop_back();
  }
  if (frame->since.at_rest) frame->since.KeepLast(kLongestRest);
  const WindowFrame& before = *frames_.back();
  frame->slip = before.slip;
  if (uses_slip()) {
    frame->since.way =
        IntegrateWheelWay(wheels, frame->since.samples, calibration_.T_imu_base->rotation,
                          before.motion.segment<3>(3));
  }
  Preintegrate(before, frame.get());
  frame->SetState(frame->inertial->Predict(before.State(), gravity_world()));
  frame->record = history_.Add(time, FromPoseBlock(frame->pose.data()));
  frames_.push_back(std::move(frame));
  BuildMotionResiduals(frames_[frames_.size() - 2].get(), &newest());
}

void SlidingWindow::Preintegrate(const WindowFrame& before, WindowFrame* frame) const {
  ImuNoise noise = calibration_.noise;
  noise.gyro_density *= options_.noise_inflation;
  noise.accelerometer_density *= options_.noise_inflation;
  if (frame->since.is_doubtful) {
    noise.gyro_density = kDoubtfulRate;
    noise.accelerometer_density = kDoubtfulForce * calibration_.gravity;
  }
  frame->inertial.emplace(noise, before.motion.segment<3>(3), before.motion.segment<3>(6));
  frame->inertial->Integrate(frame->since.samples);
}

void SlidingWindow::BuildMotionResiduals(WindowFrame* before, WindowFrame* frame) {
  frame->residuals.clear();
  frame->residuals.push_back({std::make_shared<ImuFactor>(*frame->inertial, calibration_.gravity),
                              nullptr,
                              {before->pose.data(), before->motion.data(), frame->pose.data(),
                               frame->motion.data(), tilt_.data()}});
  if (uses_slip()) AddWheelResiduals(before, frame);
  AddRestResiduals(before, frame);
}

void SlidingWindow::AddWheelResiduals(WindowFrame* before, WindowFrame* frame) {
  const double seconds = frame->inertial->duration();
  const double walk = options_.wheel.slip_walk * std::sqrt(seconds);
  frame->residuals.push_back(
      {std::make_shared<ScalarWalkFactor>(walk), nullptr, {&before->slip, &frame->slip}});
  if (!frame->since.way) return;
  const WheelWay& way = *frame->since.way;
  const VioWheelOptions& wheel = options_.wheel;
  const double turn = wheel.turn_share * way.angle;
  const auto sigma = [&](double share) {
    return std::hypot(wheel.floor, std::hypot(share * way.length, turn));
  };
  const Eigen::Vector3d sigmas(sigma(wheel.along_share), sigma(wheel.lateral_share),
                               sigma(wheel.vertical_share));
  const Eigen::Matrix3d root = sigmas.cwiseInverse().asDiagonal();
  frame->residuals.push_back(
      {std::make_shared<WheelMotionFactor>(*calibration_.T_imu_base, way.way_base, root),
       wheel_loss_,
       {before->pose.data(), frame->pose.data(), &frame->slip}});
}

void SlidingWindow::AddRestResiduals(WindowFrame* before, WindowFrame* frame) {
  if (frame->at_rest) {
    frame->residuals.push_back({std::make_shared<ZeroVelocityFactor>(options_.rest_velocity_sigma),
                                nullptr,
                                {frame->motion.data()}});
  }
  if (!frame->since.at_rest) return;
  Matrix6d root = Matrix6d::Zero();
  root.diagonal().head<3>().setConstant(1.0 / options_.rest_rotation_sigma);
  root.diagonal().tail<3>().setConstant(1.0 / options_.rest_position_sigma);
  frame->residuals.push_back({std::make_shared<RelativePoseFactor>(SE3(), root),
                              nullptr,
                              {before->pose.data(), frame->pose.data()}});
}

void SlidingWindow::Observe(const std::vector<FeatureObservation>& features) {
  WindowFrame& frame = newest();
  for (const FeatureObservation& feature : features) {
    Landmark& landmark = landmarks_[feature.id];
    if (landmark.sightings.size() == 1 && landmark.sightings[0].seen.bearing_rate.isZero()) {
      // The first image of a track does not tell how fast it moves.
      landmark.sightings[0].seen.bearing_rate = feature.bearing_rate;
    }
    LandmarkSighting sighting;
    sighting.frame = &frame;
    sighting.seen = {feature.bearing, feature.bearing_rate, frame.time_offset};
    sighting.right_bearing = feature.right_bearing;
    landmark.sightings.push_back(std::move(sighting));
    BuildSightingResiduals(&landmark, landmark.sightings.size() - 1);
  }
}

void SlidingWindow::BuildSightingResiduals(Landmark* landmark, size_t index) {
  if (index == 0) {
    BuildAnchorResiduals(landmark);
    return;
  }
  LandmarkSighting& sighting = landmark->sightings[index];
  const LandmarkSighting& anchor = landmark->sightings.front();
  sighting.residuals = {{std::make_shared<ReprojectionFactor>(anchor.seen, sighting.seen,
                                                              std::sqrt(2.0) * BearingSigma()),
                         visual_loss_,
                         {anchor.frame->pose.data(), sighting.frame->pose.data(),
                          T_imu_camera_.data(), &landmark->inverse_distance, &time_offset_}}};
}

/// What is known of the distance alone.
void SlidingWindow::BuildAnchorResiduals(Landmark* landmark) {
  LandmarkSighting& anchor = landmark->sightings.front();
  anchor.residuals.clear();
  if (anchor.right_bearing) {
    anchor.residuals.push_back(
        {std::make_shared<StereoFactor>(anchor.seen.bearing, *anchor.right_bearing,
                                        std::sqrt(2.0) * BearingSigma()),
         visual_loss_,
         {T_imu_camera_.data(), T_imu_right_.data(), &landmark->inverse_distance}});
  }
  if (anchor.measured) {
    const double inverse = 1.0 / anchor.measured->distance;
    anchor.residuals.push_back(
        {std::make_shared<ScalarFactor>(inverse, anchor.measured->sigma * inverse * inverse),
         visual_loss_,
         {&landmark->inverse_distance}});
  }
  if (!anchor.residuals.empty()) return;
  // Hardly any: it keeps the distance of a landmark without parallax from running away.
  anchor.residuals.push_back({std::make_shared<ScalarFactor>(1.0 / options_.expected_distance,
                                                             options_.inverse_distance_sigma),
                              nullptr,
                              {&landmark->inverse_distance}});
}

int SlidingWindow::MeasureDistances(DistanceSource* source) {
  std::vector<Landmark*> asked;
  std::vector<Eigen::Vector3d> bearings;
  for (auto& [id, landmark] : landmarks_) {
    if (!landmark.IsSeenIn(&newest()) || landmark.sightings.front().measured) continue;
    asked.push_back(&landmark);
    bearings.push_back(landmark.sightings.back().seen.bearing);
  }
  const SE3 T_imu_camera = FromPoseBlock(T_imu_camera_.data());
  const SE3 T_world_camera = FromPoseBlock(newest().pose.data()) * T_imu_camera;
  const auto distances = source->Distances(T_world_camera, bearings);
  int measured = 0;
  for (size_t i = 0; i < asked.size(); ++i) {
    if (!distances[i]) continue;
    LandmarkSighting& anchor = asked[i]->sightings.front();
    const SE3 T_world_anchor = FromPoseBlock(anchor.frame->pose.data()) * T_imu_camera;
    const Eigen::Vector3d point_anchor =
        T_world_anchor.Inverse() * (T_world_camera * (distances[i]->distance * bearings[i]));
    anchor.measured = MeasuredDistance{point_anchor.norm(), distances[i]->sigma};
    BuildAnchorResiduals(asked[i]);
    if (!asked[i]->is_placed) {
      asked[i]->inverse_distance = 1.0 / anchor.measured->distance;
      asked[i]->is_placed = true;
    }
    ++measured;
  }
  return measured;
}

void SlidingWindow::PlaceLandmark(Landmark* landmark) {
  const LandmarkSighting& anchor = landmark->sightings.front();
  const SE3 T_imu_camera = FromPoseBlock(T_imu_camera_.data());
  std::vector<PointView> views;
  for (const LandmarkSighting& sighting : landmark->sightings) {
    views.push_back(
        {FromPoseBlock(sighting.frame->pose.data()) * T_imu_camera, sighting.seen.bearing});
  }
  if (anchor.right_bearing) {
    views.push_back({FromPoseBlock(anchor.frame->pose.data()) * FromPoseBlock(T_imu_right_.data()),
                     *anchor.right_bearing});
  }
  const std::optional<TriangulatedPoint> point = Triangulate(views);
  if (point && point->parallax > options_.min_parallax) {
    const double distance = (point->point_world - views.front().T_world_camera.translation).norm();
    landmark->inverse_distance = 1.0 / std::clamp(distance, kNearest, kFarthest);
    landmark->is_placed = true;
  } else if (!landmark->in_use) {
    landmark->inverse_distance = 1.0 / options_.expected_distance;
  }
}

void SlidingWindow::PrepareLandmarks() {
  int used = 0;
  std::vector<std::pair<size_t, int64_t>> candidates;
  for (auto& [id, landmark] : landmarks_) {
    if (landmark.sightings.size() < 2) continue;
    if (!landmark.is_placed) PlaceLandmark(&landmark);
    if (landmark.in_use) {
      used += landmark.IsSeenIn(&newest()) ? 1 : 0;
    } else if (landmark.IsSeenIn(&newest())) {
      candidates.emplace_back(landmark.sightings.size(), id);
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [length, id] : candidates) {
    if (used >= options_.max_landmarks) break;
    landmarks_[id].in_use = true;
    ++used;
  }
}

int SlidingWindow::LandmarksInNewest() const {
  int count = 0;
  for (const auto& [id, landmark] : landmarks_) {
    count += landmark.in_use && landmark.IsSeenIn(frames_.back().get()) ? 1 : 0;
  }
  return count;
}

SlidingWindow::Progress SlidingWindow::ProgressSinceKeyframe() const {
  Progress progress;
  if (frames_.size() < 2) return progress;
  const WindowFrame* last = frames_[frames_.size() - 2].get();
  const WindowFrame* now = frames_.back().get();
  const Eigen::Quaterniond R_last_now = FromPoseBlock(T_imu_camera_.data()).rotation.conjugate() *
                                        FromPoseBlock(last->pose.data()).rotation.conjugate() *
                                        FromPoseBlock(now->pose.data()).rotation *
                                        FromPoseBlock(T_imu_camera_.data()).rotation;
  progress.turn = AngleBetween(R_last_now, Eigen::Quaterniond::Identity());
  std::vector<double> angles;
  int of_last = 0;
  for (const auto& [id, landmark] : landmarks_) {
    const size_t count = landmark.sightings.size();
    const bool is_seen = landmark.IsSeenIn(now);
    const size_t place = is_seen ? 2 : 1;
    if (count < place || landmark.sightings[count - place].frame != last) continue;
    ++of_last;
    if (!is_seen) continue;
    const Eigen::Vector3d turned = R_last_now * landmark.sightings.back().seen.bearing;
    const Eigen::Vector3d& before = landmark.sightings[count - 2].seen.bearing;
    angles.push_back(AngleBetween(turned, before));
  }
  progress.parallax = Median(angles);
  progress.shared = of_last == 0 ? 0.0 : static_cast<double>(angles.size()) / of_last;
  return progress;
}

int SlidingWindow::RemoveOutliers() {
  int removed = 0;
  const double limit = options_.outlier * options_.outlier;
  for (auto entry = landmarks_.begin(); entry != landmarks_.end();) {
    Landmark& landmark = entry->second;
    bool is_wrong = landmark.in_use && landmark.inverse_distance > 1.0 / kNearest;
    if (landmark.in_use && landmark.inverse_distance < 0.0) {
      landmark.inverse_distance = 1.0 / kFarthest;
    }
    size_t wrong = 0;
    auto& sightings = landmark.sightings;
    for (size_t i = 1; landmark.in_use && i < sightings.size();) {
      const WindowResidual& residual = sightings[i].residuals.front();
      Eigen::Vector2d error;
      residual.factor->Evaluate(residual.blocks.data(), error.data(), nullptr);
      if (error.squaredNorm() <= limit) {
        ++i;
        continue;
      }
      sightings.erase(sightings.begin() + static_cast<std::ptrdiff_t>(i));
      ++wrong;
    }
    removed += static_cast<int>(wrong);
    is_wrong = is_wrong || (wrong > 0 && sightings.size() < 2) || wrong > sightings.size();
    entry = is_wrong ? landmarks_.erase(entry) : std::next(entry);
  }
  return removed;
}

/// The first sighting is gone: everything is now along the next one.
void SlidingWindow::Reanchor(Landmark* landmark) {
  for (size_t i = 0; i < landmark->sightings.size(); ++i) BuildSightingResiduals(landmark, i);
}

void SlidingWindow::ForgetFrame(const WindowFrame* frame) {
  const SE3 T_imu_camera = FromPoseBlock(T_imu_camera_.data());
  for (auto entry = landmarks_.begin(); entry != landmarks_.end();) {
    Landmark& landmark = entry->second;
    auto& sightings = landmark.sightings;
    const bool was_anchor = sightings.front().frame == frame;
    Eigen::Vector3d point_world = Eigen::Vector3d::Zero();
    std::optional<MeasuredDistance> measured = sightings.front().measured;
    if (was_anchor && landmark.in_use) {
      if (measured) measured->distance *= landmark.inverse_distance;
      const SE3 T_world_camera = FromPoseBlock(frame->pose.data()) * T_imu_camera;
      point_world = T_world_camera * (sightings.front().seen.bearing /
                                      std::max(landmark.inverse_distance, 1.0 / kFarthest));
    }
    sightings.erase(std::remove_if(sightings.begin(), sightings.end(),
                                   [&](const auto& sighting) { return sighting.frame == frame; }),
                    sightings.end());
    if (sightings.empty()) {
      entry = landmarks_.erase(entry);
      continue;
    }
    if (was_anchor) {
      const SE3 T_world_camera = FromPoseBlock(sightings.front().frame->pose.data()) * T_imu_camera;
      if (landmark.in_use) {
        const double distance = (point_world - T_world_camera.translation).norm();
        landmark.inverse_distance = 1.0 / distance;
        // As a share of the distance estimated, the measurement holds along the new bearing too.
        if (measured && !sightings.front().measured) {
          measured->distance *= distance;
          sightings.front().measured = measured;
        }
      }
      Reanchor(&landmark);
    }
    ++entry;
  }
}

void SlidingWindow::MakeKeyframe() {
  newest().is_keyframe = true;
  if (frames_.size() > static_cast<size_t>(options_.keyframes)) MarginaliseOldest();
}

void SlidingWindow::MarginaliseOldest() {
  WindowFrame* oldest = frames_.front().get();
  WindowFrame* next = frames_[1].get();
  std::vector<std::pair<double*, int>> blocks = {{oldest->pose.data(), kPoseBlockSize},
                                                 {oldest->motion.data(), kMotionBlockSize}};
  if (uses_slip()) blocks.emplace_back(&oldest->slip, 1);
  const size_t eliminated = blocks.size();
  for (const auto& block : SharedBlocks()) blocks.push_back(block);
  blocks.emplace_back(next->motion.data(), kMotionBlockSize);
  if (uses_slip()) blocks.emplace_back(&next->slip, 1);
  for (size_t i = 1; i < frames_.size(); ++i) {
    blocks.emplace_back(frames_[i]->pose.data(), kPoseBlockSize);
  }
  NormalEquations equations(WithPriorPoints(blocks, prior_));
  if (const auto prior = PriorResidual()) Add(*prior, &equations);
  for (const WindowResidual& residual : oldest->residuals) Add(residual, &equations);
  // What is of the next frame alone stays with it; the rest ties it to the oldest.
  std::vector<WindowResidual> own;
  for (WindowResidual& residual : next->residuals) {
    if (residual.blocks.size() == 1) {
      own.push_back(std::move(residual));
    } else {
      Add(residual, &equations);
    }
  }
  next->residuals = std::move(own);
  for (auto entry = landmarks_.begin(); entry != landmarks_.end();) {
    Landmark& landmark = entry->second;
    const bool is_over =
        landmark.sightings.front().frame == oldest && !landmark.IsSeenIn(&newest());
    if (!is_over) {
      ++entry;
      continue;
    }
    if (landmark.IsSolvedFor()) Add(&landmark, &equations);
    entry = landmarks_.erase(entry);
  }
  prior_ = equations.Marginalise(eliminated);
  SetPriorFactor();
  ForgetFrame(oldest);
  history_.Move(oldest->record, FromPoseBlock(oldest->pose.data()));
  frames_.pop_front();
}

FrameHistory SlidingWindow::History() const {
  FrameHistory history = history_;
  for (const auto& frame : frames_) {
    history.Move(frame->record, FromPoseBlock(frame->pose.data()));
  }
  return history;
}

Eigen::Vector3d SlidingWindow::gravity_world() const {
  return GravityFromTilt(tilt_, calibration_.gravity);
}

Matrix15d SlidingWindow::NewestCovariance() {
  std::vector<std::pair<double*, int>> blocks = SharedBlocks();
  for (const auto& frame : frames_) {
    if (uses_slip()) blocks.emplace_back(&frame->slip, 1);
    if (frame != frames_.back()) {
      blocks.emplace_back(frame->pose.data(), kPoseBlockSize);
      blocks.emplace_back(frame->motion.data(), kMotionBlockSize);
    }
  }
  const size_t first = blocks.size();
  blocks.emplace_back(newest().pose.data(), kPoseBlockSize);
  blocks.emplace_back(newest().motion.data(), kMotionBlockSize);
  NormalEquations equations(WithPriorPoints(blocks, prior_));
  if (const auto prior = PriorResidual()) Add(*prior, &equations);
  for (const auto& frame : frames_) {
    for (const WindowResidual& residual : frame->residuals) Add(residual, &equations);
  }
  for (auto& [id, landmark] : landmarks_) {
    if (landmark.IsSolvedFor()) Add(&landmark, &equations);
  }
  return equations.Covariance(first);
}

}  // namespace regolith

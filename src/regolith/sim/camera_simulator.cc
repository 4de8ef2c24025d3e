// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/camera_simulator.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

// Electrons a second at I/F 1: lunar ground under a low sun (I/F .02) takes 12 ms to its target.
constexpr double kSensitivity = 1.8e7;
constexpr double kTargetLevel = 0.42;  // of full scale, of the lit ground
constexpr double kLitQuantile = 0.75;
constexpr double kBrightLevel = 0.95;
constexpr double kBrightQuantile = 0.97;
constexpr double kStep = 0.5;  // of the way, in stops
constexpr size_t kRowsAtOnce = 16;
// Shorter motion than this (pixels) cannot be seen.
constexpr float kLeastMotion = 0.3F;
constexpr int kMostMotionTaps = 12;

// Four uniform values of one hash make a bell of unit variance, cut at 3.46 sigma.
float FastGaussian(uint64_t bits) {
  const auto sum = static_cast<int64_t>(bits & 0xffff) +
                   static_cast<int64_t>((bits >> 16) & 0xffff) +
                   static_cast<int64_t>((bits >> 32) & 0xffff) + static_cast<int64_t>(bits >> 48);
  constexpr float kScale = 1.7320508F / 65536.0F;
  return static_cast<float>(sum - 2 * 65535) * kScale;
}

double Quantile(std::vector<float>* values, double share) {
  const auto place = values->begin() +
                     static_cast<std::ptrdiff_t>(share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), place, values->end());
  return std::max<double>(*place, 1e-7);
}

}  // namespace

// The time · gain that brings the lit ground to its target and keeps its brightest parts from
// saturating. A Martian sky may: a rover looks at the ground.
double ExposureControl::Needed(const RenderedView& view) const {
  constexpr int kEvery = 4;
  std::vector<float> all;
  std::vector<float> ground;
  for (int row = 0; row < view.height; row += kEvery) {
    for (int column = 0; column < view.width; column += kEvery) {
      const auto pixel = static_cast<size_t>(row * view.width + column);
      all.push_back(view.radiance[pixel]);
      if (std::isfinite(view.distance[pixel])) ground.push_back(view.radiance[pixel]);
    }
  }
  if (ground.empty()) ground = all;
  const double full = options_.full_well / kSensitivity;
  const double for_ground = kTargetLevel * full / Quantile(&ground, kLitQuantile);
  const double for_highlights = kBrightLevel * full / Quantile(&ground, kBrightQuantile);
  return std::clamp(std::min(for_ground, for_highlights), options_.min_exposure,
                    options_.max_exposure * options_.max_gain);
}

Exposure ExposureControl::Next(const RenderedView& view) {
  const double now = Needed(view);
  current_ = current_ > 0.0 ? current_ * std::pow(needed_ / current_, kStep) : now;
  needed_ = now;
  Exposure exposure;
  exposure.time = std::min(current_, options_.max_exposure);
  exposure.gain = current_ / exposure.time;
  return exposure;
}

CameraSimulator::CameraSimulator(const CameraOptions& options, const Renderer& renderer,
                                 ThreadPool* pool)
    : options_(options),
      renderer_(renderer),
      pool_(pool),
      focal_(static_cast<float>(MakeIntrinsics(options).focal.x())) {
  const Eigen::Vector2d centre(0.5 * (options.width - 1), 0.5 * (options.height - 1));
  for (int row = 0; row < options.height; ++row) {
    for (int column = 0; column < options.width; ++column) {
      const double radius = (Eigen::Vector2d(column, row) - centre).norm() / centre.norm();
      vignette_.push_back(static_cast<float>(1.0 - options.vignetting * radius * radius));
    }
  }
}

// Pixels a second that a point at `distance` m moves; the lens' distortion is left aside.
Eigen::Vector2f CameraSimulator::PixelMotion(const CameraMotion& motion, float distance, int column,
                                             int row) const {
  const Eigen::Vector3f& bearing = renderer_.bearing(column, row);
  Eigen::Vector3f moves = -motion.angular_velocity.cross(bearing);
  if (std::isfinite(distance)) moves -= motion.velocity / distance;
  const float inverse = 1.0F / bearing.z();
  return focal_ * inverse *
         Eigen::Vector2f(moves.x() - bearing.x() * inverse * moves.z(),
                         moves.y() - bearing.y() * inverse * moves.z());
}

// A pixel gathers along the way that its point goes during the exposure: exact for smooth depth.
std::vector<float> CameraSimulator::BlurByMotion(const RenderedView& view,
                                                 const CameraMotion& motion, double time) const {
  std::vector<float> blurred(view.radiance.size());
  const auto seconds = static_cast<float>(time);
  pool_->ParallelFor(
      static_cast<size_t>(view.height), kRowsAtOnce, [&](size_t begin, size_t end, size_t) {
        for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
          for (int column = 0; column < view.width; ++column) {
            const auto pixel = static_cast<size_t>(row * view.width + column);
            const Eigen::Vector2f way =
                seconds * PixelMotion(motion, view.distance[pixel], column, row);
            const float length = way.norm();
            if (length < kLeastMotion) {
              blurred[pixel] = view.radiance[pixel];
              continue;
            }
            const int taps = std::min(static_cast<int>(1.5F * length) + 2, kMostMotionTaps);
            float sum = 0.0F;
            for (int tap = 0; tap < taps; ++tap) {
              const float share =
                  (static_cast<float>(tap) + 0.5F) / static_cast<float>(taps) - 0.5F;
              const float u = std::clamp(static_cast<float>(column) + share * way.x(), 0.0F,
                                         static_cast<float>(view.width) - 1.001F);
              const float v = std::clamp(static_cast<float>(row) + share * way.y(), 0.0F,
                                         static_cast<float>(view.height) - 1.001F);
              const float a = u - std::floor(u);
              const float b = v - std::floor(v);
              const float* low = &view.radiance[static_cast<size_t>(
                  static_cast<int>(v) * view.width + static_cast<int>(u))];
              const float* high = low + view.width;
              sum += (1.0F - b) * (low[0] + a * (low[1] - low[0])) +
                     b * (high[0] + a * (high[1] - high[0]));
            }
            blurred[pixel] = sum / static_cast<float>(taps);
          }
        }
      });
  return blurred;
}

// A small Gaussian, [s 1 - 2s s] each way.
void CameraSimulator::BlurByLens(std::vector<float>* radiance) const {
  const auto side = static_cast<float>(0.5 * options_.lens_blur * options_.lens_blur);
  if (side <= 0.0F) return;
  const auto width = static_cast<size_t>(options_.width);
  const auto height = static_cast<size_t>(options_.height);
  std::vector<float> rows(radiance->size());
  for (size_t row = 0; row < height; ++row) {
    const float* from = radiance->data() + row * width;
    float* to = rows.data() + row * width;
    for (size_t i = 1; i + 1 < width; ++i) {
      to[i] = from[i] + side * (from[i - 1] - 2.0F * from[i] + from[i + 1]);
    }
    to[0] = from[0];
    to[width - 1] = from[width - 1];
  }
  for (size_t row = 0; row < height; ++row) {
    const float* from = rows.data() + row * width;
    const float* above = row > 0 ? from - width : from;
    const float* below = row + 1 < height ? from + width : from;
    float* to = radiance->data() + row * width;
    for (size_t i = 0; i < width; ++i) {
      to[i] = from[i] + side * (above[i] - 2.0F * from[i] + below[i]);
    }
  }
}

Image CameraSimulator::Expose(const RenderedView& view, const CameraMotion& motion,
                              const Exposure& exposure, uint64_t seed, uint64_t frame) const {
  const uint64_t noise_seed = Scramble(seed ^ Scramble(frame));
  std::vector<float> radiance =
      options_.motion_blur ? BlurByMotion(view, motion, exposure.time) : view.radiance;
  BlurByLens(&radiance);
  Image image;
  image.width = options_.width;
  image.height = options_.height;
  image.data.resize(radiance.size());
  const auto to_electrons = static_cast<float>(kSensitivity * exposure.time);
  const auto to_levels = static_cast<float>(255.0 / options_.full_well * exposure.gain);
  const auto read_variance = static_cast<float>(options_.read_noise * options_.read_noise);
  const float noise_on = options_.noise ? 1.0F : 0.0F;
  const auto width = static_cast<size_t>(options_.width);
  pool_->ParallelFor(static_cast<size_t>(options_.height), kRowsAtOnce,
                     [&](size_t begin, size_t end, size_t) {
                       for (size_t i = begin * width; i < end * width; ++i) {
                         const float electrons = to_electrons * vignette_[i] * radiance[i];
                         const float noise = noise_on * std::sqrt(electrons + read_variance) *
                                             FastGaussian(Scramble(noise_seed ^ (i << 20)));
                         const float level = to_levels * (electrons + noise) + 0.5F;
                         image.data[i] = static_cast<uint8_t>(std::clamp(level, 0.0F, 255.0F));
                       }
                     });
  return image;
}

}  // namespace regolith

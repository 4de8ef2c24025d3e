// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/camera_simulator.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr float kFarAway = 5000.0F;
// Farther ground is finer than a pixel is high: lines between the pixels' are rendered too.
constexpr float kSupersampleDistance = 7.0F;
constexpr double kFarShare = 0.25;  // of a line
// Electrons a second at I/F 1: lunar ground under a low sun (I/F .02) takes 12 ms to its target.
constexpr double kSensitivity = 1.8e7;
constexpr double kTargetLevel = 0.42;  // of full scale, of the lit ground
constexpr double kLitQuantile = 0.75;
constexpr double kBrightLevel = 1.0;
constexpr double kBrightQuantile = 0.8;

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
  return std::max<double>(*place, 1e-6);
}

}  // namespace

struct CameraSimulator::View {
  Eigen::Matrix3f R_world_camera;
  Eigen::Vector3f origin;  // m, world
  RowCaster caster;
};

CameraSimulator::CameraSimulator(const CameraOptions& options, const TerrainMesh& mesh,
                                 const Photometry& photometry, ThreadPool* pool)
    : options_(options), mesh_(mesh), photometry_(photometry), pool_(pool) {
  const auto model = CameraModel::Create(MakeIntrinsics(options));
  const Eigen::Vector2d centre(0.5 * (options.width - 1), 0.5 * (options.height - 1));
  for (int row = 0; row < options.height; ++row) {
    for (int column = 0; column < options.width; ++column) {
      const Eigen::Vector2d pixel(column, row);
      const auto bearing = model->Unproject(pixel);
      REGOLITH_CHECK(bearing.has_value(), "pixel ", pixel.transpose(), " has no bearing");
      bearings_.push_back(bearing->cast<float>());
      const double radius = (pixel - centre).norm() / centre.norm();
      vignette_.push_back(static_cast<float>(1.0 - options.vignetting * radius * radius));
    }
  }
  radiance_.resize(bearings_.size());
}

Image CameraSimulator::Render(const SE3& T_world_camera, uint64_t seed, uint64_t frame) {
  const Eigen::Vector3f origin = T_world_camera.translation.cast<float>();
  const View view{T_world_camera.rotation.toRotationMatrix().cast<float>(), origin,
                  RowCaster(mesh_, origin)};
  const uint64_t noise_seed = Scramble(seed ^ Scramble(frame));
  std::fill(radiance_.begin(), radiance_.end(), 0.0F);
  constexpr size_t kRowsAtOnce = 32;
  pool_->ParallelFor(static_cast<size_t>(options_.height), kRowsAtOnce,
                     [&](size_t begin, size_t end, size_t) {
                       RenderRows(view, static_cast<int>(begin), static_cast<int>(end));
                     });
  last_exposure_ = ChooseExposure();
  return Expose(noise_seed, last_exposure_);
}

void CameraSimulator::RenderRows(const View& view, int begin, int end) {
  const int last = std::min(end, options_.height - 1);
  if (SeesFar(view, begin) || SeesFar(view, last)) {
    RenderFar(view, begin, end);
  } else {
    RenderNear(view, begin, end);
  }
}

// A ray a pixel; every second line is cast.
void CameraSimulator::RenderNear(const View& view, int begin, int end) {
  RayRow above = CastRow(view, begin);
  for (int row = begin; row < end; row += 2) {
    AddRadiance(Radiance(view, above), 1.0F, row);
    if (row + 1 >= end) break;
    RayRow below = CastRow(view, std::min(row + 2, options_.height - 1));
    RayRow between = MakeRow(view, row + 1, 0.0F);
    view.caster.CastBetween(above, below, &between);
    AddRadiance(Radiance(view, between), 1.0F, row + 1);
    above = std::move(below);
  }
}

// Lines between the pixels' too, which each give a quarter to the pixels above and below: a tent
// over two pixels' height.
void CameraSimulator::RenderFar(const View& view, int begin, int end) {
  const auto add = [&](const std::vector<float>& radiance, float weight, int row) {
    if (row >= begin && row < end) AddRadiance(radiance, weight, row);
  };
  const int first = std::max(begin - 1, 0);
  const int last = std::min(end, options_.height - 1);
  RayRow above = CastRow(view, first);
  if (first == begin) add(Radiance(view, above), 0.25F, begin);
  for (int row = first; row <= last; ++row) {
    if (row >= begin && row < end) add(Radiance(view, above), 0.5F, row);
    if (row == last) break;
    RayRow below = CastRow(view, row + 1);
    RayRow between = MakeRow(view, row, 0.5F);
    view.caster.CastBetween(above, below, &between);
    const std::vector<float> radiance = Radiance(view, between);
    add(radiance, 0.25F, row);
    add(radiance, 0.25F, row + 1);
    above = std::move(below);
  }
  if (last < end) add(Radiance(view, above), 0.25F, last);
}

RayRow CameraSimulator::CastRow(const View& view, int row) const {
  RayRow rays = MakeRow(view, row, 0.0F);
  view.caster.CastSparse(&rays);
  return rays;
}

// Whether a good part of a line sees ground that is finer than its pixels are high.
bool CameraSimulator::SeesFar(const View& view, int row) const {
  const RayRow full = MakeRow(view, row, 0.0F);
  RayRow sparse;
  constexpr size_t kStep = 16;
  for (size_t i = 0; i < full.directions.size(); i += kStep) {
    sparse.directions.push_back(full.directions[i]);
  }
  view.caster.CastSparse(&sparse);
  const auto far = std::count_if(sparse.distances.begin(), sparse.distances.end(),
                                 [](float d) { return d > kSupersampleDistance && d < kFarAway; });
  return static_cast<double>(far) > kFarShare * static_cast<double>(sparse.distances.size());
}

RayRow CameraSimulator::MakeRow(const View& view, int row, float shift) const {
  const auto width = static_cast<size_t>(options_.width);
  const Eigen::Vector3f* bearings = &bearings_[static_cast<size_t>(row) * width];
  // The neighbouring line, for rays between lines.
  const Eigen::Vector3f* next = row + 1 < options_.height ? bearings + width : bearings;
  RayRow rays;
  rays.directions.resize(width);
  for (size_t i = 0; i < width; ++i) {
    const Eigen::Vector3f bearing = bearings[i] + shift * (next[i] - bearings[i]);
    rays.directions[i] = (view.R_world_camera * bearing).normalized();
  }
  return rays;
}

std::vector<float> CameraSimulator::Radiance(const View& view, const RayRow& rays) const {
  std::vector<float> radiance;
  radiance.reserve(rays.directions.size());
  for (size_t i = 0; i < rays.directions.size(); ++i) {
    const Eigen::Vector3f& direction = rays.directions[i];
    const float distance = rays.distances[i];
    if (!(distance < kFarAway)) {
      radiance.push_back(photometry_.Sky(direction));
      continue;
    }
    const Eigen::Vector3f place = view.origin + distance * direction;
    const GroundPoint ground = mesh_.At(place.x(), place.y());
    radiance.push_back(photometry_.Ground(ground.normal, -direction, ground.albedo, ground.sunlit));
  }
  return radiance;
}

void CameraSimulator::AddRadiance(const std::vector<float>& radiance, float weight, int row) {
  float* sums = &radiance_[static_cast<size_t>(row) * radiance.size()];
  for (size_t i = 0; i < radiance.size(); ++i) sums[i] += weight * radiance[i];
}

// The exposure that brings the lit ground to its target and keeps a bright sky from saturating:
// what an ideal automatic control would have settled on, without its lag.
double CameraSimulator::ChooseExposure() const {
  constexpr int kStep = 4;
  std::vector<float> all;
  std::vector<float> ground;
  for (int row = 0; row < options_.height; row += kStep) {
    for (int column = 0; column < options_.width; column += kStep) {
      const float radiance =
          radiance_[static_cast<size_t>(row) * static_cast<size_t>(options_.width) +
                    static_cast<size_t>(column)];
      all.push_back(radiance);
      // The upper third is mostly sky.
      if (row >= options_.height / 3) ground.push_back(radiance);
    }
  }
  const double full = options_.full_well / kSensitivity;
  const double for_ground = kTargetLevel * full / Quantile(&ground, kLitQuantile);
  const double for_sky = kBrightLevel * full / Quantile(&all, kBrightQuantile);
  return std::clamp(std::min(for_ground, for_sky), options_.min_exposure, options_.max_exposure);
}

Image CameraSimulator::Expose(uint64_t noise_seed, double exposure) const {
  Image image;
  image.width = options_.width;
  image.height = options_.height;
  image.data.resize(static_cast<size_t>(options_.width) * static_cast<size_t>(options_.height));
  const auto gain = static_cast<float>(kSensitivity * exposure);
  const auto to_levels = static_cast<float>(255.0 / options_.full_well);
  const auto read_variance = static_cast<float>(options_.read_noise * options_.read_noise);
  const auto width = static_cast<size_t>(options_.width);
  constexpr size_t kRowsAtOnce = 16;
  pool_->ParallelFor(
      static_cast<size_t>(options_.height), kRowsAtOnce, [&](size_t begin, size_t end, size_t) {
        for (size_t row = begin; row < end; ++row) {
          for (size_t column = 0; column < width; ++column) {
            const size_t i = row * width + column;
            const float electrons =
                gain * vignette_[i] * radiance_[row * static_cast<size_t>(options_.width) + column];
            const float noise = std::sqrt(electrons + read_variance) *
                                FastGaussian(Scramble(noise_seed ^ (i << 20)));
            const float level = to_levels * (electrons + noise) + 0.5F;
            image.data[i] = static_cast<uint8_t>(std::clamp(level, 0.0F, 255.0F));
          }
        }
      });
  return image;
}

}  // namespace regolith

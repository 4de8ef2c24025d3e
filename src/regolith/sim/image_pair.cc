// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/image_pair.h"

#include <cmath>
#include <limits>
#include <memory>

namespace regolith {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kFarAway = 2e4F;  // m
// The second camera's ray ends before the place by this share of its length, so that rounding does
// not hide the place behind itself.
constexpr float kSure = 0.002F;

class FlowFinder {
 public:
  FlowFinder(const Scene& scene, const Renderer& renderer, const CameraIntrinsics& intrinsics,
             const SE3& T_world_first, const SE3& T_world_second)
      : scene_(scene),
        renderer_(renderer),
        model_(CameraModel::Create(intrinsics)),
        width_(intrinsics.width),
        height_(intrinsics.height),
        R_world_first_(T_world_first.rotation.toRotationMatrix().cast<float>()),
        first_(T_world_first.translation.cast<float>()),
        second_(T_world_second.translation.cast<float>()),
        T_second_world_(T_world_second.Inverse()) {}

  // The pixels from `start` on that a packet holds: rays of the first camera, then those of the
  // second that should end at the same places.
  void Find(int start, float* flow_x, float* flow_y) const {
    RayPacket rays;
    for (int lane = 0; lane < kPacketSize; ++lane) {
      rays.Off(lane);
      const int pixel = start + lane;
      if (pixel >= width_ * height_) continue;
      rays.Set(lane, first_, R_world_first_ * renderer_.bearing(pixel % width_, pixel / width_),
               kFarAway);
    }
    scene_.Intersect(&rays);
    RayPacket back;
    Eigen::Vector2d pixels[kPacketSize];
    for (int lane = 0; lane < kPacketSize; ++lane) {
      back.Off(lane);
      if (rays.limit[lane] < 0.0F || rays.object[lane] == kNothing) continue;
      const Eigen::Vector3f place = rays.Point(lane);
      const auto pixel = model_->Project(T_second_world_ * place.cast<double>());
      if (!pixel || !Inside(*pixel)) continue;
      pixels[lane] = *pixel;
      const Eigen::Vector3f way = place - second_;
      back.Set(lane, second_, way.normalized(), (1.0F - kSure) * way.norm());
    }
    scene_.Occluded(&back);
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (back.limit[lane] < 0.0F || back.distance[lane] == 0.0F) continue;
      flow_x[start + lane] = static_cast<float>(pixels[lane].x());
      flow_y[start + lane] = static_cast<float>(pixels[lane].y());
    }
  }

 private:
  bool Inside(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= width_ - 0.5 &&
           pixel.y() <= height_ - 0.5;
  }

  const Scene& scene_;
  const Renderer& renderer_;
  std::unique_ptr<CameraModel> model_;
  int width_;
  int height_;
  Eigen::Matrix3f R_world_first_;
  Eigen::Vector3f first_;
  Eigen::Vector3f second_;
  SE3 T_second_world_;
};

}  // namespace

void FindFlow(const Scene& scene, const Renderer& renderer, const CameraIntrinsics& intrinsics,
              const SE3& T_world_first, const SE3& T_world_second, ThreadPool* pool,
              ImagePair* pair) {
  const FlowFinder finder(scene, renderer, intrinsics, T_world_first, T_world_second);
  const auto count = static_cast<size_t>(intrinsics.width) * static_cast<size_t>(intrinsics.height);
  pair->flow_x.assign(count, kUnknown);
  pair->flow_y.assign(count, kUnknown);
  constexpr size_t kPacketsAtOnce = 512;
  pool->ParallelFor((count + kPacketSize - 1) / kPacketSize, kPacketsAtOnce,
                    [&](size_t begin, size_t end, size_t) {
                      for (size_t packet = begin; packet < end; ++packet) {
                        finder.Find(static_cast<int>(packet) * kPacketSize, pair->flow_x.data(),
                                    pair->flow_y.data());
                      }
                    });
}

}  // namespace regolith

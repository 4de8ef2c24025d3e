// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/image_pair.h"

#include <cmath>
#include <limits>

namespace regolith {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
// The second camera's ray must end as near to the place as the pixel is long there, and not nearer
// than interpolated distances are sure.
constexpr float kSure = 0.02F;

}  // namespace

void FindFlow(const Scene& scene, const Renderer& renderer, const CameraIntrinsics& intrinsics,
              const RenderedView& view, const SE3& T_world_first, const SE3& T_world_second,
              ThreadPool* pool, ImagePair* pair) {
  const auto model = CameraModel::Create(intrinsics);
  const Eigen::Matrix3f R_world_first = T_world_first.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f first = T_world_first.translation.cast<float>();
  const Eigen::Vector3f second = T_world_second.translation.cast<float>();
  const SE3 T_second_world = T_world_second.Inverse();
  pair->flow_x.assign(view.distance.size(), kUnknown);
  pair->flow_y.assign(view.distance.size(), kUnknown);
  const auto width = static_cast<size_t>(view.width);
  constexpr size_t kRowsAtOnce = 16;
  const auto find = [&](size_t start) {
    // The exact places: rays of the first camera, then those of the second that should end there.
    RayPacket seen;
    for (int lane = 0; lane < kPacketSize; ++lane) {
      const size_t i = start + static_cast<size_t>(lane);
      seen.Off(lane);
      if (i >= view.distance.size() || !std::isfinite(view.distance[i])) continue;
      const auto column = static_cast<int>(i % width);
      const auto row = static_cast<int>(i / width);
      seen.Set(lane, first, R_world_first * renderer.bearing(column, row), 2e4F);
    }
    scene.Intersect(&seen, true);
    RayPacket back;
    for (int lane = 0; lane < kPacketSize; ++lane) {
      back.Off(lane);
      if (seen.limit[lane] < 0.0F || !std::isfinite(seen.distance[lane])) continue;
      const Eigen::Vector3f place = seen.Point(lane);
      const auto pixel = model->Project(T_second_world * place.cast<double>());
      if (!pixel || pixel->x() < -0.5 || pixel->y() < -0.5 || pixel->x() > view.width - 0.5 ||
          pixel->y() > view.height - 0.5) {
        continue;
      }
      const Eigen::Vector3f way = place - second;
      back.Set(lane, second, way.normalized(), (1.0F - kSure) * way.norm());
      pair->flow_x[start + static_cast<size_t>(lane)] = static_cast<float>(pixel->x());
      pair->flow_y[start + static_cast<size_t>(lane)] = static_cast<float>(pixel->y());
    }
    scene.Occluded(&back);
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (back.limit[lane] < 0.0F || back.distance[lane] > 0.0F) continue;
      pair->flow_x[start + static_cast<size_t>(lane)] = kUnknown;
      pair->flow_y[start + static_cast<size_t>(lane)] = kUnknown;
    }
  };
  pool->ParallelFor(view.distance.size() / kPacketSize + 1, kRowsAtOnce * width / kPacketSize,
                    [&](size_t begin, size_t end, size_t) {
                      for (size_t packet = begin; packet < end; ++packet) {
                        find(packet * kPacketSize);
                      }
                    });
}

}  // namespace regolith

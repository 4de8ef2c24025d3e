// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/preview.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "regolith/core/check.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sim/camera_simulator.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr uint8_t kTrackLevel = 255;
constexpr float kTrackLift = 0.05F;  // m above the ground

CameraOptions PreviewCamera() {
  CameraOptions camera;
  camera.width = 1280;
  camera.height = 720;
  camera.field_of_view_deg = 60.0;
  camera.distortion = {0.0, 0.0, 0.0, 0.0};
  camera.vignetting = 0.1;
  camera.read_noise = 2.0;
  camera.full_well = 20000.0;
  camera.max_exposure = 0.2;
  camera.motion_blur = false;
  return camera;
}

// Looks at the middle of the path from beside and above it.
SE3 Viewpoint(Span<const Eigen::Vector3d> path) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& place : path) box.extend(place);
  const Eigen::Vector3d target = box.center();
  const double distance = std::max(1.0 * box.diagonal().norm(), 6.0);
  const Eigen::Vector3d chord = path.back() - path.front();
  const double heading = chord.norm() > 0.5 ? std::atan2(chord.y(), chord.x()) : 0.0;
  const double from = heading + M_PI - 0.5;
  const Eigen::Vector3d eye =
      target + distance * Eigen::Vector3d(std::cos(from), std::sin(from), 0.5);
  Eigen::Matrix3d R_world_camera;
  R_world_camera.col(2) = (target - eye).normalized();
  R_world_camera.col(0) = R_world_camera.col(2).cross(Eigen::Vector3d::UnitZ()).normalized();
  R_world_camera.col(1) = R_world_camera.col(2).cross(R_world_camera.col(0));
  return {Eigen::Quaterniond(R_world_camera).normalized(), eye};
}

bool Hidden(const Scene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3f& place) {
  const Eigen::Vector3f towards = eye.cast<float>() - place;
  RayPacket ray;
  for (int lane = 0; lane < kPacketSize; ++lane) {
    ray.Set(lane, place, towards.normalized(), lane == 0 ? towards.norm() : -1.0F);
  }
  scene.Occluded(&ray);
  return ray.distance[0] == 0.0F;
}

void DrawDot(const Eigen::Vector2d& pixel, Image* image) {
  const int column = static_cast<int>(std::lround(pixel.x()));
  const int row = static_cast<int>(std::lround(pixel.y()));
  for (int v = row - 1; v <= row + 1; ++v) {
    for (int u = column - 1; u <= column + 1; ++u) {
      if (u < 0 || v < 0 || u >= image->width || v >= image->height) continue;
      image->data[static_cast<size_t>(v * image->width + u)] = kTrackLevel;
    }
  }
}

}  // namespace

Image RenderPreview(const Scene& scene, const Photometry& photometry,
                    Span<const Eigen::Vector3d> path, ThreadPool* pool) {
  REGOLITH_CHECK(!path.empty(), "no path");
  const CameraOptions options = PreviewCamera();
  const SE3 T_world_camera = Viewpoint(path);
  const Renderer renderer(MakeIntrinsics(options), scene, photometry, pool);
  RenderedView view;
  renderer.Render(T_world_camera, Surroundings{}, &view);
  const Exposure exposure = ExposureControl(options).Next(view);
  Image image =
      CameraSimulator(options, renderer, pool).Expose(view, CameraMotion{}, exposure, 0, 0);
  const auto model = CameraModel::Create(MakeIntrinsics(options));
  const SE3 T_camera_world = T_world_camera.Inverse();
  constexpr int kDots = 24;
  for (size_t i = 0; i + 1 < path.size(); ++i) {
    for (int k = 0; k < kDots; ++k) {
      const Eigen::Vector3d place = path[i] + (path[i + 1] - path[i]) * (k / double{kDots});
      const Eigen::Vector3f lifted = (place + Eigen::Vector3d(0.0, 0.0, kTrackLift)).cast<float>();
      const auto pixel = model->Project(T_camera_world * lifted.cast<double>());
      if (pixel && !Hidden(scene, T_world_camera.translation, lifted)) DrawDot(*pixel, &image);
    }
  }
  return image;
}

}  // namespace regolith

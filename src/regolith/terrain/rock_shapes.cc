// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/rock_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr int kSubdivisions = 3;  // 642 vertices
constexpr double kDegree = M_PI / 180.0;
constexpr int kRaster = 96;  // cells a side
constexpr float kBeside = -std::numeric_limits<float>::infinity();

RockShape Icosahedron() {
  const auto golden = static_cast<float>(0.5 * (1.0 + std::sqrt(5.0)));
  RockShape shape;
  for (const float a : {-1.0F, 1.0F}) {
    for (const float b : {-golden, golden}) {
      shape.vertices.emplace_back(0.0F, a, b);
      shape.vertices.emplace_back(a, b, 0.0F);
      shape.vertices.emplace_back(b, 0.0F, a);
    }
  }
  // Faces are the triples at the edge length 2, turned outwards.
  const auto near = [&](uint32_t i, uint32_t j) {
    return (shape.vertices[i] - shape.vertices[j]).norm() < 2.01F;
  };
  for (uint32_t i = 0; i < 12; ++i) {
    for (uint32_t j = i + 1; j < 12; ++j) {
      for (uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const Eigen::Vector3f& a = shape.vertices[i];
        const Eigen::Vector3f normal = (shape.vertices[j] - a).cross(shape.vertices[k] - a);
        if (normal.dot(a) > 0.0F) shape.triangles.push_back({i, j, k});
        if (normal.dot(a) <= 0.0F) shape.triangles.push_back({i, k, j});
      }
    }
  }
  for (Eigen::Vector3f& vertex : shape.vertices) vertex.normalize();
  return shape;
}

RockShape Subdivided(const RockShape& coarse) {
  RockShape fine;
  fine.vertices = coarse.vertices;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t i, uint32_t j) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(i, j), fine.vertices.size());
    if (is_new) fine.vertices.push_back((fine.vertices[i] + fine.vertices[j]).normalized());
    return found->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const uint32_t ab = middle(a, b);
    const uint32_t bc = middle(b, c);
    const uint32_t ca = middle(c, a);
    for (const auto& triangle :
         {std::array<uint32_t, 3>{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      fine.triangles.push_back(triangle);
    }
  }
  return fine;
}

Eigen::Vector3f Direction(Random* random) {
  Eigen::Vector3d direction(random->Gaussian(), random->Gaussian(), random->Gaussian());
  return direction.normalized().cast<float>();
}

// A lumpy sphere: a few waves of low frequency.
void Displace(Random* random, RockShape* shape) {
  for (int wave = 0; wave < 8; ++wave) {
    const Eigen::Vector3f number =
        static_cast<float>(random->Uniform(1.5, 4.5)) * Direction(random);
    const auto phase = static_cast<float>(random->Uniform(0.0, 2.0 * M_PI));
    for (Eigen::Vector3f& vertex : shape->vertices) {
      vertex *= 1.0F + 0.05F * std::sin(number.dot(vertex.normalized()) + phase);
    }
  }
}

// What stands beyond a plane is pressed onto it: a facet with angular edges.
void Cut(Random* random, RockShape* shape) {
  const int cuts = 7 + static_cast<int>(random->Uniform(0.0, 6.0));
  for (int i = 0; i < cuts; ++i) {
    const Eigen::Vector3f normal = Direction(random);
    const auto distance = static_cast<float>(random->Uniform(0.62, 0.9));
    for (Eigen::Vector3f& vertex : shape->vertices) {
      vertex -= std::max(0.0F, normal.dot(vertex) - distance) * normal;
    }
  }
}

void Place(Random* random, double height_share, RockShape* shape) {
  const Eigen::Vector3f axes(2.0F, std::sqrt(2.0F), 1.0F);
  const double tilt = random->Uniform(0.0, 20.0) * kDegree;
  const Eigen::Vector3f across =
      Eigen::Vector3f(Direction(random).head<2>().homogeneous()) - Eigen::Vector3f::UnitZ();
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(static_cast<float>(tilt), across.normalized()).toRotationMatrix();
  Eigen::AlignedBox3f box;
  for (Eigen::Vector3f& vertex : shape->vertices) {
    vertex = turn * axes.cwiseProduct(vertex);
    box.extend(vertex);
  }
  const float width = 0.5F * (box.sizes().x() + box.sizes().y());
  const double above = height_share * random->Uniform(0.75, 1.25);
  const double sunk = random->Uniform(0.25, 0.45);
  const auto height = static_cast<float>(above / (1.0 - sunk));
  for (Eigen::Vector3f& vertex : shape->vertices) {
    const Eigen::Vector3f centred = vertex - box.center();
    vertex.head<2>() = centred.head<2>() / width;
    vertex.z() = (centred.z() / box.sizes().z() + 0.5F - static_cast<float>(sunk)) * height;
  }
}

// Area-weighted, then once more with those faces that look the same way: edges stay readable.
void SetNormals(RockShape* shape) {
  shape->normals.assign(shape->vertices.size(), Eigen::Vector3f::Zero());
  for (const bool sharpen : {false, true}) {
    std::vector<Eigen::Vector3f> sums(shape->vertices.size(), Eigen::Vector3f::Zero());
    for (const auto& triangle : shape->triangles) {
      const Eigen::Vector3f& a = shape->vertices[triangle[0]];
      const Eigen::Vector3f area =
          (shape->vertices[triangle[1]] - a).cross(shape->vertices[triangle[2]] - a);
      for (const uint32_t i : triangle) {
        const float cosine = shape->normals[i].dot(area.normalized());
        sums[i] += sharpen ? std::pow(std::max(0.01F, cosine), 8.0F) * area : area;
      }
    }
    for (size_t i = 0; i < sums.size(); ++i) shape->normals[i] = sums[i].normalized();
  }
}

// Cell of the raster that holds a coordinate within [-reach, reach].
float ToCell(float value, double reach) {
  return (value / static_cast<float>(reach) + 1.0F) * 0.5F * kRaster - 0.5F;
}

void RasterTriangle(const std::array<Eigen::Vector3f, 3>& corners, double reach,
                    std::vector<float>* raster) {
  const Eigen::Vector3f& a = corners[0];
  const Eigen::Vector3f ab = corners[1] - a;
  const Eigen::Vector3f ac = corners[2] - a;
  const float area = ab.x() * ac.y() - ab.y() * ac.x();
  if (area <= 1e-9F) return;  // looks down: the upper side alone counts
  Eigen::AlignedBox3f box(a, a);
  box.extend(corners[1]).extend(corners[2]);
  const auto first = [&](float value) {
    return std::max(0, static_cast<int>(ToCell(value, reach)));
  };
  const auto last = [&](float value) {
    return std::min(kRaster - 1, static_cast<int>(std::ceil(ToCell(value, reach))));
  };
  for (int row = first(box.min().y()); row <= last(box.max().y()); ++row) {
    for (int column = first(box.min().x()); column <= last(box.max().x()); ++column) {
      const auto metres = [&](int cell) {
        return ((static_cast<float>(cell) + 0.5F) * 2.0F / kRaster - 1.0F) *
               static_cast<float>(reach);
      };
      const float x = metres(column) - a.x();
      const float y = metres(row) - a.y();
      const float s = (x * ac.y() - y * ac.x()) / area;
      const float t = (y * ab.x() - x * ab.y()) / area;
      if (s < -1e-4F || t < -1e-4F || s + t > 1.0002F) continue;
      float& cell = (*raster)[static_cast<size_t>(row * kRaster + column)];
      cell = std::max(cell, a.z() + s * ab.z() + t * ac.z());
    }
  }
}

}  // namespace

std::vector<RockShape> MakeRockShapes(double height_share) {
  RockShape sphere = Icosahedron();
  for (int i = 0; i < kSubdivisions; ++i) sphere = Subdivided(sphere);
  std::vector<RockShape> shapes(kRockShapes, sphere);
  Random random(1, "rock shapes");
  for (RockShape& shape : shapes) {
    Displace(&random, &shape);
    Cut(&random, &shape);
    Place(&random, height_share, &shape);
    SetNormals(&shape);
  }
  return shapes;
}

RockTops::RockTops(const std::vector<RockShape>& shapes) {
  for (const RockShape& shape : shapes) {
    for (const Eigen::Vector3f& vertex : shape.vertices) {
      reach_ = std::max(reach_, static_cast<double>(vertex.head<2>().norm()));
    }
  }
  for (const RockShape& shape : shapes) {
    std::vector<float>& raster =
        rasters_.emplace_back(static_cast<size_t>(kRaster * kRaster), kBeside);
    for (const auto& [a, b, c] : shape.triangles) {
      RasterTriangle({shape.vertices[a], shape.vertices[b], shape.vertices[c]}, reach_, &raster);
    }
  }
}

double RockTops::Top(const Rock& rock, double x, double y) const {
  REGOLITH_CHECK(rock.shape < rasters_.size(), rock.shape, " of ", rasters_.size(), " shapes");
  const Eigen::Vector2d offset = (Eigen::Vector2d(x, y) - rock.centre) / rock.diameter;
  if (offset.squaredNorm() > reach_ * reach_) return static_cast<double>(kBeside);
  const double cosine = std::cos(rock.yaw);
  const double sine = std::sin(rock.yaw);
  const float u =
      std::clamp(ToCell(static_cast<float>(cosine * offset.x() + sine * offset.y()), reach_), 0.0F,
                 kRaster - 1.001F);
  const float v =
      std::clamp(ToCell(static_cast<float>(cosine * offset.y() - sine * offset.x()), reach_), 0.0F,
                 kRaster - 1.001F);
  const auto column = static_cast<size_t>(u);
  const auto row = static_cast<size_t>(v);
  const float* const cell = &rasters_[rock.shape][row * kRaster + column];
  const float fu = u - static_cast<float>(column);
  const float fv = v - static_cast<float>(row);
  float height = (1.0F - fv) * ((1.0F - fu) * cell[0] + fu * cell[1]) +
                 fv * ((1.0F - fu) * cell[kRaster] + fu * cell[kRaster + 1]);
  // At the outline some of the four cells lie beside the rock; the highest of the others decides.
  if (!std::isfinite(height)) {
    height = std::max({cell[0], cell[1], cell[kRaster], cell[kRaster + 1]});
  }
  return rock.ground + rock.diameter * static_cast<double>(height);
}

}  // namespace regolith

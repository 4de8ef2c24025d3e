// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/gazebo_world.h"

#include <cmath>

#include "regolith/exports/xml_writer.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kClearance = 0.05;  // m between rover and ground at the start

void AddPhysics(const ScenarioOptions& options, XmlWriter* xml) {
  const bool mars = options.planet == "mars";
  xml->Leaf("gravity", Numbers({0.0, 0.0, -options.gravity}));
  xml->Leaf("magnetic_field", "0 0 0");
  xml->Open("atmosphere", {{"type", "adiabatic"}});
  xml->Leaf("temperature", mars ? "210" : "250");  // K
  xml->Leaf("pressure", mars ? "610" : "0");       // Pa
  xml->Close();
  xml->Open("physics", {{"name", "ode"}, {"default", "true"}, {"type", "ode"}});
  xml->Leaf("max_step_size", "0.001");
  xml->Leaf("real_time_factor", "1");
  xml->Leaf("real_time_update_rate", "1000");
  xml->Close();
}

void AddLight(const ScenarioOptions& options, XmlWriter* xml) {
  const bool mars = options.planet == "mars";
  const double elevation = options.sun.elevation_deg * kDegree;
  const double azimuth = options.sun.azimuth_deg * kDegree;
  // Dust takes from the sun and gives to the sky.
  const double direct = std::exp(-options.sun.tau / std::max(std::sin(elevation), 0.05));
  const double sky = 0.02 + 0.5 * (1.0 - std::exp(-options.sun.tau));
  xml->Open("scene");
  xml->Leaf("ambient", Numbers({sky, mars ? 0.85 * sky : sky, mars ? 0.7 * sky : sky, 1.0}));
  xml->Leaf("background", mars ? "0.76 0.62 0.48 1" : "0 0 0 1");
  xml->Leaf("grid", "false");
  xml->Leaf("shadows", "true");
  xml->Close();
  xml->Open("light", {{"name", "sun"}, {"type", "directional"}});
  xml->Leaf("cast_shadows", "true");
  xml->Leaf("pose", "0 0 100 0 0 0");
  const double level = std::max(direct, 0.3);
  xml->Leaf("diffuse", Numbers({level, level, level, 1.0}));
  xml->Leaf("specular", "0.05 0.05 0.05 1");
  xml->Leaf("direction", Numbers({-std::cos(elevation) * std::cos(azimuth),
                                  -std::cos(elevation) * std::sin(azimuth), -std::sin(elevation)}));
  xml->Close();
}

void AddHeightMap(const WorldDescription& world, bool textured, XmlWriter* xml) {
  xml->Open("geometry");
  xml->Open("heightmap");
  if (textured) {
    xml->Open("texture");
    xml->Leaf("size", Number(world.ground_side));
    xml->Leaf("diffuse", std::string("file://") + kTextureName);
    xml->Leaf("normal", "file://media/materials/textures/flat_normal.png");
    xml->Close();
  }
  xml->Leaf("uri", "file://heightmap.png");
  xml->Leaf("size", Numbers({world.ground_side, world.ground_side,
                             world.range.highest - world.range.lowest}));
  xml->Leaf("pos", Numbers({0.0, 0.0, world.range.lowest}));
  xml->Close();
  xml->Close();
}

void AddGround(const WorldDescription& world, XmlWriter* xml) {
  xml->Open("model", {{"name", "terrain"}});
  xml->Leaf("static", "true");
  xml->Open("link", {{"name", "ground"}});
  xml->Open("collision", {{"name", "heights"}});
  AddHeightMap(world, false, xml);
  xml->Open("surface");
  xml->Open("friction");
  xml->Open("ode");
  xml->Leaf("mu", "0.7");
  xml->Leaf("mu2", "0.7");
  xml->Close();
  xml->Close();
  xml->Close();
  xml->Close();
  xml->Open("visual", {{"name", "ground"}});
  if (world.has_mesh) {
    xml->Open("geometry");
    xml->Open("mesh");
    xml->Leaf("uri", "file://terrain.dae");
    xml->Close();
    xml->Close();
  } else {
    AddHeightMap(world, true, xml);
  }
  xml->Close();
  xml->Close();
  xml->Close();
}

}  // namespace

std::string GazeboWorld(const ScenarioOptions& options, const WorldDescription& world,
                        bool with_rover) {
  XmlWriter xml;
  xml.Open("sdf", {{"version", "1.6"}});
  xml.Open("world", {{"name", "regolith_" + options.planet}});
  AddPhysics(options, &xml);
  AddLight(options, &xml);
  AddGround(world, &xml);
  if (with_rover) {
    xml.Open("include");
    xml.Leaf("uri", std::string("model://") + kRoverModel);
    xml.Leaf("name", "rover");
    xml.Leaf("pose", Numbers({world.start.x, world.start.y, world.start.ground + kClearance, 0.0,
                              0.0, 0.0}));
    xml.Close();
  }
  xml.Close();
  xml.Close();
  return xml.Text();
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/mesh_file.h"

#include <array>
#include <charconv>
#include <filesystem>
#include <functional>

#include "regolith/core/version.h"
#include "regolith/exports/xml_writer.h"
#include "regolith/io/atomic_file.h"

namespace regolith {
namespace {

constexpr int kLengthDigits = 4;  // after the point: 0.1 mm
constexpr int kUnitDigits = 6;    // of normals and texture coordinates

void Append(double value, int digits, std::string* text) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, digits);
  text->append(buffer.data(), end.ptr);
}

void Append(size_t value, std::string* text) {
  std::array<char, 24> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text->append(buffer.data(), end.ptr);
}

// A mesh of a million posts is a hundred megabytes of text: it goes to the file row by row.
void ForEachPost(const TerrainPosts& posts, AtomicFile* file,
                 const std::function<void(int i, int j, std::string* text)>& write) {
  std::string text;
  for (int j = 0; j < posts.count; ++j) {
    text.clear();
    for (int i = 0; i < posts.count; ++i) write(i, j, &text);
    file->Write(text);
  }
}

using Triangle = std::array<size_t, 3>;

// Both triangles of each cell; vertices count from 0.
void ForEachTriangle(const TerrainPosts& posts, AtomicFile* file,
                     const std::function<void(const Triangle&, std::string* text)>& write) {
  const auto columns = static_cast<size_t>(posts.count);
  std::string text;
  for (size_t j = 0; j + 1 < columns; ++j) {
    text.clear();
    for (size_t i = 0; i + 1 < columns; ++i) {
      const size_t corner = j * columns + i;
      write({corner, corner + 1, corner + columns + 1}, &text);
      write({corner, corner + columns + 1, corner + columns}, &text);
    }
    file->Write(text);
  }
}

void AppendPosition(const TerrainPosts& posts, int i, int j, char separator, std::string* text) {
  Append(posts.Coordinate(i), kLengthDigits, text);
  *text += ' ';
  Append(posts.Coordinate(j), kLengthDigits, text);
  *text += ' ';
  Append(posts.Height(i, j), kLengthDigits, text);
  *text += separator;
}

void AppendNormal(const TerrainPosts& posts, int i, int j, char separator, std::string* text) {
  const Eigen::Vector3d normal = posts.Normal(i, j);
  for (int k = 0; k < 3; ++k) {
    Append(normal[k], kUnitDigits, text);
    *text += k == 2 ? separator : ' ';
  }
}

void AppendTexturePlace(const TerrainPosts& posts, int i, int j, char separator,
                        std::string* text) {
  Append(i / double(posts.count - 1), kUnitDigits, text);
  *text += ' ';
  Append(j / double(posts.count - 1), kUnitDigits, text);
  *text += separator;
}

struct Source {
  std::string name;
  std::vector<std::string> axes;
  void (*append)(const TerrainPosts&, int, int, char, std::string*);
};

void WriteSource(const Source& source, const TerrainPosts& posts, AtomicFile* file) {
  const std::string count = std::to_string(posts.heights.size());
  const std::string numbers = std::to_string(posts.heights.size() * source.axes.size());
  file->Write("        <source id=\"ground-" + source.name +
              "\">\n          <float_array id=\"ground-" + source.name + "-array\" count=\"" +
              numbers + "\">\n");
  ForEachPost(posts, file, [&](int i, int j, std::string* text) {
    source.append(posts, i, j, i + 1 == posts.count ? '\n' : ' ', text);
  });
  XmlWriter accessor(true, 5);
  accessor.Open("technique_common");
  accessor.Open("accessor", {{"source", "#ground-" + source.name + "-array"},
                             {"count", count},
                             {"stride", std::to_string(source.axes.size())}});
  for (const std::string& axis : source.axes) {
    accessor.Empty("param", {{"name", axis}, {"type", "float"}});
  }
  accessor.Close();
  accessor.Close();
  file->Write("</float_array>\n" + accessor.Text() + "        </source>\n");
}

// Everything in front of the geometry: units, image, material.
std::string ColladaHead(const std::string& texture) {
  XmlWriter xml(true, 1);
  xml.Open("asset");
  xml.Open("contributor");
  xml.Leaf("authoring_tool", "regolith " + ProgramVersion());
  xml.Close();
  // The format demands dates; the same terrain makes the same bytes.
  xml.Leaf("created", "2026-01-01T00:00:00Z");
  xml.Leaf("modified", "2026-01-01T00:00:00Z");
  xml.Empty("unit", {{"name", "metre"}, {"meter", "1"}});
  xml.Leaf("up_axis", "Z_UP");
  xml.Close();
  xml.Open("library_images");
  xml.Open("image", {{"id", "texture"}, {"name", "texture"}});
  xml.Leaf("init_from", texture);
  xml.Close();
  xml.Close();
  xml.Open("library_effects");
  xml.Open("effect", {{"id", "regolith-effect"}});
  xml.Open("profile_COMMON");
  xml.Open("newparam", {{"sid", "texture-surface"}});
  xml.Open("surface", {{"type", "2D"}});
  xml.Leaf("init_from", "texture");
  xml.Close();
  xml.Close();
  xml.Open("newparam", {{"sid", "texture-sampler"}});
  xml.Open("sampler2D");
  xml.Leaf("source", "texture-surface");
  xml.Close();
  xml.Close();
  xml.Open("technique", {{"sid", "common"}});
  xml.Open("lambert");
  xml.Open("diffuse");
  xml.Empty("texture", {{"texture", "texture-sampler"}, {"texcoord", "UVMap"}});
  xml.Close();
  xml.Close();
  xml.Close();
  xml.Close();
  xml.Close();
  xml.Close();
  xml.Open("library_materials");
  xml.Open("material", {{"id", "regolith"}, {"name", "regolith"}});
  xml.Empty("instance_effect", {{"url", "#regolith-effect"}});
  xml.Close();
  xml.Close();
  return xml.Text();
}

std::string ColladaScene() {
  XmlWriter xml(true, 1);
  xml.Open("library_visual_scenes");
  xml.Open("visual_scene", {{"id", "scene"}, {"name", "scene"}});
  xml.Open("node", {{"id", "terrain"}, {"name", "terrain"}, {"type", "NODE"}});
  xml.Open("instance_geometry", {{"url", "#ground"}});
  xml.Open("bind_material");
  xml.Open("technique_common");
  xml.Open("instance_material", {{"symbol", "regolith"}, {"target", "#regolith"}});
  xml.Empty("bind_vertex_input",
            {{"semantic", "UVMap"}, {"input_semantic", "TEXCOORD"}, {"input_set", "0"}});
  for (int i = 0; i < 6; ++i) xml.Close();
  xml.Close();
  xml.Open("scene");
  xml.Empty("instance_visual_scene", {{"url", "#scene"}});
  xml.Close();
  return xml.Text();
}

std::string Stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

void WriteMaterial(const std::string& path, const std::string& texture) {
  WriteFile(path, "# regolith " + ProgramVersion() +
                      "\nnewmtl regolith\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " +
                      texture + "\n");
}

}  // namespace

void WriteCollada(const std::string& path, const TerrainPosts& posts, const std::string& texture) {
  AtomicFile file(path);
  file.Write(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n");
  file.Write(ColladaHead(texture));
  file.Write(
      "  <library_geometries>\n    <geometry id=\"ground\" name=\"ground\">\n      <mesh>\n");
  const std::vector<Source> sources = {{"positions", {"X", "Y", "Z"}, AppendPosition},
                                       {"normals", {"X", "Y", "Z"}, AppendNormal},
                                       {"map", {"S", "T"}, AppendTexturePlace}};
  for (const Source& source : sources) WriteSource(source, posts, &file);
  const auto cells = static_cast<size_t>(posts.count - 1);
  // One index serves position, normal and texture: they have the same offset.
  file.Write(
      "        <vertices id=\"ground-vertices\">\n"
      "          <input semantic=\"POSITION\" source=\"#ground-positions\"/>\n"
      "        </vertices>\n"
      "        <triangles material=\"regolith\" count=\"" +
      std::to_string(2 * cells * cells) +
      "\">\n"
      "          <input semantic=\"VERTEX\" source=\"#ground-vertices\" offset=\"0\"/>\n"
      "          <input semantic=\"NORMAL\" source=\"#ground-normals\" offset=\"0\"/>\n"
      "          <input semantic=\"TEXCOORD\" source=\"#ground-map\" offset=\"0\" set=\"0\"/>\n"
      "          <p>\n");
  ForEachTriangle(posts, &file, [](const Triangle& triangle, std::string* text) {
    for (size_t k = 0; k < 3; ++k) {
      Append(triangle[k], text);
      *text += k == 2 ? '\n' : ' ';
    }
  });
  file.Write(
      "</p>\n        </triangles>\n      </mesh>\n    </geometry>\n  </library_geometries>\n");
  file.Write(ColladaScene());
  file.Write("</COLLADA>\n");
  file.Commit();
}

void WriteObj(const std::string& path, const TerrainPosts& posts, const std::string& texture) {
  const std::string material = Stem(path) + ".mtl";
  WriteMaterial((std::filesystem::path(path).parent_path() / material).string(), texture);
  AtomicFile file(path);
  file.Write("# regolith " + ProgramVersion() + "; metres, x east, y north, z up\nmtllib " +
             material + "\no terrain\n");
  ForEachPost(posts, &file, [&](int i, int j, std::string* text) {
    *text += "v ";
    AppendPosition(posts, i, j, '\n', text);
  });
  ForEachPost(posts, &file, [&](int i, int j, std::string* text) {
    *text += "vt ";
    AppendTexturePlace(posts, i, j, '\n', text);
  });
  ForEachPost(posts, &file, [&](int i, int j, std::string* text) {
    *text += "vn ";
    AppendNormal(posts, i, j, '\n', text);
  });
  file.Write("usemtl regolith\ns 1\n");
  ForEachTriangle(posts, &file, [](const Triangle& triangle, std::string* text) {
    *text += 'f';
    for (const size_t vertex : triangle) {
      for (const char* const before : {" ", "/", "/"}) {
        *text += before;
        Append(vertex + 1, text);
      }
    }
    *text += '\n';
  });
  file.Commit();
}

}  // namespace regolith

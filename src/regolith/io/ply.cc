// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/ply.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

constexpr std::array<const char*, 4> kNames = {"x", "y", "z", "intensity"};

template <typename T>
float Load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<float>(value);
}

struct ScalarType {
  size_t size;
  float (*load)(const char*);
};

const ScalarType* FindType(const std::string& name) {
  static const std::map<std::string, ScalarType> kTypes = {
      {"char", {1, Load<int8_t>}},     {"int8", {1, Load<int8_t>}},
      {"uchar", {1, Load<uint8_t>}},   {"uint8", {1, Load<uint8_t>}},
      {"short", {2, Load<int16_t>}},   {"int16", {2, Load<int16_t>}},
      {"ushort", {2, Load<uint16_t>}}, {"uint16", {2, Load<uint16_t>}},
      {"int", {4, Load<int32_t>}},     {"int32", {4, Load<int32_t>}},
      {"uint", {4, Load<uint32_t>}},   {"uint32", {4, Load<uint32_t>}},
      {"float", {4, Load<float>}},     {"float32", {4, Load<float>}},
      {"double", {8, Load<double>}},   {"float64", {8, Load<double>}}};
  const auto found = kTypes.find(name);
  return found == kTypes.end() ? nullptr : &found->second;
}

struct Field {
  const ScalarType* type = nullptr;
  size_t offset = 0;
};

struct Header {
  size_t count = 0;
  size_t stride = 0;
  std::array<Field, kNames.size()> fields;
};

void AddProperty(const std::string& type_name, const std::string& name, const std::string& path,
                 Header* header) {
  const ScalarType* const type = FindType(type_name);
  if (type == nullptr) {
    throw InputError(path, "vertex property of type '" + type_name + "'; expected a scalar");
  }
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) header->fields[i] = {type, header->stride};
  }
  header->stride += type->size;
}

Header ParseHeader(const std::string& text, const std::string& path) {
  Header header;
  std::istringstream lines(text);
  std::string line;
  std::string element;
  bool binary = false;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string keyword;
    std::string first;
    std::string second;
    words >> keyword >> first >> second;
    if (keyword == "format") binary = first == "binary_little_endian";
    if (keyword == "element") {
      if (element.empty() && first != "vertex") {
        throw InputError(path, "first element is '" + first + "'; expected vertex");
      }
      element = first;
      if (element == "vertex") header.count = std::strtoull(second.c_str(), nullptr, 10);
    }
    if (keyword == "property" && element == "vertex") AddProperty(first, second, path, &header);
  }
  if (!binary) throw InputError(path, "expected PLY of format binary_little_endian");
  for (size_t i = 0; i < 3; ++i) {
    if (header.fields[i].type == nullptr) {
      throw InputError(path, Concatenate("has no vertex property ", kNames[i]));
    }
  }
  return header;
}

}  // namespace

void WritePly(const std::string& path, Span<const MapPoint> points, bool partial) {
  static_assert(sizeof(MapPoint) == 16, "points are written as they lie in memory");
  AtomicFile file(path);
  file.Write(Concatenate("ply\nformat binary_little_endian 1.0\nelement vertex ", points.size(),
                         "\nproperty float x\nproperty float y\nproperty float z\n"
                         "property float intensity\nend_header\n"));
  file.Write({reinterpret_cast<const char*>(points.data()), points.size() * sizeof(MapPoint)});
  file.Commit(partial);
}

std::vector<MapPoint> ReadPly(const std::string& path) {
  const std::string bytes = ReadFile(path);
  if (bytes.rfind("ply", 0) != 0) throw InputError(path, "is not a PLY file");
  const std::string end = "end_header";
  const size_t header_end = bytes.find(end);
  const size_t line_end = bytes.find('\n', header_end);
  if (header_end == std::string::npos || line_end == std::string::npos) {
    throw InputError(path, "has no end_header");
  }
  const Header header = ParseHeader(bytes.substr(0, header_end), path);
  const size_t available = bytes.size() - line_end - 1;
  if (header.count > available / header.stride) {
    throw InputError(path, Concatenate("ends early: ", header.count, " points announced, ",
                                       available / header.stride, " there"));
  }
  std::vector<MapPoint> points(header.count);
  const char* record = bytes.data() + line_end + 1;
  for (MapPoint& point : points) {
    const auto load = [&](size_t i) {
      const Field& field = header.fields[i];
      return field.type == nullptr ? 0.0F : field.type->load(record + field.offset);
    };
    point = {{load(0), load(1), load(2)}, load(3)};
    record += header.stride;
  }
  return points;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/npy.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

constexpr std::string_view kMagic("\x93NUMPY", 6);
constexpr size_t kMaxValues = std::numeric_limits<size_t>::max() / (2 * sizeof(float));

/// The header is a Python dictionary; NumPy always writes the value of a key in one of these forms.
/// Gives what follows `'key':`.
std::optional<std::string_view> ValueOf(std::string_view header, const std::string& key) {
  const size_t found = header.find("'" + key + "':");
  if (found == std::string_view::npos) return std::nullopt;
  std::string_view value = header.substr(found + key.size() + 3);
  value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
  return value;
}

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// "(2, 3)", "(2,)" or "()"; nothing where it is none of them or the product is beyond memory.
std::optional<std::vector<size_t>> ParseShape(std::string_view text) {
  const size_t end = text.find(')');
  if (!StartsWith(text, "(") || end == std::string_view::npos) return std::nullopt;
  std::vector<std::string_view> sizes = SplitAt(text.substr(1, end - 1), ',');
  if (sizes.back().empty()) sizes.pop_back();
  std::vector<size_t> shape;
  size_t product = 1;
  for (const std::string_view size : sizes) {
    const auto number = ParseInteger(size);
    if (!number || *number < 0) return std::nullopt;
    shape.push_back(static_cast<size_t>(*number));
    if (shape.back() > 0 && product > kMaxValues / shape.back()) return std::nullopt;
    product *= shape.back();
  }
  return shape;
}

struct Layout {
  std::string_view header;
  size_t data = 0;  ///< offset
};

/// Versions differ in the width of the header's length: 2 bytes, 4 from version 2 on.
Layout FindHeader(const std::string& path, std::string_view bytes) {
  if (!StartsWith(bytes, kMagic)) throw InputError(path, "is not a .npy file of NumPy");
  const auto byte = [&](size_t index) {
    if (index >= bytes.size()) throw InputError(path, "is cut off in its header");
    return size_t{static_cast<uint8_t>(bytes[index])};
  };
  const size_t version = byte(kMagic.size());
  if (version != 1 && version != 2) {
    throw InputError(path, Concatenate("is of .npy version ", version, "; expected 1 or 2"));
  }
  const size_t start = kMagic.size() + 2;
  const size_t width = version == 1 ? 2 : 4;
  size_t length = 0;
  for (size_t i = width; i-- > 0;) length = length << 8 | byte(start + i);
  if (length > bytes.size() - start - width) throw InputError(path, "is cut off in its header");
  return {bytes.substr(start + width, length), start + width + length};
}

}  // namespace

NpyArray ReadNpy(const std::string& path) {
  const std::string bytes = ReadFile(path);
  const Layout layout = FindHeader(path, bytes);
  const auto type = ValueOf(layout.header, "descr");
  const auto order = ValueOf(layout.header, "fortran_order");
  const auto shape_text = ValueOf(layout.header, "shape");
  if (!type || !order || !shape_text) throw InputError(path, "has no header of NumPy's");
  if (!StartsWith(*type, "'<f4'")) {
    throw InputError(path, "holds " + std::string(type->substr(0, type->find(','))) +
                               "; expected '<f4' (array.astype('<f4'))");
  }
  if (!StartsWith(*order, "False")) {
    throw InputError(path, "is in Fortran's order; expected C's (numpy.ascontiguousarray)");
  }
  const auto shape = ParseShape(*shape_text);
  if (!shape) throw InputError(path, "has a shape that cannot be");
  NpyArray array;
  array.shape = *shape;
  size_t count = 1;
  for (const size_t size : array.shape) count *= size;
  const size_t found = bytes.size() - layout.data;
  if (found != count * sizeof(float)) {
    throw InputError(path, Concatenate("holds ", found, " bytes of data; its header says ",
                                       count * sizeof(float)));
  }
  array.values.resize(count);
  if (count > 0) std::memcpy(array.values.data(), bytes.data() + layout.data, found);
  return array;
}

}  // namespace regolith

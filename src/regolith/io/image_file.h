// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// A PNG or JPEG file as 8-bit grey: colours are weighted, 16 bits cut to the upper 8. Throws
/// InputError.
Image ReadImage(const std::string& path);

/// An 8-bit grey PNG. Throws OutputError.
void WritePng(const std::string& path, const Image& image);

/// Lossless, compressed lightly (level 1), because time is dearer than space while recording. The
/// same bytes for the same image.
std::vector<uint8_t> EncodePng(const Image& image);

/// A PNG or JPEG image; nothing where the bytes are neither.
std::optional<Image> DecodeImage(Span<const uint8_t> bytes);

}  // namespace regolith

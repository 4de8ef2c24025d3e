// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "regolith/core/span.h"

namespace regolith {

/// PNG files of kinds that no sensor has; rows from the top. Throw OutputError.
void WriteGreyPng16(const std::string& path, int width, int height, Span<const uint16_t> grey);
/// Red, green and blue of each pixel.
void WriteColourPng(const std::string& path, int width, int height, Span<const uint8_t> colours);

}  // namespace regolith

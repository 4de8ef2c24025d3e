// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "regolith/core/span.h"

namespace regolith {

/// The SHA-256 digest of bytes (FIPS 180-4), 64 lower-case hexadecimal digits, as `sha256sum`
/// prints.
std::string Sha256Hex(Span<const uint8_t> bytes);

}  // namespace regolith

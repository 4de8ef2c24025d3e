// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "regolith/core/span.h"

namespace regolith {

/// A quoted JavaScript string that may stand inside a script element.
std::string QuoteScript(std::string_view text);

/// A number with so many decimals at most, whatever the locale, without trailing zeros; "null" for
/// NaN and infinity.
void AppendNumber(double value, int decimals, std::string* text);

/// RFC 4648, with padding.
std::string Base64(Span<const uint8_t> bytes);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace regolith {

/// Text for an HTML element or a quoted attribute.
std::string EscapeHtml(std::string_view text);

/// A quoted JavaScript string that may stand inside a script element.
std::string QuoteScript(std::string_view text);

/// A number with so many decimals at most, whatever the locale, without trailing zeros; "null" for
/// NaN and infinity.
void AppendNumber(double value, int decimals, std::string* text);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace regolith {

/// Text as it stands in an element or a quoted attribute of HTML or XML.
std::string EscapeMarkup(std::string_view text);

}  // namespace regolith

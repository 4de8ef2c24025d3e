// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace regolith {

/// The style sheet of a report.
extern const std::string_view kReportStyle;

/// Draws the object `data` (report.cc) with plotly into the elements that the page has.
extern const std::string_view kReportScript;

}  // namespace regolith

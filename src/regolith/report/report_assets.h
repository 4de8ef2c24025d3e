// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace regolith {

/// The files of report/assets, which the build puts into the program.
extern const std::string_view kReportStyle;   ///< report.css
extern const std::string_view kThemeScript;   ///< theme.js: light and dark
extern const std::string_view kSceneScript;   ///< scene.js: the map and the paths in space
extern const std::string_view kReportScript;  ///< report.js: plots and controls

}  // namespace regolith

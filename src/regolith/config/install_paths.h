// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace regolith {

/// The file config/KIND/NAME.yaml beside the source or where the program was installed; a NAME that
/// is a path to an existing file is that file. Throws InputError that lists the known names.
std::string FindConfig(const std::string& kind, const std::string& name);

/// The names that FindConfig knows of a kind: "pipelines", "rigs", "scenarios".
std::vector<std::string> ConfigNames(const std::string& kind);

/// The manifest models/NAME.yaml beside the source or where the program was installed; a NAME that
/// is a path to an existing file is that file. Throws InputError that lists the known names.
std::string FindModel(const std::string& name);

/// The names that FindModel knows; none where no models are installed.
std::vector<std::string> ModelNames();

/// The folder of one kind of things that can be made again, below REGOLITH_CACHE (default
/// ~/.cache/regolith); it need not exist. Empty where neither that nor a home is set.
std::string CacheFolder(const std::string& kind);

/// plotly.min.js of the Python tools; empty where scripts/setup.sh has not installed them.
std::string FindPlotly();

}  // namespace regolith

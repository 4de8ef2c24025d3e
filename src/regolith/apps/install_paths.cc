// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/install_paths.h"

#include <algorithm>
#include <filesystem>

#include "regolith/core/error.h"

namespace regolith {

namespace fs = std::filesystem;

namespace {

// Folders that may hold config/: installed beside the program, or the source tree above
// build/release.
std::vector<fs::path> Roots() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {program.parent_path() / "share" / "regolith", program.parent_path().parent_path(),
          REGOLITH_SOURCE_DIR};
}

fs::path ConfigFolder(const std::string& kind) {
  for (const fs::path& root : Roots()) {
    if (fs::is_directory(root / "config" / kind)) return root / "config" / kind;
  }
  throw InputError("config/" + kind,
                   "was not found beside the program; is the installation whole?");
}

}  // namespace

std::vector<std::string> ConfigNames(const std::string& kind) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(ConfigFolder(kind))) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string FindConfig(const std::string& kind, const std::string& name) {
  const fs::path named = ConfigFolder(kind) / (name + ".yaml");
  if (name.find('/') == std::string::npos && fs::is_regular_file(named)) return named;
  if (fs::is_regular_file(name)) return name;
  std::string known;
  for (const std::string& candidate : ConfigNames(kind)) {
    known += (known.empty() ? "" : ", ") + candidate;
  }
  throw InputError(name, "is neither a file nor one of the " + kind + ": " + known);
}

std::string FindPlotly() {
  for (const fs::path& root : Roots()) {
    if (fs::is_regular_file(root / "plotly.min.js")) return root / "plotly.min.js";
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(root / ".venv" / "lib", error)) {
      const fs::path script =
          entry.path() / "site-packages" / "plotly" / "package_data" / "plotly.min.js";
      if (fs::is_regular_file(script)) return script;
    }
  }
  return "";
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/install_paths.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "regolith/core/error.h"
#include "regolith/core/join.h"

namespace regolith {

namespace fs = std::filesystem;

namespace {

// Folders that may hold config/: installed beside the program (ROS nodes lie in lib/regolith), or
// the source tree above build/release.
std::vector<fs::path> Roots() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path above = program.parent_path();
  return {above / "share" / "regolith", above.parent_path() / "share" / "regolith",
          above.parent_path(), REGOLITH_SOURCE_DIR};
}

fs::path ConfigFolder(const std::string& kind) {
  for (const fs::path& root : Roots()) {
    if (fs::is_directory(root / "config" / kind)) return root / "config" / kind;
  }
  throw InputError("config/" + kind,
                   "was not found beside the program; is the installation whole?");
}

// The stems of a folder's YAML files, sorted.
std::vector<std::string> YamlNames(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::string> FindNamed(const fs::path& folder, const std::string& name) {
  const fs::path named = folder / (name + ".yaml");
  if (name.find('/') == std::string::npos && fs::is_regular_file(named)) return named;
  if (fs::is_regular_file(name)) return name;
  return std::nullopt;
}

// Empty where there is none.
fs::path ModelFolder() {
  for (const fs::path& root : Roots()) {
    if (fs::is_directory(root / "models")) return root / "models";
  }
  return {};
}

}  // namespace

std::vector<std::string> ConfigNames(const std::string& kind) {
  return YamlNames(ConfigFolder(kind));
}

std::string FindConfig(const std::string& kind, const std::string& name) {
  if (const auto found = FindNamed(ConfigFolder(kind), name)) return *found;
  throw InputError(name, "is neither a file nor one of the " + kind + ": " +
                             Join(YamlNames(ConfigFolder(kind))));
}

std::vector<std::string> ModelNames() {
  const fs::path folder = ModelFolder();
  return folder.empty() ? std::vector<std::string>() : YamlNames(folder);
}

std::string FindModel(const std::string& name) {
  if (const auto found = FindNamed(ModelFolder(), name)) return *found;
  const std::string known = Join(ModelNames());
  throw InputError(name, "is neither the manifest of a network (YAML) nor one of the models: " +
                             (known.empty() ? "none are installed" : known));
}

std::string CacheFolder(const std::string& kind) {
  const char* const cache = std::getenv("REGOLITH_CACHE");
  if (cache != nullptr && *cache != '\0') return fs::path(cache) / kind;
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return "";
  return fs::path(home) / ".cache" / "regolith" / kind;
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

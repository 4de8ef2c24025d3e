// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/output_folder.h"

#include <unistd.h>

#include <filesystem>

#include "regolith/core/error.h"

namespace regolith {

namespace fs = std::filesystem;

void PrepareOutputFolder(const std::string& path, bool overwrite) {
  if (path.empty()) throw InputError("--out", "is missing; expected a folder for the results");
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error)) {
    throw InputError("--out " + path, "is a file; expected a folder");
  }
  if (!overwrite && fs::is_directory(path, error) && !fs::is_empty(path, error)) {
    throw InputError("--out " + path, "is not empty; name another folder or add --overwrite");
  }
  fs::create_directories(path, error);
  if (error) throw InputError("--out " + path, "cannot be made: " + error.message());
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    throw InputError("--out " + path, "cannot be written to; check its permissions");
  }
}

}  // namespace regolith

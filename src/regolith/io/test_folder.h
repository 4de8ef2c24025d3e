// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <string>

#include "regolith/core/test_folder.h"

namespace regolith {

/// The real data that some tests use: REGOLITH_DATA, else beside the source.
inline std::string DataFolder() {
  const char* const folder = std::getenv("REGOLITH_DATA");
  return folder != nullptr ? folder : REGOLITH_SOURCE_DIR "/../shared/data";
}

}  // namespace regolith

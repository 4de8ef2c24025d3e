// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/version.h"

namespace regolith {

std::string ProgramVersion() {
  return std::string(REGOLITH_VERSION) + " (" + REGOLITH_COMMIT + ")";
}

}  // namespace regolith

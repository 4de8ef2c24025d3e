// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace regolith {

/// The program's version with the commit it was built from, such as "0.1.0 (a1b2c3d)".
std::string ProgramVersion();

}  // namespace regolith

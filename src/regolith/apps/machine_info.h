// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/report/report_data.h"

namespace regolith {

/// What results depend on: processor, cores, memory, system, compiler, versions of the libraries,
/// this program's version with its commit, and the date (UTC).
std::vector<ReportItem> MachineItems();

}  // namespace regolith

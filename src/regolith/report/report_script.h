// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/report/report_data.h"

namespace regolith {

/// "const data = {...};": what the page's scripts draw. Throws CheckError for a series of unequal
/// lengths.
std::string ReportDataScript(const ReportData& data);

}  // namespace regolith

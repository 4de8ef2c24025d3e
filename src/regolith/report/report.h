// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/report/report_data.h"

namespace regolith {

/// One self-contained page of HTML that works without a network. `plotly_path` is plotly.min.js;
/// where it cannot be read (or is empty), the page has tables and says why it has no figures. Same
/// data, same bytes.
std::string RenderReport(const ReportData& data, const std::string& plotly_path);

}  // namespace regolith

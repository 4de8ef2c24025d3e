// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/apps/run_outputs.h"
#include "regolith/report/report.h"

namespace regolith {

struct StageSummary {
  std::string name;
  double median_ms = 0.0;
  double p99_ms = 0.0;
};

/// The value below which `share` of the values lie, the next higher one of them; 0 for none.
double Quantile(std::vector<double> values, double share);

/// Median and 99th percentile of each stage over the frames that have it, of "total" over the
/// scans, and of "image_total" over the images, where there are any.
std::vector<StageSummary> SummariseStages(const std::vector<FrameReport>& frames);

/// Tracks of the frame before that were found, median over the images; 0 without images.
double MedianTracked(const std::vector<FrameReport>& frames);

/// The text of config.yaml.
std::string ResolvedConfiguration(const RunSetup& setup);

/// The page of one run as plain values.
ReportData ReportOf(const RunSetup& setup, const SlamSystem& system, const RunRecord& record,
                    const std::optional<Evaluation>& evaluation);

}  // namespace regolith

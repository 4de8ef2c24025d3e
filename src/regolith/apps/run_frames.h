// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/apps/run_monitor.h"
#include "regolith/apps/run_setup.h"
#include "regolith/report/report_data.h"

namespace regolith {

/// The images that were kept, with the features that the run's frontend finds in each and in the
/// next one; those that outlier rejection keeps. None where the pipeline tracks no images.
std::vector<ReportFrame> SampleFrames(const RunSetup& setup, const std::vector<ImagePair>& images,
                                      TimeNs start);

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "regolith/io/topic_filter.h"
#include "regolith/sensor/sensor_event.h"

namespace regolith {

/// One sensor of a recording that is a folder of files: gives its measurements in the order of the
/// files. What cannot be used is counted in the filter and skipped.
struct FolderStream {
  std::function<std::optional<SensorEvent>(TopicFilter&)> next;
  TopicFilter filter;
  TimeNs first = 0;  ///< first stamp
  TimeNs last = 0;   ///< last stamp, as far as it is known
};

/// The streams merged in order of their stamps; one measurement of each is in memory. `notices`:
/// remarks on the folder itself.
std::unique_ptr<SensorSource> MergeStreams(std::vector<FolderStream> streams, TimeNs start,
                                           std::vector<std::string> notices);

}  // namespace regolith

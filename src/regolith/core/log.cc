// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace regolith {
namespace {

spdlog::logger& Logger() {
  static const std::unique_ptr<spdlog::logger> logger = [] {
    auto made = std::make_unique<spdlog::logger>("regolith",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("%l: %v");
    return made;
  }();
  return *logger;
}

}  // namespace

void LogInfo(const std::string& message) { Logger().info(message); }
void LogWarning(const std::string& message) { Logger().warn(message); }
void LogError(const std::string& message) { Logger().error(message); }

void SetQuiet(bool quiet) { Logger().set_level(quiet ? spdlog::level::err : spdlog::level::info); }

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace regolith {

/// How a command ended and what it took.
struct ChildResult {
  int exit_code = -1;  ///< 128 + signal where one ended it; 127 where it could not be started
  bool timed_out = false;
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;
  std::optional<double> joules;  ///< of the whole machine meanwhile, where RAPL can be read

  bool Succeeded() const { return exit_code == 0; }
};

/// Runs a program with its output going to the file `log`, and waits. It is ended by SIGINT, and
/// after ten seconds by SIGKILL, when `timeout` seconds have passed or a stop is requested
/// (core/stop.h); it dies with this process.
ChildResult RunChild(const std::vector<std::string>& command, const std::string& log,
                     double timeout);

/// Why a command failed: the last line "error: ..." of its log, else how it ended and
/// the last line that it wrote.
std::string FailureReason(const ChildResult& result, const std::string& log);

/// The path of the running program.
std::string ThisProgram();

}  // namespace regolith

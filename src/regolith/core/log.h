// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace regolith {

/// Lines for the person at the terminal, on standard error; standard output is for results.
void LogInfo(const std::string& message);
void LogWarning(const std::string& message);
void LogError(const std::string& message);

/// Silences everything below an error.
void SetQuiet(bool quiet);

}  // namespace regolith

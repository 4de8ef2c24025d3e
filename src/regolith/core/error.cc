// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/error.h"

namespace regolith {

InputError::InputError(const std::string& where, const std::string& problem)
    : std::runtime_error(where + ": " + problem) {}

InputError::InputError(const std::string& message) : std::runtime_error(message) {}

OutputError::OutputError(const std::string& path, const std::string& problem)
    : std::runtime_error(path + ": " + problem) {}

}  // namespace regolith

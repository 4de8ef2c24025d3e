// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace regolith {

/// Input, configuration or arguments that cannot be used (exit code 2). The message is one line
/// that names the file, key or topic, what was expected, and what to do.
class InputError : public std::runtime_error {
 public:
  /// `where`: file, key or topic; `problem`: what is wrong and what was expected, with the remedy.
  InputError(const std::string& where, const std::string& problem);
  /// A message that names its place itself.
  explicit InputError(const std::string& message);
};

/// An output that could not be written (exit code 1): no space, no permission.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& path, const std::string& problem);
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>

#include <ros/ros.h>

#include "regolith/core/error.h"
#include "regolith/core/log.h"

namespace regolith {

/// The main function of a node: runs it under its default name, says what went wrong in one line
/// and gives the exit code that the program `regolith` has for it.
inline int NodeMain(int argc, char** argv, const char* name, int (*run)()) {
  constexpr int kWrongInput = 2;
  ros::init(argc, argv, name);
  try {
    return run();
  } catch (const InputError& error) {
    LogError(error.what());
    return kWrongInput;
  } catch (const std::exception& error) {
    LogError(error.what());
    return 1;
  }
}

}  // namespace regolith

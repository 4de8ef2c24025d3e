// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <string>

#include "regolith/config/rig_config.h"
#include "regolith/core/error.h"

/// A rig that was accepted must be accepted again as we write it.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace regolith;
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::string written;
  try {
    written = WriteRig(LoadRig(YamlDocument::FromText(text, "fuzz.yaml")));
  } catch (const InputError&) {
    return 0;
  }
  if (WriteRig(LoadRig(YamlDocument::FromText(written, "written.yaml"))) != written) std::abort();
  return 0;
}

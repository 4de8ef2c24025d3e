// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "memory_file.h"
#include "regolith/core/error.h"
#include "regolith/io/tum.h"

/// Poses that were read must read back as we write them.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace regolith;
  std::vector<StampedPose> poses;
  try {
    poses = ReadTum(MemoryFile(data, size).path());
  } catch (const InputError&) {
    return 0;
  }
  std::string text;
  for (const StampedPose& pose : poses) text += TumLine(pose);
  const MemoryFile written(reinterpret_cast<const uint8_t*>(text.data()), text.size());
  const std::vector<StampedPose> again = ReadTum(written.path());
  if (again.size() != poses.size()) std::abort();
  for (size_t i = 0; i < poses.size(); ++i) {
    if (again[i].time != poses[i].time) std::abort();
  }
  return 0;
}

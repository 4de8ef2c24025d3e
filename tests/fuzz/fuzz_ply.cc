// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "memory_file.h"
#include "regolith/core/error.h"
#include "regolith/io/ply.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace regolith;
  try {
    ReadPly(MemoryFile(data, size).path());
  } catch (const InputError&) {
  }
  return 0;
}

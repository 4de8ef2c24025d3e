// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "regolith/io/ros1_messages.h"

namespace {

template <typename T>
void CheckResult(const regolith::MessageResult<T>& result) {
  if (result.value.has_value() != result.problem.empty()) std::abort();
}

}  // namespace

/// Each input is read as every type of message: the parsers share their wire format.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace regolith;
  const MessageBytes message(data, size);
  HeaderStamp(message);
  CheckResult(ParseImu(message));
  CheckResult(ParseOdometry(message));
  CheckResult(ParsePose(message));
  CheckResult(ParseCameraInfo(message));
  CheckResult(ParseImage(message));
  CheckResult(ParseCompressedImage(message));
  ImageEncoding(message, false);
  ImageEncoding(message, true);
  return 0;
}

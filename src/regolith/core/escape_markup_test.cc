// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/escape_markup.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

TEST(EscapeMarkup, LeavesNothingThatWouldEndAnElementOrAnAttribute) {
  EXPECT_EQ(EscapeMarkup("a<b>&\"c\" é"), "a&lt;b&gt;&amp;&quot;c&quot; é");
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/html_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regolith {
namespace {

std::string Number(double value, int decimals) {
  std::string text;
  AppendNumber(value, decimals, &text);
  return text;
}

TEST(HtmlText, EscapesWhatWouldEndAnElementOrAString) {
  EXPECT_EQ(EscapeHtml("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(QuoteScript("</script>\"\\\n"), "\"\\u003c/script>\\u0022\\u005c\\u000a\"");
}

TEST(HtmlText, NumbersAreShortAndNeverNan) {
  EXPECT_EQ(Number(1.25, 3), "1.25");
  EXPECT_EQ(Number(100.0, 2), "100");
  EXPECT_EQ(Number(100.0, 0), "100");
  EXPECT_EQ(Number(-0.0001, 2), "0");
  EXPECT_EQ(Number(-2.5, 2), "-2.5");
  EXPECT_EQ(Number(std::nan(""), 2), "null");
  EXPECT_EQ(Number(INFINITY, 2), "null");
}

}  // namespace
}  // namespace regolith

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

TEST(HtmlText, EscapesWhatWouldEndAStringOrTheScript) {
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

TEST(HtmlText, EncodesBytes) {
  const auto encoded = [](const std::string& text) {
    return Base64({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  };
  // RFC 4648, section 10.
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe"), "//4=");
}

}  // namespace
}  // namespace regolith

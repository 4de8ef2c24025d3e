// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "regolith/core/check.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DocumentTest : public ::testing::Test {
 protected:
  void SetUp() override {
    page_.title = "Tables <1 & 2>";
    page_.folder = ::testing::TempDir() + "document" + std::to_string(::getpid());
    std::filesystem::create_directories(page_.folder);
    std::ofstream(page_.folder + "/a.svg") << "<svg/>";
    page_.header = {{"machine", "two cores"}};
    DocumentSection section;
    section.title = "Table 1";
    section.paragraphs = {"What it shows."};
    section.tables = {
        {"Errors, m",
         {"method", "Moon"},
         {{{"lego_loam"}, {"0.5", true}}, {{"b|c"}, {"failed: no <rig>", false, true}}},
         {"A note."}}};
    section.figures = {{"a.svg", "A figure"}, {"none.png", "Another"}};
    page_.sections = {section};
  }
  void TearDown() override { std::filesystem::remove_all(page_.folder); }

  DocumentPage page_;
};

TEST_F(DocumentTest, AsHtmlHoldsEverything) {
  const std::string html = RenderHtml(page_);
  EXPECT_THAT(html, HasSubstr("Tables &lt;1 &amp; 2&gt;"));
  EXPECT_THAT(html, HasSubstr("<td class=\"number\"><b>0.5</b></td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"failed\">failed: no &lt;rig&gt;</td>"));
  EXPECT_THAT(html, HasSubstr("src=\"data:image/svg+xml;base64,PHN2Zy8+\""));
  EXPECT_THAT(html, HasSubstr("none.png is missing"));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
}

TEST_F(DocumentTest, AsMarkdownHasTablesAndLinks) {
  const std::string text = RenderMarkdown(page_);
  EXPECT_THAT(text, HasSubstr("| method | Moon |\n|---|---:|\n| lego\\_loam | **0.5** |\n"));
  EXPECT_THAT(text, HasSubstr("| b\\|c | failed"));
  EXPECT_THAT(text, HasSubstr("![A figure](a.svg)"));
  EXPECT_THAT(text, HasSubstr("- machine: two cores\n"));
}

TEST_F(DocumentTest, RefusesARowOfAnotherLength) {
  page_.sections[0].tables[0].rows[0].pop_back();
  EXPECT_THROW(RenderHtml(page_), CheckError);
}

}  // namespace
}  // namespace regolith

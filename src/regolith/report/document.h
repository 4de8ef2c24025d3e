// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/report/report_data.h"

namespace regolith {

struct DocumentCell {
  std::string text;
  bool is_best = false;    ///< bold
  bool is_failed = false;  ///< red
};

struct DocumentTable {
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<DocumentCell>> rows;  ///< as long as `columns`; the first cell names it
  std::vector<std::string> notes;               ///< a paragraph each, below
};

/// A picture: a file that is put into the page as it is, relative to `DocumentPage::folder`.
struct DocumentFigure {
  std::string file;  ///< PNG, JPEG or SVG
  std::string caption;
};

struct DocumentSection {
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<DocumentTable> tables;
  std::vector<DocumentFigure> figures;
  int columns = 2;  ///< figures side by side
};

/// Tables and pictures as a page.
struct DocumentPage {
  std::string title;
  std::string folder;              ///< of the figures
  std::vector<ReportItem> header;  ///< machine, versions, command
  std::vector<DocumentSection> sections;
};

/// One self-contained page of HTML; a figure that cannot be read is named instead.
std::string RenderHtml(const DocumentPage& page);

/// The same as Markdown, figures as links to their files.
std::string RenderMarkdown(const DocumentPage& page);

}  // namespace regolith

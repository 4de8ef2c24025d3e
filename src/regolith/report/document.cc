// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/document.h"

#include <cctype>
#include <fstream>
#include <iterator>

#include "regolith/core/check.h"
#include "regolith/core/escape_markup.h"
#include "regolith/report/html_text.h"
#include "regolith/report/report_assets.h"

namespace regolith {
namespace {

std::vector<uint8_t> ReadBytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string TypeOf(const std::string& file) {
  if (EndsWith(file, ".svg")) return "image/svg+xml";
  return EndsWith(file, ".png") ? "image/png" : "image/jpeg";
}

/// Numbers, and the dash where there is none, are set to the right.
bool IsNumber(const std::string& text) {
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) != 0 ||
                           text[0] == '-' || text.rfind("–", 0) == 0);
}

std::string CellHtml(const DocumentCell& cell) {
  const std::string text = EscapeMarkup(cell.text);
  if (cell.is_failed) return "<td class=\"failed\">" + text + "</td>";
  if (!IsNumber(cell.text)) return "<td>" + text + "</td>";
  return "<td class=\"number\">" + (cell.is_best ? "<b>" + text + "</b>" : text) + "</td>";
}

std::string TableHtml(const DocumentTable& table) {
  std::string html = "<div class=\"table\"><table class=\"data\"><caption>" +
                     EscapeMarkup(table.caption) + "</caption><thead><tr>";
  for (size_t i = 0; i < table.columns.size(); ++i) {
    const bool is_number = i > 0 && !table.rows.empty() && IsNumber(table.rows[0][i].text);
    html +=
        (is_number ? "<th class=\"number\">" : "<th>") + EscapeMarkup(table.columns[i]) + "</th>";
  }
  html += "</tr></thead>\n";
  for (const std::vector<DocumentCell>& row : table.rows) {
    REGOLITH_CHECK(row.size() == table.columns.size(), table.caption, ": ", row.size(), " of ",
                   table.columns.size(), " cells");
    html += "<tr><th scope=\"row\">" + EscapeMarkup(row.front().text) + "</th>";
    for (size_t i = 1; i < row.size(); ++i) html += CellHtml(row[i]);
    html += "</tr>\n";
  }
  html += "</table></div>\n";
  for (const std::string& note : table.notes) {
    html += "<p class=\"note\">" + EscapeMarkup(note) + "</p>\n";
  }
  return html;
}

std::string FigureHtml(const DocumentPage& page, const DocumentFigure& figure) {
  const std::vector<uint8_t> bytes = ReadBytes(page.folder + "/" + figure.file);
  const std::string caption = EscapeMarkup(figure.caption);
  if (bytes.empty()) {
    return "<figure><p class=\"note\">" + EscapeMarkup(figure.file) +
           " is missing</p><figcaption>" + caption + "</figcaption></figure>\n";
  }
  return "<figure><img alt=\"" + caption + "\" src=\"data:" + TypeOf(figure.file) + ";base64," +
         Base64(bytes) + "\"><figcaption>" + caption + "</figcaption></figure>\n";
}

std::string SectionHtml(const DocumentPage& page, const DocumentSection& section) {
  std::string html = "<section class=\"wide\"><h2>" + EscapeMarkup(section.title) + "</h2>\n";
  for (const std::string& paragraph : section.paragraphs) {
    html += "<p>" + EscapeMarkup(paragraph) + "</p>\n";
  }
  for (const DocumentTable& table : section.tables) html += TableHtml(table);
  if (!section.figures.empty()) {
    html += Concatenate("<div class=\"pictures columns-", section.columns, "\">\n");
    for (const DocumentFigure& figure : section.figures) html += FigureHtml(page, figure);
    html += "</div>\n";
  }
  return html + "</section>\n";
}

std::string EscapeMarkdown(const std::string& text) {
  std::string escaped;
  for (const char character : text) {
    if (character == '|' || character == '*' || character == '_') escaped += '\\';
    escaped += character == '\n' ? ' ' : character;
  }
  return escaped;
}

std::string TableMarkdown(const DocumentTable& table) {
  std::string text = "**" + EscapeMarkdown(table.caption) + "**\n\n|";
  std::string rule = "|";
  for (size_t i = 0; i < table.columns.size(); ++i) {
    text += " " + EscapeMarkdown(table.columns[i]) + " |";
    rule += i == 0 ? "---|" : "---:|";
  }
  text += "\n" + rule + "\n";
  for (const std::vector<DocumentCell>& row : table.rows) {
    text += "|";
    for (const DocumentCell& cell : row) {
      const std::string content = EscapeMarkdown(cell.text);
      text += cell.is_best ? " **" + content + "** |" : " " + content + " |";
    }
    text += "\n";
  }
  for (const std::string& note : table.notes) text += "\n" + EscapeMarkdown(note) + "\n";
  return text + "\n";
}

}  // namespace

std::string RenderHtml(const DocumentPage& page) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>" +
      EscapeMarkup(page.title) + "</title>\n<style>" + std::string(kReportStyle) +
      "</style></head>\n<body>\n<header><div class=\"title\"><h1>" + EscapeMarkup(page.title) +
      "</h1><button id=\"theme\" type=\"button\" title=\"Light or "
      "dark\">◐</button></div></header>\n"
      "<main>\n<section class=\"wide\"><table>";
  for (const ReportItem& item : page.header) {
    html += "<tr><th scope=\"row\">" + EscapeMarkup(item.name) + "</th><td>" +
            EscapeMarkup(item.value) + "</td></tr>\n";
  }
  html += "</table></section>\n";
  for (const DocumentSection& section : page.sections) html += SectionHtml(page, section);
  return html + "</main>\n<script>\n" + std::string(kThemeScript) + "</script>\n</body></html>\n";
}

std::string RenderMarkdown(const DocumentPage& page) {
  std::string text = "# " + EscapeMarkdown(page.title) + "\n\n";
  for (const ReportItem& item : page.header) {
    text += "- " + EscapeMarkdown(item.name) + ": " + EscapeMarkdown(item.value) + "\n";
  }
  for (const DocumentSection& section : page.sections) {
    text += "\n## " + EscapeMarkdown(section.title) + "\n\n";
    for (const std::string& paragraph : section.paragraphs) {
      text += EscapeMarkdown(paragraph) + "\n\n";
    }
    for (const DocumentTable& table : section.tables) text += TableMarkdown(table);
    for (const DocumentFigure& figure : section.figures) {
      text += "![" + EscapeMarkdown(figure.caption) + "](" + figure.file + ")\n\n" +
              EscapeMarkdown(figure.caption) + "\n\n";
    }
  }
  return text;
}

}  // namespace regolith

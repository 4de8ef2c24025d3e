// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/report.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "regolith/core/check.h"
#include "regolith/core/escape_markup.h"
#include "regolith/report/html_text.h"
#include "regolith/report/report_assets.h"
#include "regolith/report/report_map.h"
#include "regolith/report/report_script.h"

namespace regolith {
namespace {

constexpr int kJpegQuality = 82;

std::string ReadWhole(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  return text.str();
}

std::string NumberText(double value, int decimals) {
  std::string text;
  AppendNumber(value, decimals, &text);
  return text;
}

std::string Fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string MapNote(const ReportData& data) {
  const size_t total = std::max(data.map_total, data.map.size());
  const size_t shown = std::min(data.map.size(), kReportMapPoints);
  if (shown == 0) return "No map.";
  if (shown == total) return Concatenate("All ", total, " points of the map.");
  return Concatenate("The map is thinned to ", shown, " of its ", total, " points.");
}

std::string Table(const std::vector<ReportItem>& items) {
  std::string table = "<table>";
  for (const ReportItem& item : items) {
    table += "<tr><th scope=\"row\">" + EscapeMarkup(item.name) + "</th><td>" +
             EscapeMarkup(item.value) + "</td></tr>\n";
  }
  return table + "</table>";
}

std::vector<ReportItem> StatisticsItems(const ErrorStatistics& ape) {
  std::vector<ReportItem> items;
  for (const auto& [name, value] :
       {std::pair{"RMSE", ape.rmse}, std::pair{"mean", ape.mean}, std::pair{"median", ape.median},
        std::pair{"standard deviation", ape.std}, std::pair{"minimum", ape.min},
        std::pair{"maximum", ape.max}}) {
    items.push_back({name, Fixed(value, 4) + " m"});
  }
  return items;
}

std::string StageTable(const std::vector<ReportStage>& stages) {
  std::string table =
      "<table><thead><tr><th>stage</th><th class=\"number\">median, ms</th>"
      "<th class=\"number\">99 %, ms</th></tr></thead>\n";
  for (const ReportStage& stage : stages) {
    table += "<tr><th scope=\"row\">" + EscapeMarkup(stage.name) + "</th><td class=\"number\">" +
             Fixed(stage.median_ms, 2) + "</td><td class=\"number\">" + Fixed(stage.p99_ms, 2) +
             "</td></tr>\n";
  }
  return table + "</table>";
}

std::string Section(const std::string& title, const std::string& body,
                    const std::string& classes = "") {
  return "<section class=\"" + classes + "\"><h2>" + EscapeMarkup(title) + "</h2>\n" + body +
         "</section>\n";
}

std::string Figure(const std::string& id) {
  return "<div class=\"figure\" id=\"" + id + "\"></div>\n";
}

std::string Header(const ReportData& data) {
  std::string html = "<header><div class=\"title\"><h1>" + EscapeMarkup(data.title) +
                     "</h1><button id=\"theme\" type=\"button\" title=\"Light or dark\">◐</button>"
                     "</div>\n<p class=\"subtitle\">Pipeline <b>" +
                     EscapeMarkup(data.pipeline) + "</b></p>\n<div class=\"tiles\">";
  for (const ReportItem& item : data.highlights) {
    html += "<div class=\"tile\"><span>" + EscapeMarkup(item.name) + "</span><b>" +
            EscapeMarkup(item.value) + "</b></div>\n";
  }
  return html + "</div></header>\n";
}

std::string SceneSection(const ReportData& data) {
  return Section("Map and trajectory",
                 "<div class=\"bar\" id=\"scene-bar\"></div>\n<div class=\"scene\" "
                 "id=\"scene\"></div>\n<div class=\"play\" id=\"scene-play\"></div>\n"
                 "<p class=\"note\">" +
                     MapNote(data) +
                     " Drag to turn, scroll or pinch to zoom, right-drag or two fingers to shift; "
                     "click the path or a plot over time to go there.</p>",
                 "wide");
}

std::string FigureSections(const ReportData& data) {
  std::string html;
  const bool has_path = !data.estimate.empty() || !data.reference.empty();
  if (has_path || !data.map.empty()) html += SceneSection(data);
  if (has_path) html += Section("From above", Figure("top"));
  if (!data.errors.empty()) {
    html += Section("Error against truth, aligned", Figure("errors"));
  }
  if (data.yaw_error) html += Section("Error of the heading", Figure("yaw"));
  if (!data.features.empty()) html += Section("Features", Figure("features"));
  if (!data.leader.empty()) {
    html += Section("What led, and what was degenerate", Figure("leader"));
  }
  for (size_t i = 0; i < data.groups.size(); ++i) {
    html += Section(data.groups[i].title, Figure(Concatenate("group_", i)));
  }
  if (!data.stages.empty()) html += Section("Time of each stage", Figure("stages"));
  return html;
}

/// Points as dots, their way to the next image as lines, over the picture.
std::string FeatureOverlay(const ReportFrame& frame) {
  std::string dots;
  std::string ways;
  const auto append = [](float value, std::string* text) {
    AppendNumber(static_cast<double>(value), 1, text);
    *text += ' ';
  };
  for (const ReportFeature& feature : frame.features) {
    for (std::string* path : {&dots, &ways}) {
      *path += 'M';
      append(feature.pixel.x(), path);
      append(feature.pixel.y(), path);
    }
    dots += "h0";
    ways += 'L';
    append(feature.next.x(), &ways);
    append(feature.next.y(), &ways);
  }
  return Concatenate("<svg viewBox=\"0 0 ", frame.width, " ", frame.height,
                     "\" preserveAspectRatio=\"none\"><path d=\"", ways,
                     "\" stroke=\"#ffd43b\" stroke-width=\"1.4\" fill=\"none\"/><path d=\"", dots,
                     "\" stroke=\"#ff6b3d\" stroke-width=\"4\" stroke-linecap=\"round\" "
                     "fill=\"none\"/></svg>");
}

std::string FramesSection(const std::vector<ReportFrame>& frames) {
  std::string html = "<div class=\"frames\">";
  for (const ReportFrame& frame : frames) {
    REGOLITH_CHECK(
        frame.grey.size() == static_cast<size_t>(frame.width) * static_cast<size_t>(frame.height),
        frame.grey.size(), " bytes of ", frame.width, " × ", frame.height);
    const cv::Mat image(frame.height, frame.width, CV_8UC1,
                        const_cast<uint8_t*>(frame.grey.data()));  // only read
    std::vector<uint8_t> bytes;
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
    html += "<figure data-time=\"" + NumberText(frame.seconds, 3) +
            "\"><div class=\"picture\"><img alt=\"camera image\" " +
            Concatenate("width=\"", frame.width, "\" height=\"", frame.height, "\" ") +
            "src=\"data:image/jpeg;base64," + Base64(bytes) + "\">" + FeatureOverlay(frame) +
            "</div><figcaption>" + EscapeMarkup(frame.caption) + "</figcaption></figure>\n";
  }
  return Section("Sample frames with features", html + "</div>\n", "wide");
}

std::string TableSections(const ReportData& data) {
  std::string html;
  if (!data.summary.empty()) html += Section("Summary", Table(data.summary));
  std::string figures;
  if (data.ape) {
    figures += "<h3>Absolute pose error</h3>" + Table(StatisticsItems(*data.ape));
  }
  if (!data.stages.empty()) {
    figures += "<h3>Stages</h3>" + StageTable(data.stages);
  }
  if (!figures.empty()) html += Section("Figures", figures);
  if (!data.configuration.empty()) {
    html += Section("Configuration",
                    "<details><summary>Show all settings, resolved</summary><pre>" +
                        EscapeMarkup(data.configuration) + "</pre></details>",
                    "wide");
  }
  return html;
}

}  // namespace

std::string RenderReport(const ReportData& data, const std::string& plotly_path) {
  const std::string plotly = plotly_path.empty() ? "" : ReadWhole(plotly_path);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>" +
      EscapeMarkup(data.title) + "</title>\n<style>" + std::string(kReportStyle) +
      "</style></head>\n<body>\n" + Header(data) + "<main>\n";
  if (plotly.empty()) {
    html += "<p class=\"notice\">This page has no figures: plotly.min.js was not found" +
            (plotly_path.empty() ? std::string() : " at " + EscapeMarkup(plotly_path)) +
            ". scripts/setup.sh installs it; run again to draw them.</p>\n";
  } else {
    html += FigureSections(data);
  }
  if (!data.frames.empty()) html += FramesSection(data.frames);
  html += TableSections(data) + "</main>\n";
  html += "<script>\n" + std::string(kThemeScript) + "</script>\n";
  if (!plotly.empty()) {
    html += "<script>" + plotly + "</script>\n<script>\n" + ReportDataScript(data) +
            "</script>\n<script>\n" + std::string(kSceneScript) + "</script>\n<script>\n" +
            std::string(kReportScript) + "</script>\n";
  }
  return html + "</body></html>\n";
}

}  // namespace regolith

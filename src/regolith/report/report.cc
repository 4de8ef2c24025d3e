// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/report.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "regolith/core/check.h"
#include "regolith/report/html_text.h"
#include "regolith/report/report_template.h"

namespace regolith {
namespace {

// Lines longer than this are drawn from every n-th pose: truth has 100 a second.
constexpr size_t kLinePoints = 20000;
constexpr int kMillimetres = 3;

std::string ReadWhole(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  return text.str();
}

/// "name:[...]," of `count` numbers, evenly thinned to `limit`.
void AppendArray(const char* name, size_t count, size_t limit, int decimals,
                 const std::function<double(size_t)>& value, std::string* script) {
  const size_t shown = std::min(count, limit);
  *script += name;
  *script += ":[";
  for (size_t i = 0; i < shown; ++i) {
    if (i > 0) *script += ',';
    AppendNumber(value(i * count / shown), decimals, script);
  }
  *script += "],";
}

void AppendTrajectory(const char* name, const std::vector<StampedPose>& poses, TimeNs start,
                      std::string* script) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  *script += std::string(name) + ":{";
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = [&](size_t i) { return poses[i].T_world_body.translation[axis]; };
    AppendArray(kAxes[axis], poses.size(), kLinePoints, kMillimetres, coordinate, script);
  }
  const auto seconds = [&](size_t i) { return SecondsBetween(start, poses[i].time); };
  AppendArray("t", poses.size(), kLinePoints, 2, seconds, script);
  *script += "},\n";
}

void AppendMap(const ReportData& data, std::string* script) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  const std::vector<ReportMapPoint>& map = data.map;
  *script += "map:{name:" + QuoteScript(data.map_value_name) + ",";
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = [&](size_t i) { return static_cast<double>(map[i].position[axis]); };
    AppendArray(kAxes[axis], map.size(), kReportMapPoints, 2, coordinate, script);
  }
  const auto value = [&](size_t i) { return static_cast<double>(map[i].value); };
  AppendArray("value", map.size(), kReportMapPoints, 2, value, script);
  *script += "},\n";
}

void AppendSeries(const ReportSeries& series, std::string* script) {
  REGOLITH_CHECK(series.seconds.size() == series.values.size(), series.name, ": ",
                 series.seconds.size(), " times, ", series.values.size(), " values");
  *script += "{name:" + QuoteScript(series.name) + ",";
  const size_t count = series.seconds.size();
  AppendArray(
      "t", count, kLinePoints, 3, [&](size_t i) { return series.seconds[i]; }, script);
  AppendArray(
      "v", count, kLinePoints, 5, [&](size_t i) { return series.values[i]; }, script);
  *script += "}";
}

void AppendStages(const std::vector<ReportStage>& stages, std::string* script) {
  *script += "stages:{names:[";
  for (const ReportStage& stage : stages) *script += QuoteScript(stage.name) + ",";
  *script += "],";
  const size_t count = stages.size();
  AppendArray(
      "median", count, count, 3, [&](size_t i) { return stages[i].median_ms; }, script);
  AppendArray(
      "p99", count, count, 3, [&](size_t i) { return stages[i].p99_ms; }, script);
  *script += "},\n";
}

/// The data as a JavaScript object.
std::string DataScript(const ReportData& data) {
  std::string script = "const data = {\n";
  if (!data.estimate.empty()) {
    AppendTrajectory("estimate", data.estimate, data.estimate.front().time, &script);
  }
  if (!data.reference.empty()) {
    const TimeNs start =
        data.estimate.empty() ? data.reference.front().time : data.estimate.front().time;
    AppendTrajectory("reference", data.reference, start, &script);
  }
  if (!data.map.empty()) AppendMap(data, &script);
  for (const auto& [name, series] :
       {std::pair{"error", &data.error}, std::pair{"frame_ms", &data.frame_ms}}) {
    if (!series->has_value()) continue;
    script += std::string(name) + ":";
    AppendSeries(**series, &script);
    script += ",\n";
  }
  if (!data.stages.empty()) AppendStages(data.stages, &script);
  if (!data.status.empty()) {
    script += "status:[";
    for (const ReportSeries& series : data.status) {
      AppendSeries(series, &script);
      script += ",";
    }
    script += "],\n";
  }
  return script + "};\n";
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
    table += "<tr><th scope=\"row\">" + EscapeHtml(item.name) + "</th><td>" +
             EscapeHtml(item.value) + "</td></tr>\n";
  }
  return table + "</table>";
}

std::vector<ReportItem> StatisticsItems(const ErrorStatistics& ape) {
  std::vector<ReportItem> items;
  for (const auto& [name, value] :
       {std::pair{"RMSE", ape.rmse}, std::pair{"mean", ape.mean}, std::pair{"median", ape.median},
        std::pair{"standard deviation", ape.std}, std::pair{"minimum", ape.min},
        std::pair{"maximum", ape.max}}) {
    std::string text;
    AppendNumber(value, 4, &text);
    items.push_back({name, text + " m"});
  }
  return items;
}

std::vector<ReportItem> StageItems(const std::vector<ReportStage>& stages) {
  std::vector<ReportItem> items;
  for (const ReportStage& stage : stages) {
    std::string text;
    AppendNumber(stage.median_ms, 2, &text);
    text += " ms, 99 %: ";
    AppendNumber(stage.p99_ms, 2, &text);
    items.push_back({stage.name, text + " ms"});
  }
  return items;
}

std::string Section(const std::string& title, const std::string& body,
                    const std::string& classes = "") {
  return "<section class=\"" + classes + "\"><h2>" + EscapeHtml(title) + "</h2>\n" + body +
         "</section>\n";
}

std::string Figure(const std::string& id) {
  return "<div class=\"figure\" id=\"" + id + "\"></div>\n";
}

std::string Header(const ReportData& data) {
  std::string html = "<header><h1>" + EscapeHtml(data.title) + "</h1>\n<p>Pipeline <b>" +
                     EscapeHtml(data.pipeline) + "</b></p>\n<div class=\"tiles\">";
  for (const ReportItem& item : data.highlights) {
    html += "<div class=\"tile\"><span>" + EscapeHtml(item.name) + "</span><b>" +
            EscapeHtml(item.value) + "</b></div>\n";
  }
  return html + "</div></header>\n";
}

std::string FigureSections(const ReportData& data) {
  std::string html;
  const bool has_path = !data.estimate.empty() || !data.reference.empty();
  if (has_path || !data.map.empty()) {
    html += Section("Map and trajectory",
                    Figure("scene") + "<p class=\"note\">" + MapNote(data) +
                        " Drag to turn, scroll or pinch to zoom, right-drag to shift.</p>",
                    "wide");
  }
  if (has_path) html += Section("From above", Figure("top"));
  if (data.error) html += Section("Error over time", Figure("error"));
  if (!data.stages.empty()) html += Section("Time of each stage", Figure("stages"));
  if (data.frame_ms) html += Section("Time of each frame", Figure("frame_ms"));
  if (!data.status.empty()) html += Section("Status", Figure("status"), "wide");
  return html;
}

std::string TableSections(const ReportData& data) {
  std::string html;
  if (!data.summary.empty()) html += Section("Summary", Table(data.summary));
  if (data.ape) html += Section("Absolute pose error", Table(StatisticsItems(*data.ape)));
  if (!data.stages.empty()) html += Section("Stages, median", Table(StageItems(data.stages)));
  if (!data.configuration.empty()) {
    html += Section("Configuration",
                    "<details><summary>Show all settings</summary><pre>" +
                        EscapeHtml(data.configuration) + "</pre></details>",
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
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      EscapeHtml(data.title) + "</title>\n<style>" + std::string(kReportStyle) +
      "</style></head>\n<body>\n" + Header(data) + "<main>\n";
  if (plotly.empty()) {
    html += "<p class=\"notice\">This page has no figures: plotly.min.js was not found" +
            (plotly_path.empty() ? std::string() : " at " + EscapeHtml(plotly_path)) +
            ". scripts/setup.sh installs it; run again to draw them.</p>\n";
  } else {
    html += FigureSections(data);
  }
  html += TableSections(data) + "</main>\n";
  if (!plotly.empty()) {
    html += "<script>" + plotly + "</script>\n<script>\n" + DataScript(data) +
            std::string(kReportScript) + "</script>\n";
  }
  return html + "</body></html>\n";
}

}  // namespace regolith

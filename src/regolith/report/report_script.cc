// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/report_script.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Geometry>

#include "regolith/core/check.h"
#include "regolith/report/html_text.h"
#include "regolith/report/report_map.h"

namespace regolith {
namespace {

// Lines longer than this are drawn from every n-th pose: truth has 100 a second.
constexpr size_t kLinePoints = 20000;
// A value a scan over 700 s, several of them: thinned, they are drawn faster and look the same.
constexpr size_t kSeriesPoints = 7500;
constexpr int kMillimetres = 3;
constexpr double kPointMetres = 0.16;  // diameter of a point that is drawn

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

void AppendValue(const char* name, double value, int decimals, std::string* script) {
  *script += std::string(name) + ":";
  AppendNumber(value, decimals, script);
  *script += ",";
}

/// "name:[a,b,c],"
template <typename Vector>
void AppendVector(const char* name, const Vector& vector, int decimals, std::string* script) {
  AppendArray(
      name, static_cast<size_t>(vector.size()), 1000, decimals,
      [&](size_t i) { return static_cast<double>(vector[static_cast<Eigen::Index>(i)]); }, script);
}

void AppendPath(const char* name, const std::vector<StampedPose>& poses, TimeNs start,
                std::string* script) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  *script += std::string(name) + ":{";
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = [&](size_t i) { return poses[i].T_world_body.translation[axis]; };
    AppendArray(kAxes[axis], poses.size(), kLinePoints, kMillimetres, coordinate, script);
  }
  const auto seconds = [&](size_t i) { return SecondsBetween(start, poses[i].time); };
  AppendArray("t", poses.size(), kLinePoints, kMillimetres, seconds, script);
}

/// The same poses as AppendPath shows: x, y, z, w one after the other.
void AppendAttitudes(const std::vector<StampedPose>& poses, std::string* script) {
  const size_t shown = std::min(poses.size(), kLinePoints);
  const auto part = [&](size_t i) {
    const size_t pose = i / 4 * poses.size() / shown;
    return poses[pose].T_world_body.rotation.coeffs()[static_cast<Eigen::Index>(i % 4)];
  };
  AppendArray("q", 4 * shown, 4 * shown, 4, part, script);
}

/// Errors above the value that 98 per cent of them keep below have the last colour.
double ErrorScale(const std::vector<double>& errors) {
  std::vector<double> known;
  for (const double error : errors) {
    if (std::isfinite(error)) known.push_back(error);
  }
  if (known.empty()) return 1.0;
  std::sort(known.begin(), known.end());
  return std::max(known[(known.size() - 1) * 98 / 100], 1e-6);
}

void AppendEstimate(const ReportData& data, std::string* script) {
  AppendPath("estimate", data.estimate, data.start, script);
  AppendAttitudes(data.estimate, script);
  if (!data.estimate_error.empty()) {
    REGOLITH_CHECK(data.estimate_error.size() == data.estimate.size(), data.estimate_error.size(),
                   " errors of ", data.estimate.size(), " poses");
    AppendArray(
        "error", data.estimate.size(), kLinePoints, 4,
        [&](size_t i) { return data.estimate_error[i]; }, script);
    AppendValue("errorScale", ErrorScale(data.estimate_error), 6, script);
  }
  *script += "},\n";
}

void AppendMap(const ReportData& data, std::string* script) {
  std::vector<ReportMapPoint> shown;
  for (const size_t i : ThinEvenly(data.map.size(), kReportMapPoints)) shown.push_back(data.map[i]);
  const PackedMap map = PackMap(shown);
  *script += "map:{points:\"" + Base64(map.bytes) + "\",";
  AppendValue("count", static_cast<double>(map.count), 0, script);
  // Thinned, the points stand further apart and are drawn larger.
  const double thinned = static_cast<double>(std::max(data.map_total, data.map.size())) /
                         static_cast<double>(std::max<size_t>(1, map.count));
  AppendValue("spacing", kPointMetres * std::sqrt(thinned), 4, script);
  AppendVector("scale", Eigen::Vector3f(map.high - map.low), 5, script);
  AppendVector("offset", map.low, 5, script);
  AppendVector("heights", map.heights, 3, script);
  AppendVector("intensities", map.intensities, 3, script);
  *script += "box:[[";
  for (const Eigen::Vector3f& corner : {map.low, map.high}) {
    for (const float value : {corner.x(), corner.y(), corner.z()}) {
      AppendNumber(value, 3, script);
      *script += ",";
    }
    *script += "],[";
  }
  *script += "]]},\n";
}

void AppendSeries(const ReportSeries& series, std::string* script) {
  REGOLITH_CHECK(series.seconds.size() == series.values.size(), series.name, ": ",
                 series.seconds.size(), " times, ", series.values.size(), " values");
  *script += "{name:" + QuoteScript(series.name) + ",";
  const size_t count = series.seconds.size();
  AppendArray(
      "t", count, kSeriesPoints, 2, [&](size_t i) { return series.seconds[i]; }, script);
  AppendArray(
      "v", count, kSeriesPoints, 4, [&](size_t i) { return series.values[i]; }, script);
  *script += "}";
}

void AppendList(const char* name, const std::vector<ReportSeries>& list, std::string* script) {
  if (list.empty()) return;
  *script += std::string(name) + ":[";
  for (const ReportSeries& series : list) {
    AppendSeries(series, script);
    *script += ",";
  }
  *script += "],\n";
}

void AppendOne(const char* name, const std::optional<ReportSeries>& series, std::string* script) {
  if (!series) return;
  *script += std::string(name) + ":";
  AppendSeries(*series, script);
  *script += ",\n";
}

void AppendStages(const std::vector<ReportStage>& stages, std::string* script) {
  if (stages.empty()) return;
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

void AppendLeader(const std::vector<ReportSpan>& spans, std::string* script) {
  if (spans.empty()) return;
  *script += "leader:[";
  for (const ReportSpan& span : spans) {
    *script += "{name:" + QuoteScript(span.name) + ",";
    AppendValue("from", span.from, 2, script);
    AppendValue("to", span.to, 2, script);
    *script += "},";
  }
  *script += "],\n";
}

void AppendGroups(const std::vector<ReportGroup>& groups, std::string* script) {
  if (groups.empty()) return;
  *script += "groups:[";
  for (size_t i = 0; i < groups.size(); ++i) {
    *script += Concatenate("{id:\"group_", i, "\",stacked:", groups[i].stacked ? "true" : "false",
                           ",unit:", QuoteScript(groups[i].unit), ",");
    AppendList("series", groups[i].series, script);
    *script += "},";
  }
  *script += "],\n";
}

void AppendKeyframes(const ReportData& data, std::string* script) {
  if (!data.keyframes.empty()) {
    *script += "keyframes:[";
    for (const StampedPose& pose : data.keyframes) {
      const Eigen::Vector3d& place = pose.T_world_body.translation;
      *script += "[";
      for (const double value : {place.x(), place.y(), place.z()}) {
        AppendNumber(value, kMillimetres, script);
        *script += ",";
      }
      AppendNumber(SecondsBetween(data.start, pose.time), 2, script);
      *script += "],";
    }
    *script += "],\n";
  }
  if (data.loops.empty()) return;
  *script += "loops:[";
  for (const ReportLoop& loop : data.loops) {
    *script += "{";
    AppendVector("from", loop.from, kMillimetres, script);
    AppendVector("to", loop.to, kMillimetres, script);
    AppendValue("t", SecondsBetween(data.start, loop.time), 2, script);
    *script += "},";
  }
  *script += "],\n";
}

}  // namespace

std::string ReportDataScript(const ReportData& data) {
  std::string script = "const data = {\n";
  AppendValue("duration", data.duration, 3, &script);
  if (!data.estimate.empty()) AppendEstimate(data, &script);
  if (!data.reference.empty()) {
    AppendPath("reference", data.reference, data.start, &script);
    script += "},\n";
  }
  if (!data.map.empty()) AppendMap(data, &script);
  AppendKeyframes(data, &script);
  AppendList("errors", data.errors, &script);
  AppendOne("yaw", data.yaw_error, &script);
  AppendList("features", data.features, &script);
  AppendLeader(data.leader, &script);
  AppendOne("degenerate", data.degenerate, &script);
  AppendStages(data.stages, &script);
  AppendGroups(data.groups, &script);
  return script + "};\n";
}

}  // namespace regolith

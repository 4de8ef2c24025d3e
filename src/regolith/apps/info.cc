// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/info.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/io/recording_info.h"

namespace regolith {
namespace {

using Row = std::array<std::string, 8>;

std::string Fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

Row MakeRow(const TopicInfo& topic) {
  std::string remarks;
  for (const std::string& remark : topic.remarks) {
    remarks += (remarks.empty() ? "" : "; ") + remark;
  }
  return {topic.name,
          topic.type,
          std::to_string(topic.messages),
          Fixed(topic.duration, 2),
          Fixed(topic.rate, 2),
          Fixed(topic.largest_gap, 3),
          Concatenate(topic.repeated, " / ", topic.backward),
          remarks};
}

void PrintTable(const std::vector<Row>& rows, std::ostream& out) {
  std::array<size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const Row& row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - row[i].size(), ' ');
      const bool number = i >= 2 && i <= 6;
      line += (i == 0 ? "" : "  ") + (number ? padding + row[i] : row[i] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
}

}  // namespace

int Info(const InfoArguments& arguments, const std::optional<RigCalibration>& rig,
         const RecordingIdentity& identity, std::ostream& out) {
  const RecordingInfo info = InspectRecording(identity);
  out << arguments.recording << ": " << info.format << ", " << Fixed(info.duration, 2) << " s\n\n";
  std::vector<Row> rows = {{"topic", "type", "messages", "seconds", "Hz", "largest gap s",
                            "repeated / backward", "remarks"}};
  for (const TopicInfo& topic : info.topics) rows.push_back(MakeRow(topic));
  PrintTable(rows, out);
  for (const std::string& notice : info.notices) out << "note: " << notice << '\n';
  if (!rig) return 0;
  const std::vector<std::string> problems = CheckRigFits(identity, info, *rig);
  const std::string name = arguments.rig_file.empty() ? "the rig" : arguments.rig_file;
  out << '\n' << name << (problems.empty() ? " fits this recording" : " does not fit:") << '\n';
  for (const std::string& problem : problems) out << "  " << problem << '\n';
  return problems.empty() ? 0 : 2;
}

}  // namespace regolith

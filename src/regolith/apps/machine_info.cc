// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/machine_info.h"

#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "regolith/core/check.h"
#include "regolith/core/version.h"

namespace regolith {
namespace {

/// The rest of the first line of `path` that begins with `key`, without separators and quotes.
std::string Lookup(const std::string& path, const std::string& key) {
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const size_t begin = line.find_first_not_of(" \t:=\"", key.size());
    const size_t end = line.find_last_not_of(" \t\"");
    return begin == std::string::npos ? "" : line.substr(begin, end + 1 - begin);
  }
  return "unknown";
}

std::string Memory() {
  struct sysinfo info {};
  ::sysinfo(&info);
  const double bytes = static_cast<double>(info.totalram) * static_cast<double>(info.mem_unit);
  return Concatenate(static_cast<int>(bytes / 1073741824.0 + 0.5), " GB");
}

std::string System() {
  utsname name{};
  ::uname(&name);
  return Lookup("/etc/os-release", "PRETTY_NAME") + ", Linux " + name.release + ", " + name.machine;
}

std::string Date() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

}  // namespace

std::vector<ReportItem> MachineItems() {
  return {
      {"date", Date()},
      {"machine", Lookup("/proc/cpuinfo", "model name") + ", " +
                      std::to_string(std::thread::hardware_concurrency()) + " cores, " + Memory()},
      {"system", System()},
      {"compiler", Concatenate("GCC-compatible ", __VERSION__)},
      {"regolith", ProgramVersion()}};
}

}  // namespace regolith

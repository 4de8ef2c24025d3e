// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "regolith/core/check.h"
#include "regolith/core/stop.h"

namespace regolith {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kGraceSeconds = 10.0;
constexpr auto kPoll = std::chrono::milliseconds(20);
constexpr const char* kPowerFolder = "/sys/class/powercap";

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::optional<double> ReadNumber(const std::filesystem::path& path) {
  std::ifstream stream(path);
  double value = 0.0;
  return stream >> value ? std::optional<double>(value) : std::nullopt;
}

/// Counters of the processor packages, microjoules; their subdomains are part of them.
std::map<std::string, double> ReadEnergy() {
  std::map<std::string, double> counters;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(kPowerFolder, error)) {
    const std::string name = entry.path().filename();
    const bool is_package = name.rfind("intel-rapl:", 0) == 0 && name.find(':') == name.rfind(':');
    if (!is_package) continue;
    if (const auto value = ReadNumber(entry.path() / "energy_uj")) counters[entry.path()] = *value;
  }
  return counters;
}

std::optional<double> JoulesSince(const std::map<std::string, double>& before) {
  const std::map<std::string, double> after = ReadEnergy();
  if (before.empty() || after.size() != before.size()) return std::nullopt;
  double joules = 0.0;
  for (const auto& [path, start] : before) {
    double difference = after.at(path) - start;
    if (difference < 0.0) {  // the counter has wrapped
      difference += ReadNumber(std::filesystem::path(path) / "max_energy_range_uj").value_or(0.0);
    }
    joules += 1e-6 * difference;
  }
  return joules;
}

/// In the child: never returns.
[[noreturn]] void Execute(const std::vector<char*>& arguments, int log) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing >= 0) ::dup2(nothing, STDIN_FILENO);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

/// Waits for the end of `child`; ends it when its time is over or a stop is requested.
void Await(pid_t child, double timeout, ChildResult* result) {
  const Clock::time_point start = Clock::now();
  std::optional<Clock::time_point> asked;
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, WNOHANG, &usage) == 0) {
    const bool is_late = SecondsSince(start) > timeout;
    if (!asked && (is_late || StopRequested())) {
      result->timed_out = is_late;
      ::kill(child, SIGINT);
      asked = Clock::now();
    } else if (asked && SecondsSince(*asked) > kGraceSeconds) {
      ::kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(kPoll);
  }
  result->wall_seconds = SecondsSince(start);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  result->cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result->exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ChildResult RunChild(const std::vector<std::string>& command, const std::string& log,
                     double timeout) {
  REGOLITH_CHECK(!command.empty() && timeout > 0.0, command.size(), " words, ", timeout, " s");
  ChildResult result;
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0) return result;
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::map<std::string, double> energy = ReadEnergy();
  const pid_t child = ::fork();
  if (child == 0) Execute(arguments, file);
  ::close(file);
  if (child < 0) return result;
  Await(child, timeout, &result);
  result.joules = JoulesSince(energy);
  return result;
}

std::string FailureReason(const ChildResult& result, const std::string& log) {
  if (result.timed_out) {
    return Concatenate("took longer than ", static_cast<int>(result.wall_seconds), " s");
  }
  std::string reason;
  std::string last;
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("error: ", 0) == 0) reason = line.substr(7);
    if (!line.empty()) last = line;
  }
  if (!reason.empty()) return reason;
  if (result.exit_code > 128) {
    return std::string("ended by a signal: ") + ::strsignal(result.exit_code - 128);
  }
  return Concatenate("exit code ", result.exit_code, last.empty() ? "" : ": ", last);
}

std::string ThisProgram() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace regolith

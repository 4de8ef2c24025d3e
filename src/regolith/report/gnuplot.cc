// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"

namespace regolith {
namespace {

void WriteText(const std::string& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw OutputError(path, std::string("cannot be written: ") + std::strerror(errno));
}

/// The script draws everything twice, into the PNG and into the SVG; `replot` would not draw
/// several plots on a page again.
std::string Script(const std::string& name, const std::string& commands, const GnuplotSize& size) {
  const std::string style =
      Concatenate(" size ", size.width, ",", size.height, " font 'sans,14' noenhanced");
  return "# gnuplot " + name + ".gp\ndo for [type in 'png svg'] {\nreset\nif (type eq 'png') {\n" +
         "set terminal pngcairo" + style + "\n} else {\nset terminal svg" + style +
         " background 'white'\n}\nset output '" + name + ".'.type\n" + commands +
         "unset output\n}\n";
}

/// Runs `gnuplot SCRIPT` inside `folder`; its exit status, or 127 where it cannot be started.
int RunGnuplot(const std::string& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot";
  std::string argument = script;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return 127;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return 127;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 127;
}

}  // namespace

std::string QuoteGnuplot(const std::string& text) {
  std::string quoted = "'";
  for (const char character : text) {
    if (character == '\n') continue;
    quoted += character;
    if (character == '\'') quoted += '\'';
  }
  return quoted + "'";
}

bool DrawWithGnuplot(const std::string& folder, const std::string& name, const std::string& data,
                     const std::string& commands, const GnuplotSize& size) {
  const std::string path = folder + "/" + name;
  WriteText(path + ".dat", data);
  WriteText(path + ".gp", Script(name, commands, size));
  const int status = RunGnuplot(folder, name + ".gp");
  if (status == 0) return true;
  LogWarning(path + ".png, .svg: not drawn, " +
             (status == 127 ? std::string("gnuplot is not installed (apt-get install gnuplot-nox)")
                            : Concatenate("gnuplot ended with status ", status)) +
             "; 'gnuplot " + name + ".gp' in that folder draws them");
  return false;
}

}  // namespace regolith

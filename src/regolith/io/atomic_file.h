// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace regolith {

/// The name of an output that is valid but not whole: "dir/map.ply" gives "dir/map.partial.ply".
std::string PartialPath(const std::string& path);

/// A name beside the final one under which an output grows; renamed by Commit(), removed by the
/// destructor otherwise. So nothing under the final name is ever incomplete.
class TemporaryOutput {
 public:
  /// Throws OutputError where the folder of `path` does not exist or is not writable.
  explicit TemporaryOutput(const std::string& path);
  ~TemporaryOutput();
  TemporaryOutput(const TemporaryOutput&) = delete;
  TemporaryOutput& operator=(const TemporaryOutput&) = delete;

  const std::string& path() const { return path_; }
  const std::string& temporary_path() const { return temporary_path_; }

  /// Renames to the final name, or to PartialPath() of it; throws OutputError.
  void Commit(bool partial = false);

 private:
  std::string path_;
  std::string temporary_path_;
  bool committed_ = false;
};

/// A text or binary file that appears under its name only when it is complete. Every failure to
/// write (no space, no permission) throws OutputError with the path.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void Write(std::string_view bytes);
  /// Flushes, closes and renames; nothing can be written after it.
  void Commit(bool partial = false);

 private:
  [[noreturn]] void Fail();

  TemporaryOutput output_;
  std::FILE* file_ = nullptr;
};

/// A whole file at once.
void WriteFile(const std::string& path, std::string_view bytes);

}  // namespace regolith

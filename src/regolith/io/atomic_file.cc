// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {

namespace fs = std::filesystem;

std::string PartialPath(const std::string& path) {
  const fs::path whole(path);
  const std::string name = whole.stem().string() + ".partial" + whole.extension().string();
  return (whole.parent_path() / name).string();
}

TemporaryOutput::TemporaryOutput(const std::string& path)
    : path_(path), temporary_path_(path + ".tmp") {
  std::error_code error;
  if (fs::is_directory(path, error)) throw OutputError(path, "is a folder, not a file");
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::is_directory(folder, error)) {
    throw OutputError(path, "cannot be written: there is no folder " + folder);
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw OutputError(path, "cannot be written: folder " + folder + ": " + std::strerror(errno));
  }
}

TemporaryOutput::~TemporaryOutput() {
  std::error_code error;
  if (!committed_) fs::remove(temporary_path_, error);
}

void TemporaryOutput::Commit(bool partial) {
  REGOLITH_CHECK(!committed_, path_);
  const std::string target = partial ? PartialPath(path_) : path_;
  std::error_code error;
  fs::rename(temporary_path_, target, error);
  if (error) throw OutputError(target, "cannot be written: " + error.message());
  committed_ = true;
}

AtomicFile::AtomicFile(const std::string& path) : output_(path) {
  file_ = std::fopen(output_.temporary_path().c_str(), "wb");
  if (file_ == nullptr) Fail();
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void AtomicFile::Write(std::string_view bytes) {
  REGOLITH_CHECK(file_ != nullptr, output_.path());
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) Fail();
}

void AtomicFile::Commit(bool partial) {
  REGOLITH_CHECK(file_ != nullptr, output_.path());
  std::FILE* const file = file_;
  file_ = nullptr;
  // What the library still holds in its buffer meets a full disk only here.
  if (std::fclose(file) != 0) Fail();
  output_.Commit(partial);
}

void AtomicFile::Fail() {
  throw OutputError(output_.path(), std::string("cannot be written: ") + std::strerror(errno));
}

void WriteFile(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.Write(bytes);
  file.Commit();
}

}  // namespace regolith

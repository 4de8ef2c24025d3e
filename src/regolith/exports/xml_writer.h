// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regolith {

/// A number as the exports write it: the shortest of at most nine digits.
std::string Number(double value);
/// Numbers with a space between them.
std::string Numbers(const std::vector<double>& values);

/// An XML document, element by element, indented.
class XmlWriter {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  /// Without the `<?xml ?>` line where the text is part of another document, at that depth.
  explicit XmlWriter(bool fragment = false, int depth = 0);

  void Open(const std::string& name, const Attributes& attributes = {});
  void Close();
  /// An element with text, or an empty one.
  void Leaf(const std::string& name, std::string_view text, const Attributes& attributes = {});
  void Empty(const std::string& name, const Attributes& attributes = {});
  void Comment(const std::string& text);
  /// Lines that are XML already.
  void Raw(std::string_view lines) { text_ += lines; }

  int depth() const { return first_depth_ + static_cast<int>(open_.size()); }
  /// The document; every element must be closed.
  std::string Text() const;

 private:
  void Start(const std::string& name, const Attributes& attributes);

  std::string text_;
  std::vector<std::string> open_;
  int first_depth_;
};

}  // namespace regolith

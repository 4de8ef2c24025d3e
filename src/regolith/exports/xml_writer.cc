// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/xml_writer.h"

#include <cstdio>

#include "regolith/core/check.h"
#include "regolith/core/escape_markup.h"

namespace regolith {

std::string Number(double value) {
  char text[32];
  // + 0.0 turns the negative zero into zero.
  std::snprintf(text, sizeof(text), "%.9g", value + 0.0);
  return text;
}

std::string Numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + Number(value);
  return text;
}

XmlWriter::XmlWriter(bool fragment, int depth) : first_depth_(depth) {
  if (!fragment) text_ = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
}

void XmlWriter::Start(const std::string& name, const Attributes& attributes) {
  text_ += std::string(2 * static_cast<size_t>(depth()), ' ') + "<" + name;
  for (const auto& [key, value] : attributes)
    text_ += " " + key + "=\"" + EscapeMarkup(value) + "\"";
}

void XmlWriter::Open(const std::string& name, const Attributes& attributes) {
  Start(name, attributes);
  text_ += ">\n";
  open_.push_back(name);
}

void XmlWriter::Close() {
  REGOLITH_CHECK(!open_.empty(), "no element is open");
  const std::string name = open_.back();
  open_.pop_back();
  text_ += std::string(2 * static_cast<size_t>(depth()), ' ') + "</" + name + ">\n";
}

void XmlWriter::Leaf(const std::string& name, std::string_view text, const Attributes& attributes) {
  Start(name, attributes);
  text_ += ">" + EscapeMarkup(text) + "</" + name + ">\n";
}

void XmlWriter::Empty(const std::string& name, const Attributes& attributes) {
  Start(name, attributes);
  text_ += "/>\n";
}

void XmlWriter::Comment(const std::string& text) {
  REGOLITH_CHECK(text.find("--") == std::string::npos, text);
  text_ +=
      std::string(2 * static_cast<size_t>(depth()), ' ') + "<!-- " + EscapeMarkup(text) + " -->\n";
}

std::string XmlWriter::Text() const {
  REGOLITH_CHECK(open_.empty(), open_.back(), " is not closed");
  return text_;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/fields.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "regolith/core/error.h"
#include "regolith/core/join.h"
#include "regolith/sensor/rig_calibration.h"

namespace regolith {

struct YamlDocument::Node {
  YAML::Node yaml;
  std::string name;
  std::vector<std::string> assignments;  ///< of --set, "key.subkey=value"
};

namespace {

bool StartsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// Whether `text` holds `name`, and not as a part of a longer one.
bool Names(const std::string& text, const std::string& name) {
  const auto inside = [&](size_t at) {
    return at < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    if ((at == 0 || !inside(at - 1)) && !inside(at + name.size())) return true;
  }
  return false;
}

/// Whether `assignment` is what `problem` speaks of, found with the value of `key` ("a.b"; empty:
/// of the whole): it gives that value, or one below it whose name is in the problem.
bool Concerns(const std::string& assignment, const std::string& key, const std::string& problem) {
  const std::string assigned = assignment.substr(0, assignment.find('='));
  if (assigned == key || StartsWith(key, assigned + ".")) return true;
  if (!key.empty() && !StartsWith(assigned, key + ".")) return false;
  return Names(problem, assigned.substr(assigned.rfind('.') + 1));
}

YAML::Node Parse(const std::string& text, const std::string& name) {
  try {
    YAML::Node node = YAML::Load(text);
    if (node.IsNull()) return YAML::Node(YAML::NodeType::Map);
    if (!node.IsMap()) throw InputError(name, "expected `key: value` lines (YAML)");
    return node;
  } catch (const YAML::Exception& error) {
    throw InputError(Concatenate(name, ":", error.mark.line + 1), "not valid YAML: " + error.msg);
  }
}

/// The text of a key. YAML has keys of any kind; none but text is ever looked for.
std::string KeyText(const YAML::Node& key, const std::string& name) {
  if (key.IsScalar()) return key.Scalar();
  throw InputError(Concatenate(name, ":", key.Mark().line + 1), "expected text as the key");
}

// Maps are merged key by key; a value keeps the mark of the file it came from.
YAML::Node Merged(const YAML::Node& below, const YAML::Node& above, const std::string& name) {
  if (!below.IsMap() || !above.IsMap()) return above;
  YAML::Node result(YAML::NodeType::Map);
  for (const auto& item : below) {
    const std::string key = KeyText(item.first, name);
    result[key] = above[key].IsDefined() ? Merged(item.second, above[key], name) : item.second;
  }
  for (const auto& item : above) {
    const std::string key = KeyText(item.first, name);
    if (!below[key].IsDefined()) result[key] = item.second;
  }
  return result;
}

size_t EditDistance(const std::string& first, const std::string& second) {
  std::vector<size_t> row(second.size() + 1);
  for (size_t j = 0; j <= second.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= first.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= second.size(); ++j) {
      const size_t substituted = diagonal + (first[i - 1] == second[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[second.size()];
}

std::string Nearest(const std::string& key, const std::set<std::string>& known) {
  std::string best;
  size_t best_distance = std::numeric_limits<size_t>::max();
  for (const std::string& candidate : known) {
    const size_t distance = EditDistance(key, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

// The shortest decimal text that reads back as the same double. YAML 1.1 takes 2e-05 for a word.
std::string NumberText(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  std::string text(buffer, end);
  const size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");
  }
  return text;
}

std::string QuotedText(const std::string& text) {
  YAML::Emitter emitter;
  emitter << text;
  return emitter.c_str();
}

}  // namespace

YamlDocument::YamlDocument(std::unique_ptr<Node> node) : node_(std::move(node)) {}
YamlDocument::YamlDocument(YamlDocument&&) noexcept = default;
YamlDocument& YamlDocument::operator=(YamlDocument&&) noexcept = default;
YamlDocument::~YamlDocument() = default;

YamlDocument YamlDocument::FromFile(const std::string& path) {
  if (std::filesystem::is_directory(path))
    throw InputError(path, "is a folder; expected a YAML file");
  std::ifstream file(path);
  if (!file) throw InputError(path, "cannot be read; expected a YAML file");
  std::ostringstream text;
  text << file.rdbuf();
  return FromText(text.str(), path);
}

YamlDocument YamlDocument::FromText(const std::string& text, const std::string& name) {
  return YamlDocument(std::make_unique<Node>(Node{Parse(text, name), name, {}}));
}

const std::string& YamlDocument::name() const { return node_->name; }

YamlDocument YamlDocument::Empty(const std::string& name) { return FromText("", name); }

void YamlDocument::Overlay(const YamlDocument& other) {
  node_->yaml = Merged(node_->yaml, other.node_->yaml, other.node_->name);
  node_->name = other.node_->name;
}

void YamlDocument::Set(const std::string& assignment) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--set " + assignment, "expected key=value, such as lio.voxel_size=0.5");
  }
  std::string text = assignment.substr(equals + 1);
  std::string key = assignment.substr(0, equals);
  // Built from the inside out: {a: {b: value}}.
  for (size_t dot = key.rfind('.'); dot != std::string::npos; dot = key.rfind('.')) {
    text = Concatenate("{", key.substr(dot + 1), ": ", text, "}");
    key.resize(dot);
  }
  const std::string name = node_->name;
  Overlay(FromText(key + ": " + text, "--set " + assignment));
  node_->name = name;
  node_->assignments.push_back(assignment);
}

std::optional<std::string> YamlDocument::Take(const std::string& key) {
  const YAML::Node value = node_->yaml[key];
  if (!value.IsDefined()) return std::nullopt;
  if (!value.IsScalar()) {
    throw InputError(Concatenate(node_->name, ":", value.Mark().line + 1),
                     key + ": expected one value");
  }
  node_->yaml.remove(key);
  return value.Scalar();
}

struct FieldReader::Implementation {
  YAML::Node node;
  std::string file;
  std::string path;  ///< keys that lead here, each followed by a dot
  std::vector<std::string> assignments;
  std::set<std::string> known;

  YAML::Node Find(const char* key) {
    known.insert(key);
    return static_cast<const YAML::Node&>(node)[key];
  }

  /// The keys that lead here.
  std::string Key() const { return path.substr(0, path.size() - (path.empty() ? 0 : 1)); }

  /// The assignment that `problem`, found with the value of `key`, comes from; "--set " before it.
  std::optional<std::string> Assignment(const std::string& key, const std::string& problem) const {
    // Of two assignments to one key the later holds.
    const auto found = std::find_if(
        assignments.rbegin(), assignments.rend(),
        [&](const std::string& candidate) { return Concerns(candidate, key, problem); });
    if (found == assignments.rend()) return std::nullopt;
    return "--set " + *found;
  }

  std::string FileAndLine(const YAML::Node& at) const {
    const int line = at.IsDefined() ? at.Mark().line + 1 : 0;
    return line > 0 ? Concatenate(file, ":", line) : file;
  }

  [[noreturn]] void FailAt(const YAML::Node& at, const std::string& key,
                           const std::string& problem) const {
    throw InputError(Assignment(path + key, problem).value_or(FileAndLine(at)),
                     path + key + ": " + problem);
  }

  /// What is wrong with the struct of this map may take several values, some of them assigned.
  [[noreturn]] void Refuse(const std::string& problem, const std::string& message) const {
    const auto assignment = Assignment(Key(), problem);
    throw InputError(assignment ? file + " with " + *assignment : FileAndLine(node), message);
  }

  std::unique_ptr<FieldReader> Below(const YAML::Node& found, const std::string& key) const {
    return std::unique_ptr<FieldReader>(new FieldReader(std::unique_ptr<Implementation>(
        new Implementation{found, file, path + key + ".", assignments, {}})));
  }

  template <typename Value>
  void Convert(const char* key, Value& value, const char* expected) {
    const YAML::Node found = Find(key);
    if (!found.IsDefined()) return;
    ConvertNode(found, key, value, expected);
  }

  template <typename Value>
  void ConvertNode(const YAML::Node& found, const std::string& key, Value& value,
                   const char* expected) const {
    const std::string text = found.IsScalar() ? found.Scalar() : "";
    if (!found.IsScalar() || !YAML::convert<Value>::decode(found, value)) {
      FailAt(found, key,
             Concatenate(text.empty() ? "" : "`" + text + "`: ", "expected ", expected));
    }
    if constexpr (std::is_floating_point_v<Value>) {
      if (!std::isfinite(value)) FailAt(found, key, "`" + text + "`: expected a finite number");
    }
  }

  template <typename Value>
  void ConvertList(const char* key, std::vector<Value>& values, const char* expected) {
    const YAML::Node found = Find(key);
    if (!found.IsDefined()) return;
    if (!found.IsSequence())
      FailAt(found, key, Concatenate("expected a list [a, b, …] of ", expected));
    values.clear();
    for (const YAML::Node& item : found) ConvertNode(item, key, values.emplace_back(), expected);
  }
};

FieldReader::FieldReader(const YamlDocument& document)
    : implementation_(new Implementation{
          document.node().yaml, document.node().name, "", document.node().assignments, {}}) {}

FieldReader::FieldReader(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}

FieldReader::~FieldReader() = default;

void FieldReader::operator()(const char* key, double& value) {
  implementation_->Convert(key, value, "a number");
}
void FieldReader::operator()(const char* key, int& value) {
  implementation_->Convert(key, value, "a whole number");
}
void FieldReader::operator()(const char* key, int64_t& value) {
  implementation_->Convert(key, value, "a whole number");
}
void FieldReader::operator()(const char* key, uint64_t& value) {
  implementation_->Convert(key, value, "a whole number, not negative");
}
void FieldReader::operator()(const char* key, bool& value) {
  implementation_->Convert(key, value, "true or false");
}
void FieldReader::operator()(const char* key, std::string& value) {
  implementation_->Convert(key, value, "text");
}
void FieldReader::operator()(const char* key, std::vector<int>& value) {
  implementation_->ConvertList(key, value, "whole numbers");
}
void FieldReader::operator()(const char* key, std::vector<double>& value) {
  implementation_->ConvertList(key, value, "numbers");
}
void FieldReader::operator()(const char* key, std::vector<std::string>& value) {
  implementation_->ConvertList(key, value, "words");
}

void FieldReader::operator()(const char* key, SE3& value) {
  const YAML::Node found = implementation_->Find(key);
  if (!found.IsDefined()) return;
  const char* expected =
      "expected a transform as four rows of four numbers, [[r, r, r, x], …, [0, 0, 0, 1]]";
  if (!found.IsSequence() || found.size() != 4) implementation_->FailAt(found, key, expected);
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    const YAML::Node numbers = found[row];
    if (!numbers.IsSequence() || numbers.size() != 4)
      implementation_->FailAt(numbers, key, expected);
    for (int column = 0; column < 4; ++column) {
      implementation_->ConvertNode(numbers[column], key, matrix(row, column), "a number");
    }
  }
  try {
    value = TransformFromMatrix(matrix);
  } catch (const InputError& error) {
    implementation_->FailAt(found, key, error.what());
  }
}

void FieldReader::Accept(const char* key) { implementation_->known.insert(key); }

bool FieldReader::Has(const char* key) const { return implementation_->Find(key).IsDefined(); }

std::vector<std::string> FieldReader::Keys() const {
  std::vector<std::string> keys;
  for (const auto& item : implementation_->node) {
    keys.push_back(KeyText(item.first, implementation_->file));
  }
  return keys;
}

void FieldReader::Finish() {
  for (const auto& item : implementation_->node) {
    const std::string key = KeyText(item.first, implementation_->file);
    const std::set<std::string>& known = implementation_->known;
    if (known.count(key) != 0) continue;
    implementation_->FailAt(item.first, key,
                            known.empty()
                                ? "unknown key"
                                : Concatenate("unknown key; did you mean `", Nearest(key, known),
                                              "`? Known here: ", Join(known)));
  }
}

void FieldReader::Fail(const char* key, const std::string& problem) const {
  implementation_->FailAt(implementation_->Find(key), key, problem);
}

void FieldReader::Refuse(const CheckError& error) const {
  const std::string key = implementation_->Key();
  implementation_->Refuse(error.expectation(),
                          (key.empty() ? "" : key + ": ") + error.expectation());
}

void FieldReader::Refuse(const InputError& error) const {
  implementation_->Refuse(error.what(), error.what());
}

std::unique_ptr<FieldReader> FieldReader::Child(const char* key) {
  const YAML::Node found = implementation_->Find(key);
  if (!found.IsDefined()) return nullptr;
  if (!found.IsMap()) implementation_->FailAt(found, key, "expected `key: value` lines below it");
  return implementation_->Below(found, key);
}

std::vector<std::unique_ptr<FieldReader>> FieldReader::Children(const char* key) {
  const YAML::Node found = implementation_->Find(key);
  if (!found.IsSequence())
    implementation_->FailAt(found, key, "expected a list of `- key: value` items");
  std::vector<std::unique_ptr<FieldReader>> children;
  for (const YAML::Node& item : found) {
    if (!item.IsMap())
      implementation_->FailAt(item, key, "expected `key: value` lines in each item");
    children.push_back(implementation_->Below(item, key));
  }
  return children;
}

struct FieldWriter::Implementation {
  std::string text;
  int depth = 0;
  bool first_of_item = false;

  void Line(const std::string& line) {
    // The first line of a list item stands behind its dash.
    text += std::string(static_cast<size_t>(2 * depth - (first_of_item ? 2 : 0)), ' ');
    text += (first_of_item ? "- " : "") + line + "\n";
    first_of_item = false;
  }

  template <typename Value, typename ToText>
  std::string List(const std::vector<Value>& values, ToText to_text) {
    std::string list;
    for (const Value& value : values) list += (list.empty() ? "" : ", ") + to_text(value);
    return "[" + list + "]";
  }
};

FieldWriter::FieldWriter() : implementation_(std::make_unique<Implementation>()) {}
FieldWriter::~FieldWriter() = default;

void FieldWriter::operator()(const char* key, double value) {
  implementation_->Line(std::string(key) + ": " + NumberText(value));
}
void FieldWriter::operator()(const char* key, int value) {
  implementation_->Line(std::string(key) + ": " + std::to_string(value));
}
void FieldWriter::operator()(const char* key, int64_t value) {
  implementation_->Line(std::string(key) + ": " + std::to_string(value));
}
void FieldWriter::operator()(const char* key, uint64_t value) {
  implementation_->Line(std::string(key) + ": " + std::to_string(value));
}
void FieldWriter::operator()(const char* key, bool value) {
  implementation_->Line(std::string(key) + ": " + (value ? "true" : "false"));
}
void FieldWriter::operator()(const char* key, std::string& value) {
  implementation_->Line(std::string(key) + ": " + QuotedText(value));
}
void FieldWriter::operator()(const char* key, std::vector<int>& value) {
  implementation_->Line(std::string(key) + ": " + implementation_->List(value, [](int number) {
    return std::to_string(number);
  }));
}
void FieldWriter::operator()(const char* key, std::vector<double>& value) {
  implementation_->Line(std::string(key) + ": " + implementation_->List(value, NumberText));
}
void FieldWriter::operator()(const char* key, std::vector<std::string>& value) {
  implementation_->Line(std::string(key) + ": " + implementation_->List(value, QuotedText));
}

void FieldWriter::operator()(const char* key, SE3& value) {
  const Eigen::Matrix4d matrix = value.Matrix();
  implementation_->Line(std::string(key) + ":");
  for (int row = 0; row < 4; ++row) {
    std::vector<double> numbers(4);
    for (int column = 0; column < 4; ++column)
      numbers[static_cast<size_t>(column)] = matrix(row, column);
    implementation_->Line("  - " + implementation_->List(numbers, NumberText));
  }
}

void FieldWriter::Empty(const char* key, const char* brackets) {
  implementation_->Line(std::string(key) + ": " + brackets);
}
std::string FieldWriter::Quoted(const std::string& name) { return QuotedText(name); }

void FieldWriter::Begin(const char* key) {
  implementation_->Line(std::string(key) + ":");
  ++implementation_->depth;
}
void FieldWriter::BeginItem() {
  ++implementation_->depth;
  implementation_->first_of_item = true;
}
void FieldWriter::End() { --implementation_->depth; }
void FieldWriter::BeginList(const char* key) {
  implementation_->Line(std::string(key) + ":");
  ++implementation_->depth;
}
void FieldWriter::EndList() { --implementation_->depth; }

std::string FieldWriter::Text() const { return implementation_->text; }

}  // namespace regolith

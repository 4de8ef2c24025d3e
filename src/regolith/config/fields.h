// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// How options meet YAML. Each options struct is described once, by a function template
///
///   template <typename Archive>
///   void Fields(Archive& archive, XOptions& options) {
///     archive("voxel_size", options.voxel_size);   // a value
///     archive("map", options.map);                 // a struct with Fields of its own
///   }
///
/// in the .cc that loads it. FieldReader fills the struct from a file, keeps defaults where a key
/// is absent and refuses keys that nobody asked for; FieldWriter writes the same keys back.

/// A YAML document with its file's name, and the changes made by --set.
class YamlDocument {
 public:
  static YamlDocument FromFile(const std::string& path);
  static YamlDocument FromText(const std::string& text, const std::string& name);
  static YamlDocument Empty(const std::string& name);

  YamlDocument(YamlDocument&&) noexcept;
  YamlDocument& operator=(YamlDocument&&) noexcept;
  ~YamlDocument();

  /// Lays another document over this one: its maps are merged, everything else replaces.
  void Overlay(const YamlDocument& other);
  /// One `key.subkey=value` of the command line.
  void Set(const std::string& assignment);
  /// Removes a top-level key and gives its text; nothing where it is absent.
  std::optional<std::string> Take(const std::string& key);

  /// The file's name, for messages.
  const std::string& name() const;

  struct Node;
  const Node& node() const { return *node_; }

 private:
  explicit YamlDocument(std::unique_ptr<Node> node);
  std::unique_ptr<Node> node_;
};

/// Whether a struct of options can tell by itself that it makes no sense.
template <typename Struct, typename = void>
inline constexpr bool kHasCheck = false;
template <typename Struct>
inline constexpr bool kHasCheck<Struct, std::void_t<decltype(std::declval<Struct>().Check())>> =
    true;

/// Fills structs from one map of a document. Errors are InputError "FILE:LINE: key: problem", or
/// "--set ASSIGNMENT: key: problem" where that is what is wrong, or both, where a struct's Check
/// refuses what file and assignment make together.
class FieldReader {
 public:
  explicit FieldReader(const YamlDocument& document);
  ~FieldReader();
  FieldReader(const FieldReader&) = delete;
  FieldReader& operator=(const FieldReader&) = delete;

  static constexpr bool kReading = true;

  void operator()(const char* key, double& value);
  void operator()(const char* key, int& value);
  void operator()(const char* key, int64_t& value);
  void operator()(const char* key, uint64_t& value);
  void operator()(const char* key, bool& value);
  void operator()(const char* key, std::string& value);
  void operator()(const char* key, std::vector<int>& value);
  void operator()(const char* key, std::vector<double>& value);
  void operator()(const char* key, std::vector<std::string>& value);
  /// A rigid motion as four rows of four numbers.
  void operator()(const char* key, SE3& value);

  template <int kSize>
  void operator()(const char* key, Eigen::Matrix<double, kSize, 1>& value) {
    std::vector<double> values(value.data(), value.data() + kSize);
    (*this)(key, values);
    if (static_cast<int>(values.size()) != kSize) {
      Fail(key, Concatenate("has ", values.size(), " numbers; expected ", kSize));
    }
    for (int i = 0; i < kSize; ++i) value[i] = values[static_cast<size_t>(i)];
  }

  template <typename Struct, typename = std::enable_if_t<std::is_class_v<Struct>>>
  void operator()(const char* key, Struct& value) {
    if (const auto child = Child(key)) {
      Fields(*child, value);
      child->Finish();
      if constexpr (kHasCheck<Struct>) child->Check(value);
    }
  }

  /// Present in the struct where the key is present in the file.
  template <typename Struct>
  void operator()(const char* key, std::optional<Struct>& value) {
    if (!Has(key)) return;
    if (!value) value.emplace();
    (*this)(key, *value);
  }

  template <typename Struct>
  void operator()(const char* key, std::vector<Struct>& value) {
    if (!Has(key)) return;
    value.clear();
    for (const auto& child : Children(key)) {
      Fields(*child, value.emplace_back());
      child->Finish();
      if constexpr (kHasCheck<Struct>) child->Check(value.back());
    }
  }

  template <typename Struct>
  void operator()(const char* key, std::map<std::string, Struct>& value) {
    const auto child = Child(key);
    if (!child) return;
    for (const std::string& name : child->Keys()) (*child)(name.c_str(), value[name]);
    child->Finish();
  }

  /// Takes a key whatever stands below it, for what informs people alone.
  void Accept(const char* key);
  bool Has(const char* key) const;
  std::vector<std::string> Keys() const;
  /// Throws InputError at the first key that was never asked for, with the nearest one that was.
  void Finish();
  /// Runs the Check() of the struct that was read from this map. What it refuses is an InputError.
  template <typename Struct>
  void Check(const Struct& options) const {
    try {
      options.Check();
    } catch (const CheckError& error) {
      Refuse(error);
    } catch (const InputError& error) {
      Refuse(error);
    }
  }
  /// Throws InputError at the line of `key`, or of the file where the key is absent.
  [[noreturn]] void Fail(const char* key, const std::string& problem) const;

 private:
  struct Implementation;
  explicit FieldReader(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<FieldReader> Child(const char* key);
  std::vector<std::unique_ptr<FieldReader>> Children(const char* key);
  [[noreturn]] void Refuse(const CheckError& error) const;
  [[noreturn]] void Refuse(const InputError& error) const;  // which names its key

  std::unique_ptr<Implementation> implementation_;
};

/// Writes structs as YAML text, keys in the order of their Fields.
class FieldWriter {
 public:
  FieldWriter();
  ~FieldWriter();
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  static constexpr bool kReading = false;

  void operator()(const char* key, double value);
  void operator()(const char* key, int value);
  void operator()(const char* key, int64_t value);
  void operator()(const char* key, uint64_t value);
  void operator()(const char* key, bool value);
  void operator()(const char* key, std::string& value);
  void operator()(const char* key, std::vector<int>& value);
  void operator()(const char* key, std::vector<double>& value);
  void operator()(const char* key, std::vector<std::string>& value);
  void operator()(const char* key, SE3& value);

  template <int kSize>
  void operator()(const char* key, Eigen::Matrix<double, kSize, 1>& value) {
    std::vector<double> values(value.data(), value.data() + kSize);
    (*this)(key, values);
  }

  template <typename Struct, typename = std::enable_if_t<std::is_class_v<Struct>>>
  void operator()(const char* key, Struct& value) {
    Begin(key);
    Fields(*this, value);
    End();
  }

  template <typename Struct>
  void operator()(const char* key, std::optional<Struct>& value) {
    if (value) (*this)(key, *value);
  }

  template <typename Struct>
  void operator()(const char* key, std::vector<Struct>& value) {
    if (value.empty()) return Empty(key, "[]");
    BeginList(key);
    for (Struct& item : value) {
      BeginItem();
      Fields(*this, item);
      End();
    }
    EndList();
  }

  template <typename Struct>
  void operator()(const char* key, std::map<std::string, Struct>& value) {
    if (value.empty()) return Empty(key, "{}");
    Begin(key);
    for (auto& [name, item] : value) (*this)(Quoted(name).c_str(), item);
    End();
  }

  /// The document so far.
  std::string Text() const;

 private:
  /// A map or list without items: nothing behind the key would read back as null.
  void Empty(const char* key, const char* brackets);
  /// A name from outside, quoted where YAML would take it for something else.
  static std::string Quoted(const std::string& name);
  void Begin(const char* key);
  void BeginItem();
  void End();
  void BeginList(const char* key);
  void EndList();

  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace regolith

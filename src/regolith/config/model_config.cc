// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/model_config.h"

#include <filesystem>
#include <initializer_list>

#include "regolith/config/fields.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;

constexpr int kAnySize = -1;
constexpr int kDetectorChannels = 65;  // 8 × 8 pixels and "none"
constexpr int kMaxDimension = 4096;
constexpr size_t kSha256Digits = 64;

struct Outputs {
  TensorDescription logits;
  TensorDescription descriptors;
};

struct Normalisation {
  double mean = 0.0;
  double scale = 1.0;
  bool per_image = false;
};

/// Nothing in a manifest has a default: it says what a file is.
void Require(const FieldReader& reader, std::initializer_list<const char*> keys) {
  for (const char* const key : keys) {
    if (!reader.Has(key)) reader.Fail(key, "is missing");
  }
}

std::string ShapeText(const std::vector<int>& shape) {
  std::string text;
  for (const int size : shape) text += (text.empty() ? "" : ", ") + std::to_string(size);
  return "[" + text + "]";
}

/// [1, channels, any, any]; `channels` 0: any number that a descriptor may have.
void CheckShape(const std::string& path, const std::string& key, const std::vector<int>& shape,
                int channels) {
  const bool good =
      shape.size() == 4 && shape[0] == 1 &&
      (channels > 0 ? shape[1] == channels : shape[1] >= 1 && shape[1] <= kMaxDimension) &&
      shape[2] == kAnySize && shape[3] == kAnySize;
  if (good) return;
  const std::string expected = channels > 0 ? std::to_string(channels) : "DIMENSION";
  throw InputError(path, key + ".shape: is " + ShapeText(shape) + "; expected [1, " + expected +
                             ", -1, -1], where -1 is any size");
}

}  // namespace

// Read alone, so no templates: nothing writes manifests but the exporter.

static void Fields(FieldReader& reader, TensorDescription& tensor) {
  Require(reader, {"name", "shape"});
  reader("name", tensor.name);
  reader("shape", tensor.shape);
}

static void Fields(FieldReader& reader, Outputs& outputs) {
  Require(reader, {"logits", "descriptors"});
  reader("logits", outputs.logits);
  reader("descriptors", outputs.descriptors);
}

static void Fields(FieldReader& reader, Normalisation& normalisation) {
  Require(reader, {"mean", "scale", "per_image"});
  reader("mean", normalisation.mean);
  reader("scale", normalisation.scale);
  reader("per_image", normalisation.per_image);
  if (!(normalisation.scale > 0.0)) reader.Fail("scale", "expected a number above 0");
}

static void Fields(FieldReader& reader, ModelParity& parity) {
  Require(reader, {"input", "logits", "descriptors"});
  reader("input", parity.input);
  reader("logits", parity.logits);
  reader("descriptors", parity.descriptors);
}

static ModelManifest ReadManifest(FieldReader& reader) {
  ModelManifest manifest;
  Outputs outputs;
  Normalisation normalisation;
  Require(reader, {"name", "file", "sha256", "input", "outputs", "normalisation"});
  reader("name", manifest.name);
  reader("file", manifest.path);
  reader("sha256", manifest.sha256);
  reader("input", manifest.input);
  reader("outputs", outputs);
  reader("normalisation", normalisation);
  reader("parity", manifest.parity);
  for (const char* const key : {"training", "licence", "description"}) reader.Accept(key);
  reader.Finish();
  const bool hexadecimal =
      manifest.sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (manifest.sha256.size() != kSha256Digits || !hexadecimal) {
    reader.Fail("sha256", "expected 64 digits 0-9 and a-f, as sha256sum prints");
  }
  manifest.logits = outputs.logits;
  manifest.descriptors = outputs.descriptors;
  manifest.mean = normalisation.mean;
  manifest.scale = normalisation.scale;
  manifest.per_image = normalisation.per_image;
  return manifest;
}

ModelManifest LoadModelManifest(const std::string& yaml_path) {
  const YamlDocument document = YamlDocument::FromFile(yaml_path);
  FieldReader reader(document);
  ModelManifest manifest = ReadManifest(reader);
  CheckShape(yaml_path, "input", manifest.input.shape, 1);
  CheckShape(yaml_path, "outputs.logits", manifest.logits.shape, kDetectorChannels);
  CheckShape(yaml_path, "outputs.descriptors", manifest.descriptors.shape, 0);
  const fs::path folder = fs::path(yaml_path).parent_path();
  manifest.path = folder / manifest.path;
  for (std::string* path :
       {&manifest.parity.input, &manifest.parity.logits, &manifest.parity.descriptors}) {
    if (!path->empty()) *path = folder / *path;
  }
  std::error_code error;
  if (!fs::is_regular_file(manifest.path, error)) {
    reader.Fail("file", "there is no file " + manifest.path);
  }
  return manifest;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/feature_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <list>
#include <openvino/openvino.hpp>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/sha256.h"
#include "regolith/features/contrast.h"

namespace regolith {
namespace {

constexpr int kCell = 8;
// Networks compiled for other image sizes that are kept: a stereo pair or a matched pair may
// differ.
constexpr size_t kKeptSizes = 2;

std::string ReadBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, "the network cannot be read; is the file there?");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string ShapeText(const std::vector<int>& shape) {
  std::string text;
  for (const int size : shape) text += (text.empty() ? "" : " × ") + std::to_string(size);
  return text;
}

std::vector<int> ShapeOf(const ov::PartialShape& shape) {
  std::vector<int> sizes;
  if (shape.rank().is_dynamic()) return sizes;
  for (const ov::Dimension& size : shape) {
    sizes.push_back(size.is_static() ? static_cast<int>(size.get_length()) : -1);
  }
  return sizes;
}

void CheckTensor(const std::string& path, const std::string& kind,
                 const TensorDescription& expected,
                 const std::vector<ov::Output<ov::Node>>& found) {
  for (const auto& tensor : found) {
    const auto& names = tensor.get_names();
    if (names.find(expected.name) == names.end()) continue;
    const std::vector<int> shape = ShapeOf(tensor.get_partial_shape());
    bool fits = shape.size() == expected.shape.size();
    for (size_t i = 0; fits && i < shape.size(); ++i) {
      fits = shape[i] == expected.shape[i] || shape[i] == -1 || expected.shape[i] == -1;
    }
    if (fits && tensor.get_element_type() == ov::element::f32) return;
    throw InputError(path, kind + " " + expected.name + " is " + ShapeText(shape) + " of " +
                               tensor.get_element_type().get_type_name() + "; expected " +
                               ShapeText(expected.shape) + " of f32, as the manifest says");
  }
  throw InputError(path, "has no " + kind + " named " + expected.name +
                             ", which the manifest names; was it exported by regolith_train?");
}

std::shared_ptr<ov::Model> ReadModel(ov::Core& core, const ModelManifest& manifest) {
  const std::string bytes = ReadBytes(manifest.path);
  const std::string sha256 =
      Sha256Hex({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  if (sha256 != manifest.sha256) {
    throw InputError(manifest.path, "is not the network that its manifest describes: sha256 " +
                                        sha256 + ", expected " + manifest.sha256);
  }
  std::shared_ptr<ov::Model> model;
  try {
    model = core.read_model(bytes, ov::Tensor());
  } catch (const ov::Exception&) {
    throw InputError(manifest.path, "is no ONNX network that OpenVINO reads");
  }
  CheckTensor(manifest.path, "input", manifest.input, model->inputs());
  CheckTensor(manifest.path, "output", manifest.logits, model->outputs());
  CheckTensor(manifest.path, "output", manifest.descriptors, model->outputs());
  return model;
}

/// Both outputs with the channels of a cell next to each other: that is how they are read.
std::shared_ptr<ov::Model> WithChannelsLast(const std::shared_ptr<ov::Model>& model,
                                            const ModelManifest& manifest) {
  ov::preprocess::PrePostProcessor steps(model);
  for (const std::string& name : {manifest.logits.name, manifest.descriptors.name}) {
    steps.output(name).model().set_layout("NCHW");
    steps.output(name).tensor().set_layout("NHWC");
  }
  return steps.build();
}

/// Values of the grey levels in terms of the mean and deviation that they have over the image.
void NormaliseByImage(const Image& image, std::array<double, 256>* values) {
  constexpr double kFloor = 0.02;  // deviation, so that noise of flat images stays small
  std::array<int64_t, 256> counts{};
  for (const uint8_t grey : image.data) ++counts[grey];
  double sum = 0.0;
  double squares = 0.0;
  for (size_t grey = 0; grey < counts.size(); ++grey) {
    const auto count = static_cast<double>(counts[grey]);
    sum += count * (*values)[grey];
    squares += count * (*values)[grey] * (*values)[grey];
  }
  const auto size = static_cast<double>(image.data.size());
  const double mean = sum / size;
  const double variance = std::max(0.0, squares / size - mean * mean);
  for (double& value : *values) value = (value - mean) / std::sqrt(variance + kFloor * kFloor);
}

bool HasBf16(ov::Core& core) {
  const auto capabilities = core.get_property("CPU", ov::device::capabilities);
  return std::find(capabilities.begin(), capabilities.end(), "BF16") != capabilities.end();
}

}  // namespace

class FeatureNetwork::Implementation {
 public:
  Implementation(const ModelManifest& manifest, const NetworkOptions& options)
      : manifest_(manifest), options_(options) {
    options.Check();
    precision_ = options.precision;
    if (precision_ == "auto") precision_ = HasBf16(core_) ? "bf16" : "f32";
    if (precision_ == "bf16" && !HasBf16(core_)) {
      throw InputError("features.precision",
                       "bf16, which this processor does not have; use auto or f32");
    }
    model_ = WithChannelsLast(ReadModel(core_, manifest), manifest);
  }

  NetworkOutput Run(const Image& image) {
    REGOLITH_CHECK(image.width > 0 && image.height > 0, "width=", image.width,
                   " height=", image.height);
    Compiled& compiled = ForSize((image.width + kCell - 1) / kCell * kCell,
                                 (image.height + kCell - 1) / kCell * kCell);
    Fill(image, compiled);
    compiled.request.infer();
    NetworkOutput output;
    output.rows = compiled.height / kCell;
    output.columns = compiled.width / kCell;
    output.logits = compiled.logits.data<const float>();
    output.descriptors = compiled.descriptors.data<const float>();
    output.dimension = static_cast<int>(compiled.descriptors.get_shape().back());
    return output;
  }

  const std::string& precision() const { return precision_; }

 private:
  struct Compiled {
    int width = 0;
    int height = 0;
    ov::InferRequest request;
    ov::Tensor input;
    ov::Tensor logits;
    ov::Tensor descriptors;
  };

  Compiled& ForSize(int width, int height) {
    for (auto entry = compiled_.begin(); entry != compiled_.end(); ++entry) {
      if (entry->width != width || entry->height != height) continue;
      compiled_.splice(compiled_.begin(), compiled_, entry);
      return compiled_.front();
    }
    if (compiled_.size() == kKeptSizes) compiled_.pop_back();
    compiled_.push_front(Compile(width, height));
    return compiled_.front();
  }

  Compiled Compile(int width, int height) {
    const std::shared_ptr<ov::Model> sized = model_->clone();
    sized->reshape({{manifest_.input.name, ov::PartialShape{1, 1, height, width}}});
    ov::AnyMap properties = {
        ov::inference_num_threads(options_.threads), ov::num_streams(1),
        // A second thread that is woken beside the first stays on its core for longer than an
        // inference lasts; one thread alone is left to the scheduler, so that processes side by
        // side do not meet.
        ov::hint::enable_cpu_pinning(options_.threads > 1),
        ov::hint::inference_precision(precision_ == "bf16" ? ov::element::bf16 : ov::element::f32)};
    if (!options_.cache.empty()) properties.insert(ov::cache_dir(options_.cache));
    Compiled compiled;
    compiled.width = width;
    compiled.height = height;
    compiled.request = core_.compile_model(sized, "CPU", properties).create_infer_request();
    compiled.input = compiled.request.get_tensor(manifest_.input.name);
    compiled.logits = compiled.request.get_tensor(manifest_.logits.name);
    compiled.descriptors = compiled.request.get_tensor(manifest_.descriptors.name);
    return compiled;
  }

  /// The image as the network takes it, its last row and column repeated where it is padded.
  void Fill(const Image& image, Compiled& compiled) const {
    const std::array<float, 256> values = InputValues(image);
    float* target = compiled.input.data<float>();
    const auto width = static_cast<size_t>(compiled.width);
    for (int row = 0; row < compiled.height; ++row, target += width) {
      const int source_row = std::min(row, image.height - 1);
      const uint8_t* source =
          image.data.data() + static_cast<size_t>(source_row) * static_cast<size_t>(image.width);
      for (int column = 0; column < image.width; ++column) target[column] = values[source[column]];
      std::fill(target + image.width, target + width, target[image.width - 1]);
    }
  }

  /// What each grey level becomes: contrast first, then the network's own normalisation.
  std::array<float, 256> InputValues(const Image& image) const {
    const ContrastStretch stretch =
        options_.normalise_contrast ? StretchFor(image) : ContrastStretch();
    std::array<double, 256> values{};
    for (size_t grey = 0; grey < values.size(); ++grey) {
      values[grey] = stretch.Apply(static_cast<double>(grey) / 255.0);
    }
    if (manifest_.per_image) NormaliseByImage(image, &values);
    std::array<float, 256> inputs{};
    for (size_t grey = 0; grey < values.size(); ++grey) {
      inputs[grey] = static_cast<float>((values[grey] - manifest_.mean) / manifest_.scale);
    }
    return inputs;
  }

  ModelManifest manifest_;
  NetworkOptions options_;
  ov::Core core_;
  std::shared_ptr<ov::Model> model_;
  std::string precision_;
  std::list<Compiled> compiled_;  // the size used last comes first
};

FeatureNetwork::FeatureNetwork(const ModelManifest& manifest, const NetworkOptions& options)
    : implementation_(std::make_unique<Implementation>(manifest, options)) {}

FeatureNetwork::~FeatureNetwork() = default;

NetworkOutput FeatureNetwork::Run(const Image& image) { return implementation_->Run(image); }

const std::string& FeatureNetwork::precision() const { return implementation_->precision(); }

}  // namespace regolith

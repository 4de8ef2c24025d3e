// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/model_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "regolith/core/error.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kManifest = R"(name: tiny
file: tiny.onnx
sha256: e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855
input: {name: image, shape: [1, 1, -1, -1]}
outputs:
  logits: {name: logits, shape: [1, 65, -1, -1]}
  descriptors: {name: descriptors, shape: [1, 128, -1, -1]}
normalisation: {mean: 0.5, scale: 0.25, per_image: true}
parity: {input: parity/in.npy, logits: parity/logits.npy, descriptors: parity/descriptors.npy}
training:
  command: python -m regolith_train train --steps 100
  data: [{name: pairs, licence: BSD-3-Clause}]
  steps: 100
)";

class ModelConfigTest : public testing::Test {
 protected:
  ModelConfigTest() {
    std::string name = (fs::temp_directory_path() / "regolith_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(folder_ / "tiny.onnx") << "a network";
  }
  ~ModelConfigTest() override { fs::remove_all(folder_); }

  std::string Write(const std::string& text) const {
    std::ofstream(folder_ / "tiny.yaml") << text;
    return folder_ / "tiny.yaml";
  }

  /// The error for the manifest with one of its parts replaced.
  std::string ErrorWith(const std::string& part, const std::string& replacement) const {
    std::string text = kManifest;
    text.replace(text.find(part), part.size(), replacement);
    try {
      LoadModelManifest(Write(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(ModelConfigTest, ReadsAManifest) {
  const ModelManifest manifest = LoadModelManifest(Write(kManifest));
  EXPECT_EQ(manifest.name, "tiny");
  EXPECT_EQ(manifest.path, folder_ / "tiny.onnx");
  EXPECT_EQ(manifest.sha256.substr(0, 8), "e3b0c442");
  EXPECT_EQ(manifest.input.name, "image");
  EXPECT_THAT(manifest.input.shape, testing::ElementsAre(1, 1, -1, -1));
  EXPECT_THAT(manifest.logits.shape, testing::ElementsAre(1, 65, -1, -1));
  EXPECT_EQ(manifest.descriptors.shape[1], 128);
  EXPECT_EQ(manifest.mean, 0.5);
  EXPECT_EQ(manifest.scale, 0.25);
  EXPECT_TRUE(manifest.per_image);
  EXPECT_EQ(manifest.parity.logits, folder_ / "parity/logits.npy");
}

TEST_F(ModelConfigTest, TheNameOfTheFileAloneIsAPathHere) {
  Write(kManifest);
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_EQ(LoadModelManifest("tiny.yaml").path, "tiny.onnx");
  fs::current_path(before);
}

TEST_F(ModelConfigTest, SaysWhatIsMissing) {
  EXPECT_THROW(LoadModelManifest(folder_ / "absent.yaml"), InputError);
  EXPECT_THAT(ErrorWith("file: tiny.onnx\n", ""),
              AllOf(HasSubstr("tiny.yaml"), HasSubstr("file: is missing")));
  EXPECT_THAT(ErrorWith("logits: {name: logits, shape", "logits: {shape"),
              HasSubstr("outputs.logits.name: is missing"));
  EXPECT_THAT(ErrorWith("mean: 0.5, ", ""), HasSubstr("normalisation.mean: is missing"));
  EXPECT_THAT(ErrorWith("file: tiny.onnx", "file: other.onnx"),
              AllOf(HasSubstr("tiny.yaml:2"), HasSubstr("other.onnx")));
}

TEST_F(ModelConfigTest, RefusesWrongShapes) {
  EXPECT_THAT(ErrorWith("[1, 1, -1, -1]", "[1, 3, -1, -1]"),
              AllOf(HasSubstr("input.shape"), HasSubstr("[1, 3, -1, -1]"),
                    HasSubstr("expected [1, 1, -1, -1]")));
  EXPECT_THAT(ErrorWith("[1, 1, -1, -1]", "[1, 1, 480, 640]"), HasSubstr("input.shape"));
  EXPECT_THAT(ErrorWith("[1, 65, -1, -1]", "[1, 64, -1, -1]"), HasSubstr("expected [1, 65"));
  EXPECT_THAT(ErrorWith("[1, 128, -1, -1]", "[1, -1, -1, -1]"), HasSubstr("outputs.descriptors"));
  EXPECT_THAT(ErrorWith("[1, 128, -1, -1]", "[1, 128]"), HasSubstr("outputs.descriptors"));
  EXPECT_THAT(ErrorWith("[1, 128, -1, -1]", "[1, wide, -1, -1]"), HasSubstr("whole number"));
}

TEST_F(ModelConfigTest, RefusesUnknownKeysAndImpossibleValues) {
  EXPECT_THAT(ErrorWith("name: tiny", "nmae: tiny"), HasSubstr("name"));
  EXPECT_THAT(ErrorWith("training:", "trainig:"), HasSubstr("did you mean `training`"));
  EXPECT_THAT(ErrorWith("e3b0", "E3B0"), AllOf(HasSubstr("tiny.yaml:3"), HasSubstr("sha256")));
  EXPECT_THAT(ErrorWith("e3b0", ""), HasSubstr("64 digits"));
  EXPECT_THAT(ErrorWith("scale: 0.25", "scale: 0"), HasSubstr("normalisation.scale"));
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"

namespace regolith {

// As a .cc of options would have them.
struct WheelOptions {
  double radius = 0.2;
  std::string name = "left";

  void Check() const {
    REGOLITH_CHECK(radius > 0.0, "radius=", radius);
    if (name == "fifth") throw InputError("wheel.name", "a rover has four");
  }
};

struct RoverOptions {
  int wheels = 4;
  bool powered = true;
  double speed = 0.5;
  Eigen::Vector3d offset{1.0, 2.0, 3.0};
  SE3 T_imu_base;
  WheelOptions wheel;
  std::optional<WheelOptions> spare;
  std::vector<WheelOptions> list;
  std::map<std::string, WheelOptions> named;

  void Check() const { REGOLITH_CHECK(speed <= 1.0, "speed=", speed); }
};

template <typename Archive>
void Fields(Archive& archive, WheelOptions& options) {
  archive("radius", options.radius);
  archive("name", options.name);
}

template <typename Archive>
void Fields(Archive& archive, RoverOptions& options) {
  archive("wheels", options.wheels);
  archive("powered", options.powered);
  archive("speed", options.speed);
  archive("offset", options.offset);
  archive("T_imu_base", options.T_imu_base);
  archive("wheel", options.wheel);
  archive("spare", options.spare);
  archive("list", options.list);
  archive("named", options.named);
}

namespace {

using testing::AllOf;
using testing::HasSubstr;

RoverOptions Read(const YamlDocument& document) {
  RoverOptions options;
  FieldReader reader(document);
  Fields(reader, options);
  reader.Finish();
  reader.Check(options);
  return options;
}

std::string ErrorOf(const std::string& text, const std::vector<std::string>& assignments = {}) {
  try {
    YamlDocument document = YamlDocument::FromText(text, "rover.yaml");
    for (const std::string& assignment : assignments) document.Set(assignment);
    Read(document);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Fields, KeepsDefaultsWhereKeysAreAbsent) {
  const RoverOptions options = Read(YamlDocument::FromText("speed: 0.7\n", "rover.yaml"));
  EXPECT_EQ(options.speed, 0.7);
  EXPECT_EQ(options.wheels, 4);
  EXPECT_FALSE(options.spare.has_value());
}

TEST(Fields, WrittenTextReadsBackAsTheSame) {
  RoverOptions options;
  options.speed = 0.1 + 0.2;
  options.powered = false;
  options.T_imu_base = {ExpSo3({0.1, 0.2, 0.3}), {4.0, 5.0, 6.0}};
  options.wheel.name = "yes: no #";
  options.spare = WheelOptions{0.3, "spare"};
  options.list = {{0.1, "a"}, {0.2, "b"}};
  options.named["rear"] = {0.4, "rear"};
  FieldWriter writer;
  Fields(writer, options);
  const RoverOptions copy = Read(YamlDocument::FromText(writer.Text(), "rover.yaml"));
  EXPECT_EQ(copy.speed, options.speed);
  EXPECT_FALSE(copy.powered);
  EXPECT_LT((copy.T_imu_base.Matrix() - options.T_imu_base.Matrix()).norm(), 1e-15);
  EXPECT_EQ(copy.wheel.name, options.wheel.name);
  EXPECT_EQ(copy.spare->radius, 0.3);
  ASSERT_EQ(copy.list.size(), 2U);
  EXPECT_EQ(copy.list[1].name, "b");
  EXPECT_EQ(copy.named.at("rear").radius, 0.4);
}

TEST(Fields, EmptyListsAndNamesThatNeedQuotesReadBack) {
  RoverOptions options;
  FieldWriter empty;
  Fields(empty, options);
  EXPECT_TRUE(Read(YamlDocument::FromText(empty.Text(), "rover.yaml")).named.empty());
  options.named["front: [left]"] = {0.4, "front"};
  FieldWriter writer;
  Fields(writer, options);
  const RoverOptions copy = Read(YamlDocument::FromText(writer.Text(), "rover.yaml"));
  EXPECT_EQ(copy.named.at("front: [left]").radius, 0.4);
}

TEST(Fields, UnknownKeysAreRefusedWithFileLineAndTheNearestKey) {
  EXPECT_THAT(ErrorOf("speed: 0.5\nwheel:\n  radios: 0.2\n"),
              AllOf(HasSubstr("rover.yaml:3"), HasSubstr("wheel.radios"), HasSubstr("`radius`")));
}

TEST(Fields, ValuesOfAnotherTypeAreRefused) {
  EXPECT_THAT(ErrorOf("speed: fast\n"), AllOf(HasSubstr("rover.yaml:1"), HasSubstr("a number")));
  EXPECT_THAT(ErrorOf("wheels: 4.5\n"), HasSubstr("a whole number"));
  EXPECT_THAT(ErrorOf("speed: .nan\n"), HasSubstr("finite"));
  EXPECT_THAT(ErrorOf("offset: [1, 2]\n"), HasSubstr("expected 3"));
  EXPECT_THAT(ErrorOf("wheel: 7\n"), HasSubstr("wheel"));
  EXPECT_THAT(ErrorOf("list: 7\n"), HasSubstr("list"));
  EXPECT_THAT(ErrorOf("- 7\n"), HasSubstr("key: value"));
  EXPECT_THAT(ErrorOf("a: [\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(ErrorOf("speed: 1\n[a, b]: 7\n"),
              AllOf(HasSubstr(":2"), HasSubstr("text as the key")));
  EXPECT_THAT(ErrorOf("named: {~: {radius: 1}}\n"), HasSubstr("text as the key"));
}

TEST(Fields, ReflectedRotationsAreRefused) {
  EXPECT_THAT(
      ErrorOf(
          "T_imu_base:\n  - [1, 0, 0, 0]\n  - [0, -1, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n"),
      AllOf(HasSubstr("T_imu_base"), HasSubstr("reflected")));
}

TEST(Fields, WhatAStructRefusesIsSaidOfItsKey) {
  EXPECT_EQ(ErrorOf("speed: 1\nwheel:\n  radius: -1\n"),
            "rover.yaml:3: wheel: expected radius > 0.0: radius=-1");
  EXPECT_EQ(ErrorOf("list:\n  - radius: -1\n"),
            "rover.yaml:2: list: expected radius > 0.0: radius=-1");
  EXPECT_EQ(ErrorOf("named: {rear: {radius: -1}}\n"),
            "rover.yaml:1: named.rear: expected radius > 0.0: radius=-1");
  EXPECT_EQ(ErrorOf("wheel: {name: fifth}\n"), "rover.yaml:1: wheel.name: a rover has four");
  EXPECT_EQ(ErrorOf("speed: 2\n"), "rover.yaml:1: expected speed <= 1.0: speed=2");
}

TEST(Fields, WhatAnAssignmentDoesWrongIsSaidOfIt) {
  const std::string file = "speed: 1\nwheel: {name: right}\n";
  EXPECT_EQ(ErrorOf(file, {"speed=1", "wheel.radius=-1"}),
            "rover.yaml with --set wheel.radius=-1: wheel: expected radius > 0.0: radius=-1");
  EXPECT_EQ(ErrorOf(file, {"speed=2"}),
            "rover.yaml with --set speed=2: expected speed <= 1.0: speed=2");
  EXPECT_EQ(ErrorOf(file, {"wheel.name=fifth"}),
            "rover.yaml with --set wheel.name=fifth: wheel.name: a rover has four");
  EXPECT_EQ(ErrorOf(file, {"speed=fast"}), "--set speed=fast: speed: `fast`: expected a number");
  EXPECT_THAT(ErrorOf(file, {"wheel={radios: 1}"}),
              AllOf(HasSubstr("--set wheel={radios: 1}: wheel.radios"), HasSubstr("`radius`")));
  // Of two assignments to one key the later holds.
  EXPECT_EQ(ErrorOf(file, {"speed=1", "speed=2"}),
            "rover.yaml with --set speed=2: expected speed <= 1.0: speed=2");
  // The file's own fault stays the file's.
  EXPECT_EQ(ErrorOf("speed: 2\n", {"wheel.radius=1"}),
            "rover.yaml: expected speed <= 1.0: speed=2");
  EXPECT_EQ(ErrorOf("speed: 2\n", {"named.peed=  {radius: 1}"}),
            "rover.yaml: expected speed <= 1.0: speed=2");
  EXPECT_EQ(ErrorOf("wheel: {name: fifth}\n", {"wheel.radius=1"}),
            "rover.yaml: wheel.name: a rover has four");
}

TEST(YamlDocument, OverlaysMergeMapsAndReplaceTheRest) {
  YamlDocument document = YamlDocument::FromText("speed: 1\nwheel: {radius: 0.1, name: x}\n", "a");
  document.Overlay(YamlDocument::FromText("wheel: {name: y}\n", "b"));
  document.Set("wheel.radius=0.9");
  document.Set("named.rear.radius=0.8");
  const RoverOptions options = Read(document);
  EXPECT_EQ(options.speed, 1.0);
  EXPECT_EQ(options.wheel.name, "y");
  EXPECT_EQ(options.wheel.radius, 0.9);
  EXPECT_EQ(options.named.at("rear").radius, 0.8);
  EXPECT_THROW(document.Set("speed"), InputError);
}

TEST(YamlDocument, MissingFilesAreNamed) {
  EXPECT_THROW(YamlDocument::FromFile("/nowhere/rig.yaml"), InputError);
  EXPECT_THROW(YamlDocument::FromFile("/tmp"), InputError);
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/test_folder.h"

namespace regolith {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string Npy(const std::string& dictionary, const std::vector<float>& values, int version = 1) {
  std::string header = dictionary;
  const size_t before = version == 1 ? 10 : 12;
  while ((before + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) {
    bytes += static_cast<char>(static_cast<uint8_t>(header.size() >> (8 * i)));
  }
  bytes += header;
  for (const float value : values) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }
  return bytes;
}

std::string Dictionary(const std::string& type, const std::string& order,
                       const std::string& shape) {
  return "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }";
}

class NpyTest : public testing::Test {
 protected:
  NpyArray Read(const std::string& bytes) const {
    WriteFile(folder_.Path("array.npy"), bytes);
    return ReadNpy(folder_.Path("array.npy"));
  }
  std::string ErrorOf(const std::string& bytes) const {
    try {
      Read(bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  TestFolder folder_;
};

TEST_F(NpyTest, ReadsBothVersions) {
  for (const int version : {1, 2}) {
    const NpyArray array =
        Read(Npy(Dictionary("<f4", "False", "(2, 3)"), {1, 2, 3, 4, 5, -6.5}, version));
    EXPECT_THAT(array.shape, ElementsAre(2, 3));
    EXPECT_THAT(array.values, ElementsAre(1, 2, 3, 4, 5, -6.5));
  }
}

TEST_F(NpyTest, ReadsVectorsScalarsAndEmptyArrays) {
  EXPECT_THAT(Read(Npy(Dictionary("<f4", "False", "(2,)"), {1, 2})).shape, ElementsAre(2));
  EXPECT_THAT(Read(Npy(Dictionary("<f4", "False", "()"), {7})).values, ElementsAre(7));
  const NpyArray empty = Read(Npy(Dictionary("<f4", "False", "(4, 0)"), {}));
  EXPECT_THAT(empty.shape, ElementsAre(4, 0));
  EXPECT_TRUE(empty.values.empty());
}

TEST_F(NpyTest, RefusesOtherTypesOrdersAndVersions) {
  EXPECT_THAT(ErrorOf(Npy(Dictionary("<f8", "False", "(1,)"), {1, 2})), HasSubstr("'<f8'"));
  EXPECT_THAT(ErrorOf(Npy(Dictionary(">f4", "False", "(1,)"), {1})), HasSubstr("'>f4'"));
  EXPECT_THAT(ErrorOf(Npy(Dictionary("<f4", "True", "(1,)"), {1})), HasSubstr("Fortran"));
  EXPECT_THAT(ErrorOf(Npy(Dictionary("<f4", "False", "(1,)"), {1}, 3)), HasSubstr("version 3"));
  EXPECT_THAT(ErrorOf("P5 640 480 255"), HasSubstr("not a .npy file"));
  EXPECT_THAT(ErrorOf(Npy("{}", {})), HasSubstr("no header"));
  EXPECT_THROW(ReadNpy(folder_.Path("absent.npy")), InputError);
}

TEST_F(NpyTest, RefusesShapesThatCannotBe) {
  for (const char* shape : {"(-1,)", "(2, x)", "(2", "2", "(4294967296, 4294967296, 4)"}) {
    EXPECT_THAT(ErrorOf(Npy(Dictionary("<f4", "False", shape), {1})), HasSubstr("shape")) << shape;
  }
}

// Whatever length a file is cut to, it is refused.
TEST_F(NpyTest, RefusesTruncatedAndOverlongFiles) {
  const std::string whole = Npy(Dictionary("<f4", "False", "(3,)"), {1, 2, 3});
  for (size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(ErrorOf(whole.substr(0, size)), "") << size;
  }
  EXPECT_THAT(ErrorOf(whole.substr(0, whole.size() - 1)), HasSubstr("11 bytes"));
  EXPECT_THAT(ErrorOf(whole + "x"), HasSubstr("13 bytes"));
}

}  // namespace
}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/test_folder.h"

namespace regolith {
namespace {

Image Gradient() {
  Image image{31, 17, {}};
  for (int i = 0; i < 31 * 17; ++i) image.data.push_back(static_cast<uint8_t>(i * 7));
  return image;
}

TEST(ImageFile, PngIsLossless) {
  const TestFolder folder;
  const Image image = Gradient();
  WritePng(folder.Path("a.png"), image);
  const Image read = ReadImage(folder.Path("a.png"));
  EXPECT_EQ(read.width, 31);
  EXPECT_EQ(read.height, 17);
  EXPECT_EQ(read.data, image.data);
  EXPECT_EQ(EncodePng(image), EncodePng(image));
}

TEST(ImageFile, DamageIsReportedNotCrashedOn) {
  const TestFolder folder;
  const std::vector<uint8_t> png = EncodePng(Gradient());
  for (size_t length = 0; length < png.size(); length += 5) {
    // A decoder may give what it has of a cut image; it must not give another size.
    const auto image = DecodeImage({png.data(), length});
    if (image) {
      EXPECT_EQ(image->data.size(), 31U * 17U);
    }
  }
  EXPECT_FALSE(DecodeImage({}));
  // A whole image of 1 x 1, but a portable grey map.
  const std::string grey_map = "P5\n1 1\n255\n\x40";
  EXPECT_FALSE(DecodeImage({reinterpret_cast<const uint8_t*>(grey_map.data()), grey_map.size()}));
  WriteFile(folder.Path("a.png"), "no image");
  EXPECT_THROW(ReadImage(folder.Path("a.png")), InputError);
  EXPECT_THROW(ReadImage(folder.Path("b.png")), InputError);
}

}  // namespace
}  // namespace regolith

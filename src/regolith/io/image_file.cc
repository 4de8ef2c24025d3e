// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/image_file.h"

#include <algorithm>
#include <string_view>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

/// OpenCV would also try its decoders of rarer formats, which are less tested against damage and
/// print to the terminal.
bool IsPngOrJpeg(Span<const uint8_t> bytes) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()),
                               std::min<size_t>(bytes.size(), 8));
  return start == "\x89PNG\r\n\x1a\n" || start.substr(0, 3) == "\xff\xd8\xff";
}

}  // namespace

Image ReadImage(const std::string& path) {
  const std::string bytes = ReadFile(path);
  auto image = DecodeImage({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
  if (!image) throw InputError(path, "is not an image that can be read (PNG, JPEG) or is damaged");
  return std::move(*image);
}

void WritePng(const std::string& path, const Image& image) {
  const std::vector<uint8_t> bytes = EncodePng(image);
  WriteFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::vector<uint8_t> EncodePng(const Image& image) {
  REGOLITH_CHECK(image.width > 0 && image.height > 0, image.width, " x ", image.height);
  REGOLITH_CHECK(
      image.data.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height),
      image.data.size());
  const cv::Mat view(image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.data.data()));
  std::vector<uint8_t> bytes;
  // Run lengths and Huffman codes alone: sensor noise repeats no longer pattern, and looking for
  // one costs time and, at this level, bytes (640 x 480 with noise of 3: 8.5 ms and 155 kB, against
  // 9.5 ms and 179 kB).
  const bool encoded = cv::imencode(
      ".png", view, bytes,
      {cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_RLE});
  REGOLITH_CHECK(encoded, "PNG encoder failed");
  return bytes;
}

std::optional<Image> DecodeImage(Span<const uint8_t> bytes) {
  if (!IsPngOrJpeg(bytes) || bytes.size() > static_cast<size_t>(INT32_MAX)) return std::nullopt;
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                        const_cast<uint8_t*>(bytes.data()));
  cv::Mat decoded;
  try {
    decoded = cv::imdecode(encoded, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  if (decoded.empty()) return std::nullopt;
  Image image;
  image.width = decoded.cols;
  image.height = decoded.rows;
  image.data.reserve(decoded.total());
  for (int row = 0; row < decoded.rows; ++row) {
    image.data.insert(image.data.end(), decoded.ptr(row), decoded.ptr(row) + decoded.cols);
  }
  return image;
}

}  // namespace regolith

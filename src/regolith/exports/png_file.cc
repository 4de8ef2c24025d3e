// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/png_file.h"

#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "regolith/core/check.h"
#include "regolith/io/atomic_file.h"

namespace regolith {
namespace {

void WritePngFile(const std::string& path, const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  REGOLITH_CHECK(cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 4}), path);
  WriteFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

void WriteGreyPng16(const std::string& path, int width, int height, Span<const uint16_t> grey) {
  REGOLITH_CHECK(grey.size() == static_cast<size_t>(width) * static_cast<size_t>(height), path);
  WritePngFile(path, cv::Mat(height, width, CV_16UC1, const_cast<uint16_t*>(grey.data())));
}

void WriteColourPng(const std::string& path, int width, int height, Span<const uint8_t> colours) {
  REGOLITH_CHECK(colours.size() == 3 * static_cast<size_t>(width) * static_cast<size_t>(height),
                 path);
  // OpenCV's order is blue, green, red.
  std::vector<uint8_t> turned(colours.begin(), colours.end());
  for (size_t i = 0; i + 2 < turned.size(); i += 3) std::swap(turned[i], turned[i + 2]);
  WritePngFile(path, cv::Mat(height, width, CV_8UC3, turned.data()));
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/match_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr double kPanelSide = 960.0;  // pixels of the picture, longer side of the larger image
constexpr double kMaxScale = 16.0;
/// From here on pixels are shown as squares: interpolation would invent what no camera saw.
constexpr double kSquaresFrom = 3.0;
constexpr int kGap = 6;          // pixels between the images
constexpr int kMargin = 10;      // pixels around the caption
constexpr int kLineHeight = 26;  // pixels of the caption
constexpr double kFontScale = 0.6;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kRejectedOpacity = 0.35;
constexpr double kKeptOpacity = 0.8;
/// Lines end on fractions of a pixel.
constexpr int kSubpixelBits = 4;

// Blue, green, red.
const cv::Scalar kPaper(255, 255, 255);
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kKeypoint(50, 50, 235);
const cv::Scalar kRejected(170, 170, 170);
const cv::Scalar kWrong(60, 60, 240);
const cv::Scalar kUnknown(40, 170, 240);
/// Neighbouring lines differ enough to be followed by eye.
const std::array<cv::Scalar, 6> kKept = {cv::Scalar(90, 205, 95),   cv::Scalar(170, 200, 60),
                                         cv::Scalar(150, 230, 120), cv::Scalar(205, 185, 85),
                                         cv::Scalar(120, 170, 40),  cv::Scalar(215, 225, 120)};

struct Layout {
  double scale = 1.0;
  cv::Rect first;
  cv::Rect second;
  cv::Size canvas;
};

cv::Size ScaledSize(const MatchPanel& panel, double scale) {
  return {std::max(1, static_cast<int>(std::lround(panel.width * scale))),
          std::max(1, static_cast<int>(std::lround(panel.height * scale)))};
}

Layout MakeLayout(const MatchPanel& first, const MatchPanel& second,
                  const std::vector<std::string>& caption) {
  Layout layout;
  const int side = std::max({first.width, first.height, second.width, second.height});
  layout.scale = std::min(kPanelSide / side, kMaxScale);
  const cv::Size first_size = ScaledSize(first, layout.scale);
  const cv::Size second_size = ScaledSize(second, layout.scale);
  layout.first = cv::Rect(cv::Point(0, 0), first_size);
  layout.second = cv::Rect(cv::Point(first_size.width + kGap, 0), second_size);
  int width = layout.second.br().x;
  for (const std::string& line : caption) {
    int baseline = 0;
    const cv::Size text = cv::getTextSize(line, kFont, kFontScale, 1, &baseline);
    width = std::max(width, text.width + 2 * kMargin);
  }
  const int text_height =
      caption.empty() ? 0 : 2 * kMargin + kLineHeight * static_cast<int>(caption.size());
  layout.canvas = {width, std::max(first_size.height, second_size.height) + text_height};
  return layout;
}

void DrawImage(const MatchPanel& panel, const Layout& layout, const cv::Rect& place,
               cv::Mat* canvas) {
  const cv::Mat grey(panel.height, panel.width, CV_8UC1, const_cast<uint8_t*>(panel.grey.data()));
  int interpolation = cv::INTER_LINEAR;
  if (layout.scale < 1.0) interpolation = cv::INTER_AREA;
  if (layout.scale >= kSquaresFrom) interpolation = cv::INTER_NEAREST;
  cv::Mat scaled;
  cv::resize(grey, scaled, place.size(), 0, 0, interpolation);
  cv::cvtColor(scaled, (*canvas)(place), cv::COLOR_GRAY2BGR);
}

/// In units of 1 / 2^kSubpixelBits. The centre of pixel 0 lies half a pixel from the image's edge.
cv::Point PlaceOf(const Eigen::Vector2f& pixel, const Layout& layout, const cv::Rect& panel) {
  const auto place = [&](float coordinate, int offset) {
    const double centre = (static_cast<double>(coordinate) + 0.5) * layout.scale - 0.5 + offset;
    return static_cast<int>(std::lround(std::clamp(centre, -1e6, 1e6) * (1 << kSubpixelBits)));
  };
  return {place(pixel.x(), panel.x), place(pixel.y(), panel.y)};
}

cv::Scalar ColourOf(const MatchLine& match, size_t index) {
  switch (match.style) {
    case MatchStyle::kRejected:
      return kRejected;
    case MatchStyle::kWrong:
      return kWrong;
    case MatchStyle::kUnknown:
      return kUnknown;
    case MatchStyle::kKept:
    case MatchStyle::kCorrect:
      break;
  }
  return kKept[index % kKept.size()];
}

template <typename Wanted>
void DrawLines(Span<const MatchLine> matches, const Layout& layout, double opacity,
               const Wanted& wanted, cv::Mat* canvas) {
  cv::Mat layer = canvas->clone();
  for (size_t i = 0; i < matches.size(); ++i) {
    const MatchLine& match = matches[i];
    if (!wanted(match.style)) continue;
    cv::line(layer, PlaceOf(match.first, layout, layout.first),
             PlaceOf(match.second, layout, layout.second), ColourOf(match, i), 1, cv::LINE_AA,
             kSubpixelBits);
  }
  cv::addWeighted(layer, opacity, *canvas, 1.0 - opacity, 0.0, *canvas);
}

void DrawKeypoints(const MatchPanel& panel, const Layout& layout, const cv::Rect& place,
                   cv::Mat* canvas) {
  constexpr int kRadius = (5 << kSubpixelBits) / 2;
  for (const Eigen::Vector2f& pixel : panel.keypoints) {
    cv::circle(*canvas, PlaceOf(pixel, layout, place), kRadius, kKeypoint, cv::FILLED, cv::LINE_AA,
               kSubpixelBits);
  }
}

void CheckPanel(const MatchPanel& panel) {
  REGOLITH_CHECK(
      panel.width > 0 && panel.height > 0 &&
          panel.grey.size() == static_cast<size_t>(panel.width) * static_cast<size_t>(panel.height),
      panel.width, " x ", panel.height, " with ", panel.grey.size(), " pixels");
}

}  // namespace

std::vector<uint8_t> DrawMatches(const MatchPanel& first, const MatchPanel& second,
                                 Span<const MatchLine> matches,
                                 const std::vector<std::string>& caption) {
  CheckPanel(first);
  CheckPanel(second);
  const Layout layout = MakeLayout(first, second, caption);
  cv::Mat canvas(layout.canvas, CV_8UC3, kPaper);
  DrawImage(first, layout, layout.first, &canvas);
  DrawImage(second, layout, layout.second, &canvas);
  const auto draw = [&](double opacity, const auto& wanted) {
    DrawLines(matches, layout, opacity, wanted, &canvas);
  };
  draw(kRejectedOpacity, [](MatchStyle style) { return style == MatchStyle::kRejected; });
  draw(kKeptOpacity, [](MatchStyle style) {
    return style == MatchStyle::kKept || style == MatchStyle::kCorrect;
  });
  draw(kKeptOpacity, [](MatchStyle style) {
    return style == MatchStyle::kWrong || style == MatchStyle::kUnknown;
  });
  DrawKeypoints(first, layout, layout.first, &canvas);
  DrawKeypoints(second, layout, layout.second, &canvas);
  int baseline = std::max(layout.first.height, layout.second.height) + kMargin;
  for (const std::string& line : caption) {
    baseline += kLineHeight;
    cv::putText(canvas, line, {kMargin, baseline - kLineHeight / 4}, kFont, kFontScale, kInk, 1,
                cv::LINE_AA);
  }
  std::vector<uint8_t> png;
  const bool encoded = cv::imencode(".png", canvas, png);
  REGOLITH_CHECK(encoded, "PNG encoder failed");
  return png;
}

}  // namespace regolith

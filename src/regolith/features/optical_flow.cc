// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/optical_flow.h"

#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>

#include "regolith/core/check.h"

namespace regolith {
namespace {

/// An image's pyramid with gradients; empty where the image is smaller than the patch.
struct Pyramid {
  int width = 0;
  int height = 0;
  std::vector<cv::Mat> levels;

  bool Contains(const Eigen::Vector2f& point) const {  // false for NaN
    return point.x() >= 0.0F && point.y() >= 0.0F && point.x() <= static_cast<float>(width - 1) &&
           point.y() <= static_cast<float>(height - 1);
  }
};

/// One direction of tracking; `to` comes in as the guess.
struct LucasKanade {
  const OpticalFlowOptions& options;
  const Pyramid& source;
  const Pyramid& target;

  void Track(const std::vector<cv::Point2f>& from, std::vector<cv::Point2f>* to,
             std::vector<uint8_t>* found, std::vector<float>* errors) const {
    const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS,
                                    options.max_iterations, 0.01);
    cv::calcOpticalFlowPyrLK(source.levels, target.levels, from, *to, *found, *errors,
                             {options.window, options.window}, options.pyramid_levels, criteria,
                             cv::OPTFLOW_USE_INITIAL_FLOW, options.min_eigenvalue);
  }
};

cv::Point2f ToCv(const Eigen::Vector2f& point) { return {point.x(), point.y()}; }
Eigen::Vector2f FromCv(const cv::Point2f& point) { return {point.x, point.y}; }

}  // namespace

struct OpticalFlow::State {
  Pyramid previous;
  Pyramid current;
};

OpticalFlow::OpticalFlow(const OpticalFlowOptions& options)
    : options_(options), state_(std::make_unique<State>()) {
  options_.Check();
}

OpticalFlow::~OpticalFlow() = default;
OpticalFlow::OpticalFlow(OpticalFlow&&) noexcept = default;
OpticalFlow& OpticalFlow::operator=(OpticalFlow&&) noexcept = default;

void OpticalFlow::Advance(const Image& image) {
  REGOLITH_CHECK(
      image.width >= 0 && image.height >= 0 &&
          image.data.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height),
      image.width, " x ", image.height, " of ", image.data.size(), " bytes");
  // The storage of the image before the last is filled again.
  std::swap(state_->previous, state_->current);
  Pyramid& pyramid = state_->current;
  pyramid.width = image.width;
  pyramid.height = image.height;
  if (image.width < options_.window || image.height < options_.window) {
    pyramid.levels.clear();
    return;
  }
  const cv::Mat view(image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.data.data()));
  // The image is copied (it gets a border), so the caller's need not live on.
  cv::buildOpticalFlowPyramid(view, pyramid.levels, {options_.window, options_.window},
                              options_.pyramid_levels, /*withDerivatives=*/true,
                              cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT,
                              /*tryReuseInputImage=*/false);
}

void OpticalFlow::Reset() { *state_ = State(); }

void OpticalFlow::Track(const std::vector<Eigen::Vector2f>& points,
                        const std::vector<Eigen::Vector2f>& guess, FlowResult* result) const {
  REGOLITH_CHECK(guess.empty() || guess.size() == points.size(), guess.size(), " guesses for ",
                 points.size(), " points");
  result->pixels = points;
  result->found.assign(points.size(), 0);
  result->errors.assign(points.size(), 0.0F);
  const Pyramid& previous = state_->previous;
  const Pyramid& current = state_->current;
  if (previous.levels.empty() || current.levels.empty() || previous.width != current.width ||
      previous.height != current.height) {
    return;
  }

  std::vector<size_t> rows;
  std::vector<cv::Point2f> starts;
  std::vector<cv::Point2f> ends;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!previous.Contains(points[i])) continue;
    rows.push_back(i);
    starts.push_back(ToCv(points[i]));
    // A guess outside the image is taken as none: it would be lost at once.
    const bool guessed = !guess.empty() && current.Contains(guess[i]);
    ends.push_back(ToCv(guessed ? guess[i] : points[i]));
  }
  if (rows.empty()) return;

  // The way back begins with the guess turned round, not at the start it has to find.
  std::vector<cv::Point2f> returns(rows.size());
  for (size_t i = 0; i < rows.size(); ++i) returns[i] = starts[i] - ends[i];
  std::vector<uint8_t> found;
  std::vector<uint8_t> found_back;
  std::vector<float> errors;
  std::vector<float> errors_back;
  LucasKanade{options_, previous, current}.Track(starts, &ends, &found, &errors);
  for (size_t i = 0; i < rows.size(); ++i) returns[i] += ends[i];
  LucasKanade{options_, current, previous}.Track(ends, &returns, &found_back, &errors_back);

  for (size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Vector2f end = FromCv(ends[i]);
    const float gap = (FromCv(returns[i]) - FromCv(starts[i])).norm();
    const bool returned = gap <= static_cast<float>(options_.forward_backward);
    if (!found[i] || !found_back[i] || !returned || !current.Contains(end)) continue;
    result->pixels[rows[i]] = end;
    result->found[rows[i]] = 1;
    result->errors[rows[i]] = errors[i];
  }
}

}  // namespace regolith

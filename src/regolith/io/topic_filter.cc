// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/topic_filter.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

std::string Counted(size_t count, const std::string& noun) {
  return Concatenate(count, " ", noun, count == 1 ? "" : "s");
}

}  // namespace

TopicFilter::TopicFilter(std::string name, std::vector<TopicCut> cuts)
    : name_(std::move(name)), cuts_(std::move(cuts)) {}

bool TopicFilter::Accept(TimeNs stamp, TimeNs recording_start) {
  if (last_ && stamp <= *last_) {
    CountDropped("stamp not after the previous one");
    return false;
  }
  last_ = stamp;
  const double seconds = SecondsBetween(recording_start, stamp);
  const bool cut = std::any_of(cuts_.begin(), cuts_.end(), [&](const TopicCut& range) {
    return seconds >= range.start && seconds < range.end;
  });
  cut_ += cut ? 1 : 0;
  return !cut;
}

void TopicFilter::CountPoints(size_t invalid) {
  invalid_points_ += invalid;
  clouds_with_invalid_points_ += invalid > 0 ? 1 : 0;
}

void TopicFilter::Note(const std::string& remark) {
  if (std::find(notes_.begin(), notes_.end(), remark) == notes_.end()) notes_.push_back(remark);
}

void TopicFilter::AppendNotices(std::vector<std::string>* notices) const {
  for (const std::string& note : notes_) notices->push_back(name_ + ": " + note);
  for (const auto& [reason, count] : dropped_) {
    notices->push_back(name_ + ": " + Counted(count, "message") + " dropped: " + reason);
  }
  if (invalid_points_ > 0) {
    notices->push_back(name_ + ": " + Counted(invalid_points_, "point") +
                       " dropped: not finite (in " + Counted(clouds_with_invalid_points_, "cloud") +
                       ")");
  }
  if (cut_ > 0) notices->push_back(name_ + ": " + Counted(cut_, "message") + " cut as asked");
}

std::vector<TopicCut> CutsOf(const std::vector<TopicCut>& cuts, const std::string& topic,
                             const std::string& sensor) {
  std::vector<TopicCut> found;
  for (const TopicCut& cut : cuts) {
    if (cut.topic == topic || cut.topic == sensor) found.push_back(cut);
  }
  return found;
}

void CheckCuts(const std::vector<TopicCut>& cuts, const RigCalibration& rig) {
  std::vector<std::pair<std::string, std::string>> known;
  if (rig.imu) known.emplace_back(rig.imu->topic, "imu");
  if (rig.lidar) known.emplace_back(rig.lidar->topic, "lidar");
  for (const auto& [name, camera] : rig.cameras) known.emplace_back(camera.topic, name);
  if (rig.wheels) known.emplace_back(rig.wheels->topic, "wheels");
  for (const TopicCut& cut : cuts) {
    if (!(cut.start <= cut.end)) {
      throw InputError("cut of " + cut.topic,
                       Concatenate("starts at ", cut.start, " s and ends at ", cut.end, " s"));
    }
    const bool found = std::any_of(known.begin(), known.end(), [&](const auto& sensor) {
      return cut.topic == sensor.first || cut.topic == sensor.second;
    });
    if (found) continue;
    std::string names;
    for (const auto& [topic, sensor] : known) names += " " + (topic.empty() ? sensor : topic);
    throw InputError("cut of " + cut.topic, "no sensor of the rig has this topic; it has" + names);
  }
}

void CheckImageSize(const std::string& where, const CameraFrame& frame,
                    const CameraCalibration& camera) {
  if (frame.image.width == camera.intrinsics.width &&
      frame.image.height == camera.intrinsics.height) {
    return;
  }
  throw InputError(where, Concatenate("images of ", frame.image.width, " x ", frame.image.height,
                                      " pixels; the rig's camera '", frame.camera, "' has ",
                                      camera.intrinsics.width, " x ", camera.intrinsics.height));
}

}  // namespace regolith

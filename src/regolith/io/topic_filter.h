// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "regolith/core/time.h"
#include "regolith/io/recording.h"

namespace regolith {

/// Decides what of one topic is passed on, and keeps count of what is not.
class TopicFilter {
 public:
  /// `name`: as in messages to the user. Cuts are those of this topic.
  TopicFilter(std::string name, std::vector<TopicCut> cuts);

  /// Whether a measurement is passed on: later than the last one and in no cut.
  bool Accept(TimeNs stamp, TimeNs recording_start);

  void CountDropped(const std::string& reason) { ++dropped_[reason]; }
  void CountPoints(size_t invalid);
  /// A remark, made once.
  void Note(const std::string& remark);

  const std::string& name() const { return name_; }
  void AppendNotices(std::vector<std::string>* notices) const;

 private:
  std::string name_;
  std::vector<TopicCut> cuts_;
  std::optional<TimeNs> last_;
  std::map<std::string, size_t> dropped_;
  std::vector<std::string> notes_;
  size_t invalid_points_ = 0;
  size_t clouds_with_invalid_points_ = 0;
  size_t cut_ = 0;
};

/// The cuts of one sensor. Throws InputError for a cut of a topic that no sensor of the rig has, or
/// that ends before it starts.
std::vector<TopicCut> CutsOf(const std::vector<TopicCut>& cuts, const std::string& topic,
                             const std::string& sensor);
void CheckCuts(const std::vector<TopicCut>& cuts, const RigCalibration& rig);

/// Throws InputError where a camera's image has another size than the rig says.
void CheckImageSize(const std::string& where, const CameraFrame& frame,
                    const CameraCalibration& camera);

}  // namespace regolith

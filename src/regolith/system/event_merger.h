// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "regolith/sensor/sensor_event.h"
#include "regolith/system/live_options.h"

namespace regolith {

/// Brings the measurements of several topics into the order of their stamps, as a recording gives
/// them, and drops what cannot be: stamps of 0, that repeat, that come too late, or that lie far
/// from all others (a clock that is wrong). Where all of them move, time has jumped.
class EventMerger {
 public:
  /// Measurements of one topic that were dropped.
  struct Dropped {
    size_t no_stamp = 0;
    size_t repeated = 0;  ///< stamp not after the previous one
    size_t late = 0;      ///< later ones of other topics had been passed on
    size_t astray = 0;    ///< far from the stamps of other topics
  };

  /// Equal stamps go in the order of their topics, 0 first.
  EventMerger(size_t topics, const EventMergerOptions& options);

  /// Whether time has jumped to another place: everything before belongs to an earlier run.
  bool Add(size_t topic, SensorEvent event);

  /// Those that nothing earlier can precede any more.
  std::vector<SensorEvent> TakeReady();
  /// All, where nothing more comes.
  std::vector<SensorEvent> TakeAll();

  const Dropped& dropped(size_t topic) const { return topics_.at(topic).dropped; }
  size_t waiting() const { return waiting_.size(); }

 private:
  struct Topic {
    std::optional<TimeNs> last;
    Dropped dropped;
  };
  using Key = std::pair<TimeNs, size_t>;  ///< stamp, topic

  bool IsAstray(const std::optional<TimeNs>& last, TimeNs stamp) const;
  bool AddAstray(size_t topic, SensorEvent event);
  void DropAstray();
  void Insert(size_t topic, SensorEvent event);
  bool IsReady(TimeNs stamp) const;
  SensorEvent PopFirst();

  EventMergerOptions options_;
  std::vector<Topic> topics_;
  std::map<Key, SensorEvent> waiting_;
  std::vector<std::pair<size_t, SensorEvent>> astray_;
  std::optional<TimeNs> first_;      ///< since the start or the last jump
  std::optional<TimeNs> newest_;     ///< of all that were taken
  std::optional<TimeNs> passed_on_;  ///< stamp of the last one passed on
};

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/folder_source.h"

#include <algorithm>
#include <utility>

namespace regolith {
namespace {

class FolderSource : public SensorSource {
 public:
  FolderSource(std::vector<FolderStream> streams, TimeNs start, std::vector<std::string> notices)
      : streams_(std::move(streams)),
        heads_(streams_.size()),
        notices_(std::move(notices)),
        start_(start),
        end_(start) {
    for (const FolderStream& stream : streams_) end_ = std::max(end_, stream.last);
  }

  std::optional<SensorEvent> Next() override {
    if (!started_) {
      for (size_t i = 0; i < streams_.size(); ++i) Advance(i);
      started_ = true;
    }
    std::optional<size_t> earliest;
    for (size_t i = 0; i < heads_.size(); ++i) {
      if (!heads_[i]) continue;
      if (!earliest || EventTime(*heads_[i]) < EventTime(*heads_[*earliest])) earliest = i;
    }
    if (!earliest) return std::nullopt;
    std::optional<SensorEvent> event = std::move(heads_[*earliest]);
    Advance(*earliest);
    return event;
  }

  TimeNs start_time() const override { return start_; }
  TimeNs end_time() const override { return end_; }

  std::vector<std::string> Notices() const override {
    std::vector<std::string> notices = notices_;
    for (const FolderStream& stream : streams_) stream.filter.AppendNotices(&notices);
    return notices;
  }

 private:
  void Advance(size_t i) {
    FolderStream& stream = streams_[i];
    do {
      heads_[i] = stream.next(stream.filter);
    } while (heads_[i] && !stream.filter.Accept(EventTime(*heads_[i]), start_));
  }

  std::vector<FolderStream> streams_;
  std::vector<std::optional<SensorEvent>> heads_;
  std::vector<std::string> notices_;
  TimeNs start_ = 0;
  TimeNs end_ = 0;
  bool started_ = false;
};

}  // namespace

std::unique_ptr<SensorSource> MergeStreams(std::vector<FolderStream> streams, TimeNs start,
                                           std::vector<std::string> notices) {
  return std::make_unique<FolderSource>(std::move(streams), start, std::move(notices));
}

}  // namespace regolith

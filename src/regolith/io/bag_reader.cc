// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/bag_reader.h"

#include <filesystem>
#include <map>
#include <utility>

#include <console_bridge/console.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

TimeNs FromRos(const ros::Time& time) {
  return static_cast<TimeNs>(time.sec) * 1000000000 + static_cast<TimeNs>(time.nsec);
}

/// Runs an action on a bag; what the library throws becomes an InputError. Besides its own
/// exceptions these are length errors and failed allocations from damaged sizes.
template <typename Action>
auto Guard(const std::string& path, Action action) {
  try {
    return action();
  } catch (const rosbag::BagUnindexedException&) {
    throw InputError(path,
                     "the bag is truncated or was not closed; run `rosbag reindex " + path + "`");
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(path, std::string("the bag is truncated or damaged (") + error.what() +
                               "); try `rosbag reindex " + path + "`");
  }
}

class RosBagCursor : public BagCursor {
 public:
  RosBagCursor(const std::string& path, std::unique_ptr<rosbag::View> view,
               std::vector<uint8_t>* buffer)
      : path_(path), view_(std::move(view)), position_(view_->begin()), buffer_(buffer) {}

  bool Done() const override { return position_ == view_->end(); }
  TimeNs record_time() const override { return FromRos(position_->getTime()); }
  std::string topic() const override { return position_->getTopic(); }
  std::string type() const override { return position_->getDataType(); }

  MessageBytes Read() override {
    return Guard(path_, [&]() -> MessageBytes {
      const uint32_t size = position_->size();
      // A damaged length would ask for memory that no message needs.
      if (size > std::filesystem::file_size(path_) * kMostCompression) {
        throw InputError(path_, "the bag is damaged: a message longer than the bag");
      }
      buffer_->resize(size);
      ros::serialization::OStream stream(buffer_->data(), size);
      position_->write(stream);
      return *buffer_;
    });
  }

  void Advance() override {
    Guard(path_, [&] { ++position_; });
  }

 private:
  static constexpr uint64_t kMostCompression = 2000;

  std::string path_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator position_;
  std::vector<uint8_t>* buffer_;
};

class RosBagReader : public BagReader {
 public:
  explicit RosBagReader(const std::string& path) : path_(path) {
    // The library would print what is reported by exception anyway.
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
    Guard(path_, [&] {
      bag_.open(path_, rosbag::bagmode::Read);
      rosbag::View view(bag_);
      if (view.size() == 0) throw InputError(path_, "the bag holds no messages");
      first_ = FromRos(view.getBeginTime());
      last_ = FromRos(view.getEndTime());
      CountTopics(view);
    });
  }

  const std::string& path() const override { return path_; }
  const std::vector<BagTopic>& topics() const override { return topics_; }
  TimeNs first_record_time() const override { return first_; }
  TimeNs last_record_time() const override { return last_; }

  std::unique_ptr<BagCursor> Cursor(const std::string& topic) override {
    return Guard(path_, [&] {
      auto view = topic.empty() ? std::make_unique<rosbag::View>(bag_)
                                : std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery(topic));
      return std::make_unique<RosBagCursor>(path_, std::move(view), &buffer_);
    });
  }

 private:
  void CountTopics(rosbag::View& view) {
    std::map<std::pair<std::string, std::string>, uint32_t> counts;
    for (const rosbag::ConnectionInfo* const connection : view.getConnections()) {
      const std::pair<std::string, std::string> key(connection->topic, connection->datatype);
      if (counts.count(key) != 0) continue;
      const auto same = [&](rosbag::ConnectionInfo const* other) {
        return other->topic == key.first && other->datatype == key.second;
      };
      counts[key] = rosbag::View(bag_, same).size();
    }
    for (const auto& [key, count] : counts) topics_.push_back({key.first, key.second, count});
  }

  std::string path_;
  rosbag::Bag bag_;
  std::vector<BagTopic> topics_;
  std::vector<uint8_t> buffer_;
  TimeNs first_ = 0;
  TimeNs last_ = 0;
};

/// As a shell takes it.
std::string Quoted(const std::string& path) {
  const bool is_plain = path.find_first_not_of(
                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                            "_-+=:,./@%") == std::string::npos;
  if (is_plain && path[0] != '-') return path;
  std::string quoted = "'";
  for (const char letter : path)
    quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

}  // namespace

void RefuseRos2(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path source(path);
  // A file of a recording's folder goes with the others in it.
  const fs::path folder = fs::absolute(source, error).parent_path();
  if (!fs::is_directory(source, error) && fs::exists(folder / "metadata.yaml", error)) {
    source = folder;
  }
  fs::path bag = fs::absolute(source, error).lexically_normal();
  if (!bag.has_filename()) bag = bag.parent_path();
  bag.replace_extension(".bag");
  throw InputError(path, "is a ROS 2 recording; convert it once with `rosbags-convert --src " +
                             Quoted(source.string()) + " --dst " + Quoted(bag.string()) +
                             "` (pip install rosbags) and give the .bag");
}

void CheckBagFile(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path, "no such file");
  if (!std::filesystem::is_regular_file(path, error)) throw InputError(path, "is not a file");
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) throw InputError(path, "cannot be opened");
  std::string magic(16, '\0');
  magic.resize(std::fread(magic.data(), 1, magic.size(), file));
  std::fclose(file);
  if (magic.empty()) throw InputError(path, "is empty");
  if (magic.rfind("SQLite format 3", 0) == 0 || magic.rfind("\x89MCAP", 0) == 0) {
    RefuseRos2(path);
  }
  if (magic.rfind("#ROSBAG V", 0) != 0) throw InputError(path, "is not a ROS bag");
}

std::unique_ptr<BagReader> BagReader::Open(const std::string& path) {
  CheckBagFile(path);
  return std::make_unique<RosBagReader>(path);
}

}  // namespace regolith

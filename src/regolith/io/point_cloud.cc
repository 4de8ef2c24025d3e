// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/point_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "regolith/io/wire_reader.h"

namespace regolith {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegreesPerRadian = 180.0 / kPi;

/// Types of sensor_msgs/PointField, 1 to 8.
enum class FieldType : uint8_t {
  kInt8 = 1,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat,
  kDouble
};

size_t TypeSize(uint8_t type) {
  constexpr std::array<size_t, 9> kSizes = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return type < kSizes.size() ? kSizes[type] : 0;
}

struct Field {
  std::string name;
  size_t offset = 0;
  uint8_t type = 0;

  bool integer() const { return type < static_cast<uint8_t>(FieldType::kFloat); }
};

template <typename T>
double Load(const uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double LoadField(const Field& field, const uint8_t* point) {
  const uint8_t* const bytes = point + field.offset;
  switch (static_cast<FieldType>(field.type)) {
    case FieldType::kInt8:
      return Load<int8_t>(bytes);
    case FieldType::kUint8:
      return Load<uint8_t>(bytes);
    case FieldType::kInt16:
      return Load<int16_t>(bytes);
    case FieldType::kUint16:
      return Load<uint16_t>(bytes);
    case FieldType::kInt32:
      return Load<int32_t>(bytes);
    case FieldType::kUint32:
      return Load<uint32_t>(bytes);
    case FieldType::kFloat:
      return Load<float>(bytes);
    case FieldType::kDouble:
      return Load<double>(bytes);
  }
  return 0.0;
}

struct Cloud {
  TimeNs stamp = 0;
  size_t height = 0;
  size_t width = 0;
  std::vector<Field> fields;
  bool big_endian = false;
  size_t point_step = 0;
  size_t row_step = 0;
  Span<const uint8_t> data;

  const Field* Find(std::initializer_list<const char*> names) const {
    for (const char* const name : names) {
      for (const Field& field : fields) {
        if (field.name == name) return &field;
      }
    }
    return nullptr;
  }
};

/// Fills `cloud`; gives what is wrong with it, empty where nothing is.
std::string ReadCloud(MessageBytes message, Cloud* cloud) {
  WireReader reader(message);
  cloud->stamp = reader.ReadHeader();
  cloud->height = reader.Read<uint32_t>();
  cloud->width = reader.Read<uint32_t>();
  const uint32_t count = reader.Read<uint32_t>();
  for (uint32_t i = 0; i < count && reader.ok(); ++i) {
    Field field;
    field.name = reader.ReadString();
    field.offset = reader.Read<uint32_t>();
    field.type = reader.Read<uint8_t>();
    reader.Skip(sizeof(uint32_t));
    cloud->fields.push_back(field);
  }
  cloud->big_endian = reader.Read<uint8_t>() != 0;
  cloud->point_step = reader.Read<uint32_t>();
  cloud->row_step = reader.Read<uint32_t>();
  cloud->data = reader.ReadArray();
  if (!reader.ok()) return "shorter than its type";
  if (cloud->big_endian) return "big-endian data";
  for (const Field& field : cloud->fields) {
    if (TypeSize(field.type) == 0 || field.offset + TypeSize(field.type) > cloud->point_step) {
      return "field '" + field.name + "' of unknown type or outside of its point";
    }
  }
  if (cloud->point_step == 0 || cloud->width * cloud->point_step > cloud->row_step ||
      (cloud->height > 0 && cloud->data.size() / cloud->height < cloud->row_step)) {
    return "width, steps and data that do not agree";
  }
  return {};
}

/// Seconds from the stamp of what a time field holds. The unit is not in the message: it is the one
/// that makes a sweep as long as a turn.
struct TimeUnit {
  double scale = 0.0;   ///< s; 0: none fits
  double origin = 0.0;  ///< of the field's own values, in their unit
};

TimeUnit FindTimeUnit(const Field& field, const std::vector<double>& values, TimeNs stamp,
                      double period) {
  if (values.empty()) return {1.0, 0.0};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double most = std::max(std::abs(*low), std::abs(*high));
  const double longest = std::max(10.0 * period, 1.0);
  const double stamp_ns = static_cast<double>(stamp);
  // Absolute times come as doubles: the epoch in seconds does not fit anything smaller.
  if (field.type == static_cast<uint8_t>(FieldType::kDouble)) {
    for (const double scale : {1.0, 1e-3, 1e-6, 1e-9}) {
      const double origin = stamp_ns * 1e-9 / scale;
      if (most > longest && std::abs(*low - origin) * scale < longest) return {scale, origin};
    }
  }
  if (field.integer()) return {most * 1e-9 <= longest ? 1e-9 : 0.0, 0.0};
  for (const double scale : {1.0, 1e-3, 1e-6, 1e-9}) {
    if ((*high - *low) * scale <= 1.5 * period && most * scale <= longest) return {scale, 0.0};
  }
  return {};
}

class CloudConverter {
 public:
  CloudConverter(const Cloud& cloud, const LidarCalibration& calibration)
      : cloud_(cloud),
        calibration_(calibration),
        x_(cloud.Find({"x"})),
        y_(cloud.Find({"y"})),
        z_(cloud.Find({"z"})),
        intensity_(cloud.Find({"intensity", "i", "reflectivity"})),
        ring_(cloud.Find({"ring", "channel", "line"})),
        time_(cloud.Find({"time", "t", "timestamp", "offset_time"})) {}

  PointCloudResult Convert() {
    PointCloudResult result;
    if (x_ == nullptr || y_ == nullptr || z_ == nullptr) {
      result.problem = "no fields x y z";
      return result;
    }
    LidarScan scan;
    scan.stamp = cloud_.stamp;
    // Rows without points may be as many as 32 bits count.
    const size_t rows = cloud_.width == 0 ? 0 : cloud_.height;
    for (size_t row = 0; row < rows; ++row) {
      for (size_t column = 0; column < cloud_.width; ++column) {
        Add(cloud_.data.data() + row * cloud_.row_step + column * cloud_.point_step, &scan);
      }
    }
    facts_.intensity_missing = intensity_ == nullptr;
    // Times before rings and ranges: the order of all points tells whether they lie as fired.
    SetTimes(&scan);
    if (ring_ == nullptr) {
      DeriveRings(calibration_, &scan);
      facts_.ring_derived = true;
    }
    RemoveOutOfRange(&scan);
    result.scan = std::move(scan);
    result.facts = facts_;
    return result;
  }

 private:
  void Add(const uint8_t* bytes, LidarScan* scan) {
    LidarPoint point;
    point.position = {static_cast<float>(LoadField(*x_, bytes)),
                      static_cast<float>(LoadField(*y_, bytes)),
                      static_cast<float>(LoadField(*z_, bytes))};
    const double time = time_ == nullptr ? 0.0 : LoadField(*time_, bytes);
    if (!point.position.allFinite() || !std::isfinite(time)) {
      ++facts_.invalid_points;
      return;
    }
    if (intensity_ != nullptr) {
      const float intensity = static_cast<float>(LoadField(*intensity_, bytes));
      point.intensity = std::isfinite(intensity) ? intensity : 0.0F;
    }
    if (ring_ != nullptr) {
      const double ring = LoadField(*ring_, bytes);
      point.ring =
          std::isnan(ring) ? uint16_t{0} : static_cast<uint16_t>(std::clamp(ring, 0.0, 65535.0));
    }
    scan->points.push_back(point);
    if (time_ != nullptr) times_.push_back(time);
  }

  void SetTimes(LidarScan* scan) {
    if (time_ != nullptr) {
      const TimeUnit unit = FindTimeUnit(*time_, times_, cloud_.stamp, calibration_.period);
      if (unit.scale != 0.0) {
        for (size_t i = 0; i < times_.size(); ++i) {
          scan->points[i].time = static_cast<float>((times_[i] - unit.origin) * unit.scale);
        }
        return;
      }
    }
    scan->has_point_times = DeriveTimes(calibration_.period, scan);
    facts_.time_derived = scan->has_point_times;
    facts_.time_missing = !scan->has_point_times;
  }

  void RemoveOutOfRange(LidarScan* scan) const {
    const auto outside = [&](const LidarPoint& point) {
      const double range = point.position.norm();
      return range < calibration_.min_range || range > calibration_.max_range;
    };
    scan->points.erase(std::remove_if(scan->points.begin(), scan->points.end(), outside),
                       scan->points.end());
  }

  const Cloud& cloud_;
  const LidarCalibration& calibration_;
  const Field* x_;
  const Field* y_;
  const Field* z_;
  const Field* intensity_;
  const Field* ring_;
  const Field* time_;
  std::vector<double> times_;
  PointCloudFacts facts_;
};

}  // namespace

PointCloudResult ParsePointCloud(MessageBytes message, const LidarCalibration& calibration) {
  Cloud cloud;
  PointCloudResult result;
  result.problem = ReadCloud(message, &cloud);
  if (!result.problem.empty()) return result;
  return CloudConverter(cloud, calibration).Convert();
}

void DeriveRings(const LidarCalibration& calibration, LidarScan* scan) {
  const double fan = calibration.highest_elevation_deg - calibration.lowest_elevation_deg;
  const double last = calibration.rings - 1;
  for (LidarPoint& point : scan->points) {
    const double elevation_deg =
        std::atan2(point.position.z(), point.position.head<2>().norm()) * kDegreesPerRadian;
    const double ring =
        fan > 0.0 ? std::round((elevation_deg - calibration.lowest_elevation_deg) / fan * last)
                  : 0.0;
    point.ring = static_cast<uint16_t>(std::clamp(ring, 0.0, std::max(last, 0.0)));
  }
}

bool DeriveTimes(double period, LidarScan* scan) {
  // A turn in firing order: azimuth runs one way, once round at most, with no more going back than
  // noise and the lasers' own offsets explain.
  constexpr double kLeastTurn = 0.5;  // rad; below it order says nothing
  constexpr double kMostTurn = 2.0 * kPi + 0.3;
  constexpr double kOrder = 0.8;
  std::vector<double> angles;
  angles.reserve(scan->points.size());
  double angle = 0.0;
  double travelled = 0.0;
  double previous = 0.0;
  for (LidarPoint& point : scan->points) {
    point.time = 0.0F;
    const double azimuth = std::atan2(point.position.y(), point.position.x());
    if (!angles.empty()) {
      const double step = std::remainder(azimuth - previous, 2.0 * kPi);
      angle += step;
      travelled += std::abs(step);
    }
    angles.push_back(angle);
    previous = azimuth;
  }
  if (std::abs(angle) < kLeastTurn || std::abs(angle) > kMostTurn ||
      std::abs(angle) < kOrder * travelled) {
    return false;
  }
  const double direction = angle > 0.0 ? 1.0 : -1.0;
  for (size_t i = 0; i < angles.size(); ++i) {
    const double turned = std::max(0.0, direction * angles[i]) / (2.0 * kPi);
    scan->points[i].time = static_cast<float>(turned * period);
  }
  return true;
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/kitti.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/folder_source.h"
#include "regolith/io/image_file.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;

constexpr int kMostRings = 64;        // HDL-64E
constexpr double kSlowestImu = 50.0;  // Hz; below it preintegration is not what its noise says

/// Where the files of one recording lie, whichever layout it has.
struct Layout {
  bool raw = false;
  std::string folder;
  std::string scans;       ///< folder of the .bin files
  std::string scan_times;  ///< text file, a line a scan
  int digits = 0;          ///< of a file's name

  std::string Images(size_t camera) const {
    return raw ? folder + "/image_0" + std::to_string(camera) + "/data"
               : folder + "/image_" + std::to_string(camera);
  }
  std::string ImageTimes(size_t camera) const {
    return raw ? folder + "/image_0" + std::to_string(camera) + "/timestamps.txt" : scan_times;
  }
  std::string File(const std::string& where, size_t index, const char* ending) const {
    std::array<char, 40> name{};
    std::snprintf(name.data(), name.size(), "/%0*zu%s", digits, index, ending);
    return where + name.data();
  }
};

Layout LayoutOf(const RecordingIdentity& identity) {
  const std::string& folder = identity.data_path;
  if (identity.format == RecordingFormat::kKittiRaw) {
    return {true, folder, folder + "/velodyne_points/data",
            folder + "/velodyne_points/timestamps.txt", 10};
  }
  return {false, folder, folder + "/velodyne", folder + "/times.txt", 6};
}

constexpr std::array<const char*, 2> kCameras = {"left", "right"};

std::vector<TimeNs> ReadTimes(const std::string& path, bool dates) {
  LineReader reader(path);
  std::vector<TimeNs> times;
  for (std::string line; reader.Next(&line);) {
    const auto time = dates ? ParseDate(line) : ParseSeconds(line);
    if (!time) {
      throw InputError(reader.Place(), "'" + line + "' is no time; expected " +
                                           (dates ? "YYYY-MM-DD HH:MM:SS.s" : "seconds"));
    }
    times.push_back(*time);
  }
  return times;
}

using CalibrationLines = std::map<std::string, std::vector<double>>;

/// "key: number number …" a line; lines of other content are passed over.
CalibrationLines ReadCalibration(const std::string& path) {
  CalibrationLines lines;
  LineReader reader(path);
  for (std::string line; reader.Next(&line);) {
    const size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::vector<double> values;
    bool numbers = true;
    for (const std::string_view field : SplitBlanks(std::string_view(line).substr(colon + 1))) {
      const auto value = ParseNumber(field);
      numbers = numbers && value.has_value();
      values.push_back(value.value_or(0.0));
    }
    if (numbers) lines[line.substr(0, colon)] = std::move(values);
  }
  return lines;
}

const std::vector<double>& Require(const CalibrationLines& lines, const std::string& key,
                                   size_t count, const std::string& path) {
  const auto found = lines.find(key);
  if (found == lines.end() || found->second.size() != count) {
    throw InputError(path, Concatenate("has no line '", key, ":' with ", count, " numbers"));
  }
  return found->second;
}

using Projection = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// What the calibration says of the rectified cameras.
struct KittiCameras {
  Eigen::Matrix4d T_rectified_lidar = Eigen::Matrix4d::Identity();
  std::array<std::optional<Projection>, kCameras.size()> projections;
  std::string path;
};

std::optional<KittiCameras> ReadRawCameras(const Layout& layout) {
  const fs::path date = fs::canonical(layout.folder).parent_path();
  const std::string cameras_path = (date / "calib_cam_to_cam.txt").string();
  const std::string lidar_path = (date / "calib_velo_to_cam.txt").string();
  if (!fs::exists(cameras_path) || !fs::exists(lidar_path)) return std::nullopt;
  using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  KittiCameras result;
  result.path = lidar_path;
  const CalibrationLines lidar = ReadCalibration(lidar_path);
  const CalibrationLines cameras = ReadCalibration(cameras_path);
  Eigen::Matrix4d T_camera_lidar = Eigen::Matrix4d::Identity();
  T_camera_lidar.topLeftCorner<3, 3>() =
      Eigen::Map<const Matrix3>(Require(lidar, "R", 9, lidar_path).data());
  T_camera_lidar.topRightCorner<3, 1>() =
      Eigen::Map<const Eigen::Vector3d>(Require(lidar, "T", 3, lidar_path).data());
  Eigen::Matrix4d rectification = Eigen::Matrix4d::Identity();
  rectification.topLeftCorner<3, 3>() =
      Eigen::Map<const Matrix3>(Require(cameras, "R_rect_00", 9, cameras_path).data());
  result.T_rectified_lidar = rectification * T_camera_lidar;
  for (size_t i = 0; i < kCameras.size(); ++i) {
    const std::string key = "P_rect_0" + std::to_string(i);
    result.projections[i] =
        Eigen::Map<const Projection>(Require(cameras, key, 12, cameras_path).data());
  }
  return result;
}

std::optional<KittiCameras> ReadOdometryCameras(const Layout& layout) {
  KittiCameras result;
  result.path = layout.folder + "/calib.txt";
  const CalibrationLines lines = ReadCalibration(result.path);
  if (lines.count("Tr") == 0) return std::nullopt;  // as the set without lidar has it
  result.T_rectified_lidar.topRows<3>() =
      Eigen::Map<const Projection>(Require(lines, "Tr", 12, result.path).data());
  for (size_t i = 0; i < kCameras.size(); ++i) {
    const std::string key = "P" + std::to_string(i);
    result.projections[i] =
        Eigen::Map<const Projection>(Require(lines, key, 12, result.path).data());
  }
  return result;
}

/// The first file of a folder that exists, among its first 100.
std::optional<std::string> FirstFile(const Layout& layout, const std::string& folder,
                                     const char* ending) {
  for (size_t i = 0; i < 100; ++i) {
    std::string path = layout.File(folder, i, ending);
    if (fs::exists(path)) return path;
  }
  return std::nullopt;
}

SE3 LidarToCamera(const KittiCameras& cameras) {
  try {
    return TransformFromMatrix(cameras.T_rectified_lidar);
  } catch (const InputError& error) {
    throw InputError(cameras.path, std::string("lidar to camera ") + error.what());
  }
}

void ApplyCameras(const Layout& layout, RigCalibration* rig) {
  const std::map<std::string, CameraCalibration> preset = std::exchange(rig->cameras, {});
  const auto cameras = layout.raw ? ReadRawCameras(layout) : ReadOdometryCameras(layout);
  if (!cameras) return;
  const SE3 T_rectified_lidar = LidarToCamera(*cameras);
  for (size_t i = 0; i < kCameras.size(); ++i) {
    const auto image_path = FirstFile(layout, layout.Images(i), ".png");
    if (!image_path) continue;
    const Projection& projection = *cameras->projections[i];
    const auto known = preset.find(kCameras[i]);
    CameraCalibration camera = known == preset.end() ? CameraCalibration() : known->second;
    const Image image = ReadImage(*image_path);
    camera.intrinsics = {};
    camera.intrinsics.width = image.width;
    camera.intrinsics.height = image.height;
    camera.intrinsics.focal = {projection(0, 0), projection(1, 1)};
    camera.intrinsics.principal_point = {projection(0, 2), projection(1, 2)};
    // P = K [I | t]: t moves points of the rectified frame into this camera's.
    const Eigen::Vector3d offset = projection.leftCols<3>().inverse() * projection.rightCols<1>();
    const SE3 T_camera_rectified(Eigen::Quaterniond::Identity(), offset);
    camera.T_imu_camera = (T_camera_rectified * T_rectified_lidar).Inverse();
    if (camera.topic.empty()) camera.topic = std::string("/camera/") + kCameras[i] + "/image_raw";
    rig->cameras[kCameras[i]] = camera;
  }
}

/// Rings and fan as the first scan has them.
void ApplyLidar(const Layout& layout, RigCalibration* rig) {
  if (!rig->lidar) rig->lidar.emplace();
  rig->lidar->T_imu_lidar = SE3();
  const auto path = FirstFile(layout, layout.scans, ".bin");
  if (!path) return;
  size_t invalid = 0;
  const LidarScan scan = ReadKittiScan(*path, kMostRings, &invalid);
  std::map<uint16_t, std::vector<double>, std::greater<>> elevations_deg;
  for (const LidarPoint& point : scan.points) {
    elevations_deg[point.ring].push_back(
        std::atan2(point.position.z(), point.position.head<2>().norm()) * 180.0 / M_PI);
  }
  if (elevations_deg.size() < 2) return;
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  rig->lidar->rings = static_cast<int>(elevations_deg.size());
  rig->lidar->highest_elevation_deg = median(elevations_deg.begin()->second);
  rig->lidar->lowest_elevation_deg = median(elevations_deg.rbegin()->second);
}

/// A counter of files with their stamps.
struct FileList {
  std::vector<TimeNs> times;
  size_t next = 0;
};

std::optional<SensorEvent> NextScan(const Layout& layout, FileList* files, TimeNs origin,
                                    const LidarCalibration& lidar, TopicFilter& filter) {
  while (files->next < files->times.size()) {
    const size_t index = files->next++;
    const std::string path = layout.File(layout.scans, index, ".bin");
    if (!fs::exists(path)) {
      filter.CountDropped("file is missing");
      continue;
    }
    size_t invalid = 0;
    LidarScan scan;
    try {
      scan = ReadKittiScan(path, lidar.rings, &invalid);
    } catch (const InputError&) {
      filter.CountDropped("file is damaged");
      continue;
    }
    filter.CountPoints(invalid);
    scan.stamp = AddSeconds(files->times[index] - origin, lidar.time_offset);
    const auto outside = [&](const LidarPoint& point) {
      const double range = point.position.norm();
      return range < lidar.min_range || range > lidar.max_range;
    };
    scan.points.erase(std::remove_if(scan.points.begin(), scan.points.end(), outside),
                      scan.points.end());
    return scan;
  }
  return std::nullopt;
}

std::optional<SensorEvent> NextFrame(const Layout& layout, FileList* files, TimeNs origin,
                                     size_t number, const CameraCalibration& camera,
                                     TopicFilter& filter) {
  while (files->next < files->times.size()) {
    const size_t index = files->next++;
    const std::string path = layout.File(layout.Images(number), index, ".png");
    if (!fs::exists(path)) {
      filter.CountDropped("file is missing");
      continue;
    }
    CameraFrame frame;
    frame.time = AddSeconds(files->times[index] - origin, camera.time_offset);
    frame.camera = kCameras[number];
    try {
      frame.image = ReadImage(path);
    } catch (const InputError&) {
      filter.CountDropped("file is damaged");
      continue;
    }
    CheckImageSize(path, frame, camera);
    return frame;
  }
  return std::nullopt;
}

FolderStream ScanStream(const Layout& layout, std::vector<TimeNs> times,
                        const LidarCalibration& lidar, const ReadOptions& options) {
  FolderStream stream{{}, TopicFilter("lidar", CutsOf(options.cuts, lidar.topic, "lidar")), 0, 0};
  const TimeNs origin = times.front();
  stream.last = times.back() - origin;
  stream.filter.Note("no firing times: scans are not deskewed");
  stream.filter.Note(Concatenate("rings told from the order of the points: ", lidar.rings));
  stream.next =
      [layout, lidar, origin, files = std::make_shared<FileList>(FileList{std::move(times), 0})](
          TopicFilter& filter) { return NextScan(layout, files.get(), origin, lidar, filter); };
  return stream;
}

FolderStream FrameStream(const Layout& layout, size_t number, TimeNs origin,
                         const CameraCalibration& camera, const ReadOptions& options) {
  const std::string name = kCameras[number];
  FolderStream stream{{}, TopicFilter(name, CutsOf(options.cuts, camera.topic, name)), 0, 0};
  auto files =
      std::make_shared<FileList>(FileList{ReadTimes(layout.ImageTimes(number), layout.raw), 0});
  if (!files->times.empty()) stream.last = files->times.back() - origin;
  stream.next = [layout, camera, number, origin, files](TopicFilter& filter) {
    return NextFrame(layout, files.get(), origin, number, camera, filter);
  };
  return stream;
}

/// Remarks on the inertial data of a drive.
std::vector<std::string> ImuNotices(const Layout& layout) {
  const std::string path = layout.folder + "/oxts/timestamps.txt";
  if (!layout.raw || !fs::exists(path)) return {};
  const auto times = ReadTimes(path, true);
  if (times.size() < 2 || times.back() <= times.front()) return {};
  const double rate =
      static_cast<double>(times.size() - 1) / SecondsBetween(times.front(), times.back());
  if (rate >= kSlowestImu) return {"oxts: IMU not read: the body of a KITTI drive is its lidar"};
  return {Concatenate("oxts: IMU at ", std::round(rate), " Hz is below ", kSlowestImu,
                      " Hz: not used")};
}

std::vector<TimeNs> RequireScans(const Layout& layout) {
  std::vector<TimeNs> times = ReadTimes(layout.scan_times, layout.raw);
  if (times.empty()) throw InputError(layout.scan_times, "holds no stamps");
  bool packed = false;
  for (const auto& entry : fs::directory_iterator(layout.scans)) {
    if (entry.path().extension() == ".bin") return times;
    packed = packed || entry.path().extension() == ".xz";
  }
  throw InputError(layout.scans, packed ? "holds packed scans; unpack them with `xz -dk *.bin.xz`"
                                        : "holds no .bin files");
}

}  // namespace

bool IsKittiRaw(const std::string& folder) {
  return fs::is_directory(folder + "/velodyne_points/data");
}

bool IsKittiOdometry(const std::string& folder) { return fs::is_directory(folder + "/velodyne"); }

std::vector<std::string> KittiDrives(const std::string& folder) {
  std::vector<std::string> drives;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() && IsKittiRaw(entry.path().string())) {
      drives.push_back(entry.path().string());
    }
  }
  std::sort(drives.begin(), drives.end());
  return drives;
}

void ApplyKittiCalibration(const RecordingIdentity& identity, RigCalibration* rig) {
  const Layout layout = LayoutOf(identity);
  rig->imu.reset();
  ApplyLidar(layout, rig);
  ApplyCameras(layout, rig);
}

std::unique_ptr<SensorSource> OpenKitti(const RecordingIdentity& identity,
                                        const RigCalibration& rig, const ReadOptions& options) {
  CheckCuts(options.cuts, rig);
  const Layout layout = LayoutOf(identity);
  const std::vector<TimeNs> scan_times = RequireScans(layout);
  std::vector<FolderStream> streams;
  if (options.lidar && rig.lidar) {
    streams.push_back(ScanStream(layout, scan_times, *rig.lidar, options));
  }
  for (size_t i = 0; i < kCameras.size(); ++i) {
    const auto camera = rig.cameras.find(kCameras[i]);
    const bool wanted = std::find(options.cameras.begin(), options.cameras.end(), kCameras[i]) !=
                        options.cameras.end();
    if (!wanted || camera == rig.cameras.end()) continue;
    streams.push_back(FrameStream(layout, i, scan_times.front(), camera->second, options));
  }
  return MergeStreams(std::move(streams), 0, ImuNotices(layout));
}

}  // namespace regolith

// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/recording.h"

#include <filesystem>
#include <fstream>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/bag_reader.h"
#include "regolith/io/bag_source.h"
#include "regolith/io/euroc.h"
#include "regolith/io/kitti.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;

std::string IfExists(const std::string& path) { return fs::exists(path) ? path : std::string(); }

bool IsRos2Folder(const std::string& folder) {
  std::ifstream stream(folder + "/metadata.yaml");
  std::string line;
  while (std::getline(stream, line)) {
    if (line.find("rosbag2_bagfile_information") != std::string::npos) return true;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".db3" || extension == ".mcap") return true;
  }
  return false;
}

RecordingIdentity BagIdentity(RecordingFormat format, const std::string& path,
                              const std::string& bag) {
  const fs::path parent = fs::path(bag).parent_path();
  RecordingIdentity identity;
  identity.format = format;
  identity.path = path;
  identity.data_path = bag;
  identity.rig_file = IfExists((parent / "rig.yaml").string());
  identity.truth_file = IfExists((parent / "ground_truth.tum").string());
  return identity;
}

RecordingIdentity FolderIdentity(RecordingFormat format, const std::string& path,
                                 const std::string& data, const std::string& preset) {
  RecordingIdentity identity;
  identity.format = format;
  identity.path = path;
  identity.data_path = data;
  identity.preset_rig = preset;
  for (const std::string& place : {data + "/ground_truth.tum", path + "/ground_truth.tum",
                                   data + "/state_groundtruth_estimate0/groundtruth.tum"}) {
    if (identity.truth_file.empty()) identity.truth_file = IfExists(place);
  }
  return identity;
}

std::vector<std::string> BagsIn(const std::string& folder) {
  std::vector<std::string> bags;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".bag") bags.push_back(entry.path().string());
  }
  return bags;
}

/// The bag in a folder of `simulate`; one that was interrupted is shorter, and as good.
std::string SimulatedBag(const std::string& folder) {
  const std::string whole = IfExists(folder + "/recording.bag");
  return whole.empty() ? IfExists(folder + "/recording.partial.bag") : whole;
}

RecordingIdentity OnlyDrive(const std::string& path, const std::vector<std::string>& drives) {
  if (drives.size() == 1) {
    return FolderIdentity(RecordingFormat::kKittiRaw, path, drives.front(), "kitti");
  }
  std::string names;
  for (const std::string& drive : drives) names += " " + fs::path(drive).filename().string();
  throw InputError(path, "holds more than one drive; name one of:" + names);
}

RecordingIdentity IdentifyFolder(const std::string& path) {
  const std::string simulated = SimulatedBag(path);
  if (!simulated.empty()) return BagIdentity(RecordingFormat::kSimulated, path, simulated);
  if (IsRos2Folder(path)) RefuseRos2(path);
  for (const std::string& folder : {path, path + "/mav0"}) {
    if (IsEuroc(folder)) return FolderIdentity(RecordingFormat::kEuroc, path, folder, "euroc");
  }
  if (IsKittiRaw(path)) return FolderIdentity(RecordingFormat::kKittiRaw, path, path, "kitti");
  if (IsKittiOdometry(path)) {
    for (const char* const file : {"/times.txt", "/calib.txt"}) {
      if (!fs::exists(path + file)) {
        throw InputError(
            path, std::string("has velodyne/ as a KITTI odometry sequence, but no ") + (file + 1));
      }
    }
    return FolderIdentity(RecordingFormat::kKittiOdometry, path, path, "kitti");
  }
  const auto drives = KittiDrives(path);
  if (!drives.empty()) return OnlyDrive(path, drives);
  const auto bags = BagsIn(path);
  if (bags.size() == 1) return BagIdentity(RecordingFormat::kRosBag, path, bags.front());
  throw InputError(path,
                   "holds no recording; expected recording.bag, mav0/ (EuRoC), velodyne_points/ "
                   "(KITTI raw), velodyne/ with times.txt (KITTI odometry) or one .bag");
}

}  // namespace

std::string RecordingFormatName(RecordingFormat format) {
  switch (format) {
    case RecordingFormat::kRosBag:
      return "ROS 1 bag";
    case RecordingFormat::kSimulated:
      return "folder of `regolith simulate`";
    case RecordingFormat::kEuroc:
      return "EuRoC folder";
    case RecordingFormat::kKittiRaw:
      return "KITTI raw drive";
    case RecordingFormat::kKittiOdometry:
      return "KITTI odometry sequence";
  }
  return {};
}

RecordingIdentity IdentifyRecording(const std::string& path_in) {
  // Without the slash that a shell adds, so that names and parents are what they seem.
  const fs::path normal = fs::path(path_in).lexically_normal();
  const std::string path = normal.has_filename() ? normal.string() : normal.parent_path().string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path_in, "no such file or folder");
  try {
    if (fs::is_directory(status)) return IdentifyFolder(path);
  } catch (const fs::filesystem_error& failure) {
    throw InputError(path_in, "cannot be read: " + failure.code().message());
  }
  CheckBagFile(path);
  return BagIdentity(RecordingFormat::kRosBag, path, path);
}

void ApplyFolderCalibration(const RecordingIdentity& identity, RigCalibration* rig) {
  switch (identity.format) {
    case RecordingFormat::kEuroc:
      return ApplyEurocCalibration(identity.data_path, rig);
    case RecordingFormat::kKittiRaw:
    case RecordingFormat::kKittiOdometry:
      return ApplyKittiCalibration(identity, rig);
    case RecordingFormat::kRosBag:
    case RecordingFormat::kSimulated:
      return;
  }
}

std::unique_ptr<SensorSource> OpenRecording(const RecordingIdentity& identity,
                                            const RigCalibration& rig, const ReadOptions& options) {
  switch (identity.format) {
    case RecordingFormat::kEuroc:
      return OpenEuroc(identity.data_path, rig, options);
    case RecordingFormat::kKittiRaw:
    case RecordingFormat::kKittiOdometry:
      return OpenKitti(identity, rig, options);
    case RecordingFormat::kRosBag:
    case RecordingFormat::kSimulated:
      break;
  }
  return OpenBagSource(identity.data_path, rig, options);
}

}  // namespace regolith

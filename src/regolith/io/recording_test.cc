// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/image_file.h"
#include "regolith/io/kitti.h"
#include "regolith/io/test_folder.h"

namespace regolith {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Two rings of a scan as KITTI stores them: the upper one first, counter-clockwise from the front.
std::string KittiBytes(int rings, int points_per_ring) {
  std::string bytes;
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < points_per_ring; ++i) {
      const double azimuth = 2.0 * M_PI * (i + 0.5) / points_per_ring;
      const float values[4] = {static_cast<float>(10.0 * std::cos(azimuth)),
                               static_cast<float>(10.0 * std::sin(azimuth)),
                               static_cast<float>(1.0 - ring), 0.5F};
      bytes.append(reinterpret_cast<const char*>(values), sizeof(values));
    }
  }
  return bytes;
}

void MakeOdometrySequence(const TestFolder& folder) {
  fs::create_directories(folder.Path("velodyne"));
  fs::create_directories(folder.Path("image_0"));
  for (const int i : {0, 1, 3}) {  // scan 2 is missing
    WriteFile(folder.Path("velodyne/00000" + std::to_string(i) + ".bin"), KittiBytes(4, 200));
  }
  WriteFile(folder.Path("velodyne/000004.bin"), "damaged");
  WriteFile(folder.Path("times.txt"), "1.0\n1.1e+00\n1.2\n1.3\n1.4\n");
  WriteFile(folder.Path("calib.txt"),
            "P0: 700 0 600 0 0 700 180 0 0 0 1 0\nP1: 700 0 600 -378 0 700 180 0 0 0 1 0\n"
            "Tr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n");
  for (int i = 0; i < 2; ++i) {
    WritePng(folder.Path("image_0/00000" + std::to_string(i) + ".png"),
             {1242, 376, std::vector<uint8_t>(1242 * 376, 9)});
  }
}

TEST(Recording, ReadsKittiOdometry) {
  const TestFolder folder;
  MakeOdometrySequence(folder);
  const auto identity = IdentifyRecording(folder.path() + "/");
  EXPECT_EQ(identity.format, RecordingFormat::kKittiOdometry);
  EXPECT_EQ(identity.preset_rig, "kitti");
  RigCalibration rig;
  rig.imu.emplace();
  ApplyFolderCalibration(identity, &rig);
  EXPECT_FALSE(rig.imu);
  EXPECT_EQ(rig.lidar->rings, 4);
  ASSERT_EQ(rig.cameras.size(), 1U);
  EXPECT_EQ(rig.cameras.at("left").intrinsics.width, 1242);
  // Camera frame to lidar frame: forward is x of the lidar.
  const Eigen::Vector3d point_lidar =
      rig.cameras.at("left").T_imu_camera * Eigen::Vector3d(0, 0, 5);
  EXPECT_NEAR((point_lidar - Eigen::Vector3d(4.7, 0.1, 0.2)).norm(), 0.0, 1e-9);

  ReadOptions options;
  options.cameras = {"left"};
  const auto source = OpenRecording(identity, rig, options);
  std::vector<TimeNs> scans;
  size_t frames = 0;
  while (const auto event = source->Next()) {
    if (const auto* scan = std::get_if<LidarScan>(&*event)) {
      scans.push_back(scan->stamp);
      EXPECT_FALSE(scan->has_point_times);
      EXPECT_EQ(scan->points.front().ring, 3);
      EXPECT_EQ(scan->points.back().ring, 0);
      EXPECT_EQ(scan->points.size(), 800U);
    } else {
      ++frames;
    }
  }
  EXPECT_EQ(scans, (std::vector<TimeNs>{0, 100000000, 300000000}));
  EXPECT_EQ(frames, 2U);
  EXPECT_EQ(source->end_time(), 400000000);
  EXPECT_THAT(source->Notices(),
              testing::IsSupersetOf({"lidar: 1 message dropped: file is missing",
                                     "lidar: 1 message dropped: file is damaged",
                                     "left: 3 messages dropped: file is missing"}));
}

TEST(Recording, NoiseAboutTheFrontMakesNoRings) {
  const TestFolder folder;
  std::string bytes = KittiBytes(3, 100);
  // The second point of the first ring falls back behind the front.
  const float jitter[2] = {10.0F, -0.01F};
  bytes.replace(16, sizeof(jitter), reinterpret_cast<const char*>(jitter), sizeof(jitter));
  WriteFile(folder.Path("scan.bin"), bytes);
  size_t invalid = 0;
  const LidarScan scan = ReadKittiScan(folder.Path("scan.bin"), 3, &invalid);
  EXPECT_EQ(scan.points.front().ring, 2);
  EXPECT_EQ(scan.points.back().ring, 0);
  EXPECT_EQ(invalid, 0U);
}

TEST(Recording, FoldersThatHoldNoneAreExplained) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.path()); }), HasSubstr("holds no recording"));
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.Path("none")); }), HasSubstr("no such file"));
  WriteFile(folder.Path("metadata.yaml"), "rosbag2_bagfile_information:\n  version: 5\n");
  const std::string command =
      "`rosbags-convert --src " + folder.path() + " --dst " + folder.path() + ".bag`";
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.path()); }), HasSubstr(command));
  WriteFile(folder.Path("a.mcap"), "\x89MCAP0\r\n");
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.Path("a.mcap")); }), HasSubstr(command));
  fs::remove(folder.Path("metadata.yaml"));
  const std::string file = "--src " + folder.Path("a.mcap") + " --dst " + folder.Path("a.bag");
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.Path("a.mcap")); }), HasSubstr(file));
  fs::remove(folder.Path("a.mcap"));
  fs::create_directories(folder.Path("velodyne"));
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.path()); }), HasSubstr("no times.txt"));
  fs::remove(folder.Path("velodyne"));
  for (const char* const drive : {"a_sync", "b_sync"}) {
    fs::create_directories(folder.Path(drive) + "/velodyne_points/data");
  }
  EXPECT_THAT(ErrorOf([&] { IdentifyRecording(folder.path()); }), HasSubstr("a_sync b_sync"));
  const auto identity = IdentifyRecording(folder.Path("a_sync"));
  EXPECT_EQ(identity.format, RecordingFormat::kKittiRaw);
  WriteFile(folder.Path("a_sync/velodyne_points/timestamps.txt"), "2011-09-26 13:04:32.3\n");
  WriteFile(folder.Path("a_sync/velodyne_points/data/0000000000.bin.xz"), "packed");
  RigCalibration rig;
  rig.lidar.emplace();
  EXPECT_THAT(ErrorOf([&] { OpenRecording(identity, rig, {}); }), HasSubstr("xz -dk"));
}

void MakeEuroc(const TestFolder& folder) {
  fs::create_directories(folder.Path("mav0/imu0"));
  fs::create_directories(folder.Path("mav0/cam0/data"));
  WriteFile(folder.Path("mav0/imu0/data.csv"),
            "#timestamp [ns],...\n1000,0,0,0.1,0,0,9.8\n6000,0,0,nan,0,0,9.8\n"
            "6000,0,0,0.1,0,0,9.8\n5000,0,0,0.1,0,0,9.8\n11000,0,0,0.1,0,0,9.8\r\n");
  WriteFile(folder.Path("mav0/cam0/data.csv"), "#timestamp,file\n2000,a.png\n7000,none.png\n");
  WritePng(folder.Path("mav0/cam0/data/a.png"), {4, 2, std::vector<uint8_t>(8, 50)});
  WriteFile(folder.Path("mav0/cam0/sensor.yaml"),
            "sensor_type: camera\nT_BS:\n  data: [0,-1,0,0.1, 1,0,0,0.2, 0,0,1,0.3, 0,0,0,1]\n"
            "rate_hz: 20\nresolution: [4, 2]\nintrinsics: [5, 6, 2, 1]\n"
            "distortion_model: equidistant\ndistortion_coefficients: [0.1, 0.2, 0.3, 0.4]\n");
}

TEST(Recording, ReadsEuroc) {
  const TestFolder folder;
  MakeEuroc(folder);
  RigCalibration rig;
  rig.cameras["right"] = {};
  for (const std::string& path : {folder.path(), folder.Path("mav0")}) {
    const auto identity = IdentifyRecording(path);
    EXPECT_EQ(identity.format, RecordingFormat::kEuroc);
    rig.imu.emplace();
    ApplyFolderCalibration(identity, &rig);
    ASSERT_EQ(rig.cameras.size(), 1U);
    EXPECT_EQ(rig.cameras.at("left").intrinsics.model, CameraModelType::kKannalaBrandt);
    EXPECT_NEAR(rig.cameras.at("left").T_imu_camera.translation.y(), 0.2, 1e-12);
    ReadOptions options;
    options.cameras = {"left"};
    const auto source = OpenRecording(identity, rig, options);
    EXPECT_EQ(source->start_time(), 1000);
    EXPECT_EQ(source->end_time(), 11000);
    std::vector<TimeNs> times;
    while (const auto event = source->Next()) times.push_back(EventTime(*event));
    EXPECT_EQ(times, (std::vector<TimeNs>{1000, 2000, 6000, 11000}));
    EXPECT_THAT(source->Notices(), testing::UnorderedElementsAre(
                                       "imu0: 1 message dropped: stamp not after the previous one",
                                       "imu0: 1 message dropped: values that are not finite",
                                       "cam0: 1 message dropped: image file is missing"));
  }
}

TEST(Recording, BadEurocFilesAreNamed) {
  const TestFolder folder;
  MakeEuroc(folder);
  const auto identity = IdentifyRecording(folder.path());
  RigCalibration rig;
  rig.imu.emplace();
  WriteFile(folder.Path("mav0/cam0/sensor.yaml"), "T_BS: [unclosed\n");
  EXPECT_THAT(ErrorOf([&] { ApplyFolderCalibration(identity, &rig); }),
              HasSubstr("cam0/sensor.yaml"));
  WriteFile(folder.Path("mav0/cam0/sensor.yaml"),
            "T_BS:\n  data: [0,1,0,0.1, 1,0,0,0.2, 0,0,1,0.3, 0,0,0,1]\n");
  EXPECT_THAT(ErrorOf([&] { ApplyFolderCalibration(identity, &rig); }),
              testing::AllOf(HasSubstr("T_BS"), HasSubstr("reflected")));
  WriteFile(folder.Path("mav0/imu0/data.csv"), "1000,0,0\n");
  EXPECT_THAT(ErrorOf([&] { OpenRecording(identity, rig, {})->Next(); }),
              HasSubstr("imu0/data.csv:1: has 3 columns"));
}

TEST(Recording, ReadsRealEuroc) {
  const std::string data = DataFolder() + "/euroc_mh01";
  if (!fs::exists(data)) GTEST_SKIP() << "NO REAL DATA in " << data;
  const auto identity = IdentifyRecording(data);
  EXPECT_FALSE(identity.truth_file.empty());
  RigCalibration rig;
  ApplyFolderCalibration(identity, &rig);
  rig.Check();
  EXPECT_NEAR(rig.imu->noise.gyro_density, 1.6968e-4, 1e-9);
  rig.cameras["left"] = rig.cameras.at("left");
  ReadOptions options;
  options.cameras = {"left"};
  const auto source = OpenRecording(identity, rig, options);
  size_t samples = 0;
  size_t frames = 0;
  while (const auto event = source->Next()) {
    samples += std::holds_alternative<ImuSample>(*event) ? 1 : 0;
    frames += std::holds_alternative<CameraFrame>(*event) ? 1 : 0;
  }
  EXPECT_GT(samples, 2300U);
  EXPECT_GT(frames, 100U);
  EXPECT_TRUE(source->Notices().empty()) << source->Notices().front();
}

/// A copy of the real drive with its first scans unpacked.
bool UnpackDrive(const std::string& target, int scans) {
  const std::string date = DataFolder() + "/kitti_raw/2011_09_26";
  const std::string drive = "/2011_09_26_drive_0005_sync";
  if (!fs::exists(date)) return false;
  fs::create_directories(target + drive + "/velodyne_points/data");
  for (const auto& entry : fs::directory_iterator(date)) {
    if (entry.is_regular_file()) fs::create_symlink(entry.path(), target / entry.path().filename());
  }
  for (const char* const part : {"/image_00", "/oxts", "/velodyne_points/timestamps.txt"}) {
    fs::create_symlink(fs::canonical(date + drive + part), target + drive + part);
  }
  for (int i = 0; i < scans; ++i) {
    char name[64];
    std::snprintf(name, sizeof(name), "/velodyne_points/data/%010d.bin", i);
    const std::string command =
        "xz -dc '" + date + drive + name + ".xz' > '" + target + drive + name + "'";
    if (std::system(command.c_str()) != 0) return false;
  }
  return true;
}

TEST(Recording, ReadsRealKittiDrive) {
  const TestFolder folder;
  if (!UnpackDrive(folder.path(), 5)) GTEST_SKIP() << "NO REAL DATA in " << DataFolder();
  const auto identity = IdentifyRecording(folder.path());  // the folder of the date
  EXPECT_EQ(identity.format, RecordingFormat::kKittiRaw);
  RigCalibration rig;
  ApplyFolderCalibration(identity, &rig);
  EXPECT_EQ(rig.lidar->rings, 16);
  EXPECT_NEAR(rig.lidar->highest_elevation_deg, 1.8, 0.2);
  EXPECT_NEAR(rig.lidar->lowest_elevation_deg, -23.2, 0.3);
  ASSERT_EQ(rig.cameras.size(), 1U);
  const Eigen::Vector3d forward =
      rig.cameras.at("left").T_imu_camera.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_GT(forward.x(), 0.999);
  ReadOptions options;
  options.cameras = {"left"};
  const auto source = OpenRecording(identity, rig, options);
  std::vector<LidarScan> scans;
  size_t frames = 0;
  for (auto event = source->Next(); event && scans.size() < 5; event = source->Next()) {
    if (auto* scan = std::get_if<LidarScan>(&*event))
      scans.push_back(std::move(*scan));
    else
      ++frames;
  }
  ASSERT_EQ(scans.size(), 5U);
  EXPECT_EQ(scans[0].stamp, 0);
  EXPECT_EQ(scans[1].stamp, 103287866);
  EXPECT_GE(frames, 3U);
  for (const LidarScan& scan : scans) {
    std::set<uint16_t> rings;
    for (const LidarPoint& point : scan.points) rings.insert(point.ring);
    EXPECT_EQ(rings.size(), 16U);
  }
  EXPECT_THAT(source->Notices(), testing::Contains(HasSubstr("IMU at 10 Hz is below 50 Hz")));
}

}  // namespace
}  // namespace regolith

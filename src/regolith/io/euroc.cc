// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/euroc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/folder_source.h"
#include "regolith/io/image_file.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;

struct CameraFolder {
  const char* folder;
  const char* camera;
};
constexpr std::array<CameraFolder, 2> kCameras = {{{"cam0", "left"}, {"cam1", "right"}}};

/// The stamp that begins a line; throws InputError.
TimeNs ParseStamp(std::string_view field, const std::string& place) {
  const auto stamp = ParseInteger(field);
  if (!stamp) {
    throw InputError(place, "stamp '" + std::string(field) + "'; expected nanoseconds");
  }
  return *stamp;
}

std::optional<TimeNs> FirstStamp(const std::string& path) {
  LineReader reader(path);
  std::string line;
  if (!reader.Next(&line)) return std::nullopt;
  return ParseStamp(SplitAt(line, ',').front(), reader.Place());
}

/// Of the last whole line; read from the end, so that a long file costs nothing.
std::optional<TimeNs> LastStamp(const std::string& path) {
  constexpr std::streamoff kTail = 4096;
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  stream.seekg(std::max<std::streamoff>(0, size - kTail));
  std::optional<TimeNs> last;
  for (std::string line; std::getline(stream, line);) {
    const auto fields = SplitAt(line, ',');
    if (fields.size() < 2) continue;
    // The first line of the tail may be cut; a stamp without its first digits is earlier.
    if (const auto stamp = ParseInteger(fields[0])) last = std::max(last.value_or(*stamp), *stamp);
  }
  return last;
}

std::optional<SensorEvent> NextImu(LineReader* reader, TopicFilter& filter) {
  for (std::string line; reader->Next(&line);) {
    const auto fields = SplitAt(line, ',');
    if (fields.size() != 7) {
      throw InputError(reader->Place(), Concatenate("has ", fields.size(),
                                                    " columns; expected 7: stamp, gyro x y z, "
                                                    "accelerometer x y z"));
    }
    ImuSample sample;
    sample.time = ParseStamp(fields[0], reader->Place());
    std::array<double, 6> values{};
    for (size_t i = 0; i < 6; ++i) {
      values[i] = ParseNumber(fields[i + 1]).value_or(std::numeric_limits<double>::quiet_NaN());
    }
    sample.angular_velocity = {values[0], values[1], values[2]};
    sample.specific_force = {values[3], values[4], values[5]};
    if (sample.angular_velocity.allFinite() && sample.specific_force.allFinite()) return sample;
    filter.CountDropped("values that are not finite");
  }
  return std::nullopt;
}

std::optional<SensorEvent> NextFrame(LineReader* reader, const std::string& folder,
                                     const std::string& name, const CameraCalibration& camera,
                                     TopicFilter& filter) {
  for (std::string line; reader->Next(&line);) {
    const auto fields = SplitAt(line, ',');
    if (fields.size() != 2) {
      throw InputError(reader->Place(),
                       Concatenate("has ", fields.size(), " columns; expected stamp, file"));
    }
    const TimeNs stamp = ParseStamp(fields[0], reader->Place());
    const std::string path = folder + "/data/" + std::string(fields[1]);
    if (!fs::exists(path)) {
      filter.CountDropped("image file is missing");
      continue;
    }
    CameraFrame frame;
    frame.time = AddSeconds(stamp, camera.time_offset);
    frame.camera = name;
    try {
      frame.image = ReadImage(path);
    } catch (const InputError&) {
      filter.CountDropped("image file is damaged");
      continue;
    }
    CheckImageSize(path, frame, camera);
    return frame;
  }
  return std::nullopt;
}

FolderStream MakeStream(const std::string& path, const std::string& name,
                        std::vector<TopicCut> cuts,
                        std::function<std::optional<SensorEvent>(LineReader*, TopicFilter&)> next) {
  FolderStream stream{{}, TopicFilter(name, std::move(cuts)), 0, 0};
  stream.first = FirstStamp(path).value_or(0);
  stream.last = LastStamp(path).value_or(stream.first);
  stream.next = [reader = std::make_shared<LineReader>(path), next = std::move(next)](
                    TopicFilter& filter) { return next(reader.get(), filter); };
  return stream;
}

std::string RequireData(const std::string& folder, const std::string& sensor) {
  std::string path = folder + "/" + sensor + "/data.csv";
  if (!fs::exists(path)) {
    throw InputError(path, "no such file; expected the EuRoC layout with " + sensor + "/data.csv");
  }
  return path;
}

void ApplyImu(const YAML::Node& node, RigCalibration* rig) {
  if (!rig->imu) rig->imu.emplace();
  const auto read = [&](const char* key, double* value) {
    if (node[key]) *value = node[key].as<double>();
  };
  read("rate_hz", &rig->imu->rate);
  read("gyroscope_noise_density", &rig->imu->noise.gyro_density);
  read("gyroscope_random_walk", &rig->imu->noise.gyro_walk);
  read("accelerometer_noise_density", &rig->imu->noise.accelerometer_density);
  read("accelerometer_random_walk", &rig->imu->noise.accelerometer_walk);
}

SE3 ReadPose(const YAML::Node& node, const std::string& path) {
  const auto values = node["T_BS"]["data"].as<std::vector<double>>();
  if (values.size() != 16) {
    throw InputError(path, Concatenate("T_BS has ", values.size(), " numbers; expected 16"));
  }
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  try {
    return TransformFromMatrix(matrix);
  } catch (const InputError& error) {
    throw InputError(path, std::string("T_BS ") + error.what());
  }
}

/// The camera's part but its pose.
void ApplyCamera(const YAML::Node& node, const std::string& path, CameraCalibration* camera) {
  if (node["rate_hz"]) camera->rate = node["rate_hz"].as<double>();
  if (!node["intrinsics"] || !node["resolution"]) return;
  const auto resolution = node["resolution"].as<std::vector<int>>();
  const auto values = node["intrinsics"].as<std::vector<double>>();
  const auto distortion = node["distortion_coefficients"].as<std::vector<double>>();
  if (resolution.size() != 2 || values.size() != 4 || distortion.size() < 4) {
    throw InputError(path, "expected 2 numbers of resolution, 4 of intrinsics, 4 of distortion");
  }
  CameraIntrinsics& intrinsics = camera->intrinsics;
  const std::string model = node["distortion_model"].as<std::string>("radial-tangential");
  if (model == "equidistant") {
    intrinsics.model = CameraModelType::kKannalaBrandt;
  } else if (model == "radial-tangential" || model == "radtan") {
    intrinsics.model = CameraModelType::kPinhole;
  } else {
    throw InputError(path,
                     "distortion_model '" + model + "'; expected radial-tangential or equidistant");
  }
  intrinsics.width = resolution[0];
  intrinsics.height = resolution[1];
  intrinsics.focal = {values[0], values[1]};
  intrinsics.principal_point = {values[2], values[3]};
  std::copy_n(distortion.begin(), 4, intrinsics.distortion.begin());
}

}  // namespace

bool IsEuroc(const std::string& folder) {
  return fs::exists(folder + "/imu0/data.csv") || fs::exists(folder + "/cam0/data.csv");
}

void ApplyEurocCalibration(const std::string& folder, RigCalibration* rig) {
  SE3 T_body_imu;
  std::string path = folder + "/imu0/sensor.yaml";
  try {
    if (fs::exists(path)) {
      const YAML::Node node = YAML::LoadFile(path);
      ApplyImu(node, rig);
      if (node["T_BS"]) T_body_imu = ReadPose(node, path);
    }
    for (const auto& [sensor, name] : kCameras) {
      if (!fs::exists(folder + "/" + sensor + "/data.csv")) {
        rig->cameras.erase(name);
        continue;
      }
      path = folder + "/" + sensor + "/sensor.yaml";
      if (!fs::exists(path)) continue;
      const YAML::Node node = YAML::LoadFile(path);
      CameraCalibration& camera = rig->cameras[name];
      ApplyCamera(node, path, &camera);
      if (node["T_BS"]) camera.T_imu_camera = T_body_imu.Inverse() * ReadPose(node, path);
    }
  } catch (const YAML::Exception& error) {
    throw InputError(path, Concatenate("line ", error.mark.line + 1, ": ", error.msg));
  }
}

std::unique_ptr<SensorSource> OpenEuroc(const std::string& folder, const RigCalibration& rig,
                                        const ReadOptions& options) {
  CheckCuts(options.cuts, rig);
  std::vector<FolderStream> streams;
  if (options.imu && rig.imu) {
    streams.push_back(MakeStream(RequireData(folder, "imu0"), "imu0",
                                 CutsOf(options.cuts, rig.imu->topic, "imu"), NextImu));
  }
  for (const auto& [sensor, name] : kCameras) {
    const auto camera = rig.cameras.find(name);
    const bool wanted =
        std::find(options.cameras.begin(), options.cameras.end(), name) != options.cameras.end();
    if (!wanted || camera == rig.cameras.end()) continue;
    const auto next = [images = folder + "/" + sensor, camera_name = std::string(name),
                       calibration = camera->second](LineReader* reader, TopicFilter& filter) {
      return NextFrame(reader, images, camera_name, calibration, filter);
    };
    streams.push_back(MakeStream(RequireData(folder, sensor), sensor,
                                 CutsOf(options.cuts, camera->second.topic, name), next));
  }
  // Of all sensors in the folder, read or not, so that cuts do not move with what is read.
  TimeNs start = std::numeric_limits<TimeNs>::max();
  for (const char* const sensor : {"imu0", "cam0", "cam1"}) {
    const std::string path = folder + "/" + sensor + "/data.csv";
    if (!fs::exists(path)) continue;
    if (const auto stamp = FirstStamp(path)) start = std::min(start, *stamp);
  }
  if (start == std::numeric_limits<TimeNs>::max()) {
    throw InputError(folder, "holds no measurements: imu0/data.csv and cam0/data.csv are empty");
  }
  return MergeStreams(std::move(streams), start, {});
}

}  // namespace regolith

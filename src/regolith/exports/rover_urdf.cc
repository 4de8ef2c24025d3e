// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/rover_urdf.h"

#include <cmath>
#include <functional>
#include <map>

#include "regolith/exports/xml_writer.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr double kWheelRadius = 0.15;    // m
constexpr double kWheelWidth = 0.12;     // m
constexpr double kWheelMass = 2.5;       // kg
constexpr double kChassisMass = 35.0;    // kg
constexpr double kChassisHeight = 0.32;  // m, of its middle above the ground
constexpr double kMastMass = 3.0;        // kg
constexpr double kMastWidth = 0.06;      // m
constexpr double kHeadMass = 0.3;        // kg, of a sensor's housing
constexpr double kWheelTorque = 20.0;    // N m
const Eigen::Vector3d kChassisSize(0.9, 0.5, 0.2);
const Eigen::Vector3d kHeadSize(0.06, 0.06, 0.06);

using Values = std::map<std::string, std::string>;

// The value of a property in the text: itself in the URDF, ${name} in the xacro.
class Text {
 public:
  Text(Values values, bool symbolic) : values_(std::move(values)), symbolic_(symbolic) {}
  std::string operator()(const std::string& name) const {
    return symbolic_ ? "${" + name + "}" : values_.at(name);
  }

 private:
  Values values_;
  bool symbolic_;
};

// One definition of a macro serves both files: symbolically once as the macro's body, and with
// numbers at each call.
struct Macro {
  std::string name;
  std::vector<std::string> parameters;
  std::function<void(const Text&, XmlWriter*)> body;
};

class Robot {
 public:
  Robot(Values properties, bool xacro) : properties_(std::move(properties)), xacro_(xacro) {
    XmlWriter::Attributes attributes = {{"name", "regolith_rover"}};
    if (xacro) attributes.emplace_back("xmlns:xacro", "http://www.ros.org/wiki/xacro");
    xml_.Open("robot", attributes);
    if (!xacro) return;
    for (const auto& [name, value] : properties_) {
      xml_.Empty("xacro:property", {{"name", name}, {"value", value}});
    }
  }

  void Define(const Macro& macro) {
    if (!xacro_) return;
    std::string parameters;
    for (const std::string& name : macro.parameters) {
      parameters += (parameters.empty() ? "" : " ") + name;
    }
    xml_.Open("xacro:macro", {{"name", macro.name}, {"params", parameters}});
    macro.body(Text({}, true), &xml_);
    xml_.Close();
  }

  void Call(const Macro& macro, const std::vector<std::string>& arguments) {
    Values values = properties_;
    XmlWriter::Attributes attributes;
    for (size_t i = 0; i < macro.parameters.size(); ++i) {
      values[macro.parameters[i]] = arguments.at(i);
      attributes.emplace_back(macro.parameters[i], arguments.at(i));
    }
    if (xacro_) {
      xml_.Empty("xacro:" + macro.name, attributes);
    } else {
      macro.body(Text(values, false), &xml_);
    }
  }

  void Part(const std::function<void(const Text&, XmlWriter*)>& body) {
    body(Text(properties_, xacro_), &xml_);
  }

  std::string Finish() {
    xml_.Close();
    return xml_.Text();
  }

 private:
  Values properties_;
  bool xacro_;
  XmlWriter xml_;
};

void AddInertial(const Inertia& inertia, XmlWriter* xml) {
  xml->Open("inertial");
  xml->Empty("mass", {{"value", Number(inertia.mass)}});
  xml->Empty("inertia", {{"ixx", Number(inertia.moments.x())},
                         {"ixy", "0"},
                         {"ixz", "0"},
                         {"iyy", Number(inertia.moments.y())},
                         {"iyz", "0"},
                         {"izz", Number(inertia.moments.z())}});
  xml->Close();
}

void AddBoxLink(const std::string& name, const std::string& size, const Inertia& inertia,
                const std::string& colour, bool collides, XmlWriter* xml) {
  xml->Open("link", {{"name", name}});
  AddInertial(inertia, xml);
  for (const char* const kind : {"visual", "collision"}) {
    const bool visual = kind[0] == 'v';
    if (!visual && !collides) continue;
    xml->Open(kind);
    xml->Open("geometry");
    xml->Empty("box", {{"size", size}});
    xml->Close();
    if (visual) {
      xml->Open("material", {{"name", name + "_colour"}});
      xml->Empty("color", {{"rgba", colour}});
      xml->Close();
    }
    xml->Close();
  }
  xml->Close();
}

void AddFixedJoint(const std::string& parent, const std::string& child, const std::string& xyz,
                   const std::string& rpy, XmlWriter* xml) {
  xml->Open("joint", {{"name", child + "_joint"}, {"type", "fixed"}});
  xml->Empty("parent", {{"link", parent}});
  xml->Empty("child", {{"link", child}});
  xml->Empty("origin", {{"xyz", xyz}, {"rpy", rpy}});
  xml->Close();
}

std::string Xyz(const Eigen::Vector3d& vector) {
  return Numbers({vector.x(), vector.y(), vector.z()});
}

Macro WheelMacro() {
  return {"wheel", {"name", "x", "y"}, [](const Text& text, XmlWriter* xml) {
            const std::string link = text("name") + "_wheel";
            xml->Open("link", {{"name", link}});
            AddInertial(WheelInertia(kWheelMass, kWheelRadius, kWheelWidth), xml);
            for (const char* const kind : {"visual", "collision"}) {
              xml->Open(kind);
              xml->Empty("origin", {{"xyz", "0 0 0"}, {"rpy", "1.57079633 0 0"}});
              xml->Open("geometry");
              xml->Empty("cylinder",
                         {{"radius", text("wheel_radius")}, {"length", text("wheel_width")}});
              xml->Close();
              xml->Close();
            }
            xml->Close();
            xml->Open("joint", {{"name", link + "_joint"}, {"type", "continuous"}});
            xml->Empty("parent", {{"link", "base"}});
            xml->Empty("child", {{"link", link}});
            xml->Empty("origin", {{"xyz", text("x") + " " + text("y") + " " + text("wheel_radius")},
                                  {"rpy", "0 0 0"}});
            xml->Empty("axis", {{"xyz", "0 1 0"}});
            xml->Empty("limit", {{"effort", text("wheel_torque")}, {"velocity", "20"}});
            xml->Empty("dynamics", {{"damping", "0.1"}, {"friction", "0.1"}});
            xml->Close();
            // Effort, not velocity: an unused velocity interface would brake the wheels against the
            // differential drive.
            xml->Open("transmission", {{"name", text("name") + "_transmission"}});
            xml->Leaf("type", "transmission_interface/SimpleTransmission");
            xml->Open("joint", {{"name", link + "_joint"}});
            xml->Leaf("hardwareInterface", "hardware_interface/EffortJointInterface");
            xml->Close();
            xml->Open("actuator", {{"name", text("name") + "_motor"}});
            xml->Leaf("hardwareInterface", "hardware_interface/EffortJointInterface");
            xml->Leaf("mechanicalReduction", "1");
            xml->Close();
            xml->Close();
            xml->Open("gazebo", {{"reference", link}});
            xml->Leaf("mu1", "0.7");
            xml->Leaf("mu2", "0.7");
            xml->Leaf("material", "Gazebo/DarkGrey");
            xml->Close();
          }};
}

// A housing that looks along x, and in it the frame of its images, which looks along z.
Macro HeadMacro() {
  return {"camera_head", {"name", "y", "z"}, [](const Text& text, XmlWriter* xml) {
            const std::string head = text("name") + "_head";
            AddBoxLink(head, Xyz(kHeadSize), BoxInertia(kHeadMass, kHeadSize), "0.1 0.1 0.1 1",
                       false, xml);
            AddFixedJoint("mast", head, text("camera_x") + " " + text("y") + " " + text("z"),
                          "0 " + text("camera_pitch") + " 0", xml);
            xml->Open("link", {{"name", text("name")}});
            xml->Close();
            AddFixedJoint(head, text("name"), "0 0 0", "-1.57079633 0 -1.57079633", xml);
          }};
}

// Gazebo's lens has no offset of the principal point and four of Brown's coefficients.
void AddLens(const Text& text, const CameraOptions& camera, const std::string& format,
             XmlWriter* xml) {
  xml->Leaf("horizontal_fov", text("camera_fov"));
  xml->Open("image");
  xml->Leaf("width", text("camera_width"));
  xml->Leaf("height", text("camera_height"));
  xml->Leaf("format", format);
  xml->Close();
  xml->Open("clip");
  xml->Leaf("near", "0.05");
  xml->Leaf("far", "300");
  xml->Close();
  xml->Open("noise");
  xml->Leaf("type", "gaussian");
  xml->Leaf("mean", "0");
  xml->Leaf("stddev", text("camera_noise"));
  xml->Close();
  xml->Open("distortion");
  const std::vector<std::string> names = {"k1", "k2", "p1", "p2"};
  for (size_t i = 0; i < 2; ++i) xml->Leaf(names[i], Number(camera.distortion[i]));
  xml->Leaf("k3", "0");
  for (size_t i = 2; i < 4; ++i) xml->Leaf(names[i], Number(camera.distortion[i]));
  xml->Leaf("center", "0.5 0.5");
  xml->Close();
}

void OpenSensor(const std::string& link, const std::string& type, const std::string& name,
                const std::string& rate, XmlWriter* xml) {
  xml->Open("gazebo", {{"reference", link}});
  xml->Open("sensor", {{"type", type}, {"name", name}});
  xml->Leaf("always_on", "true");
  xml->Leaf("update_rate", rate);
}

void OpenPlugin(const std::string& name, const std::string& file, XmlWriter* xml) {
  xml->Open("plugin", {{"name", name}, {"filename", file}});
}

void AddCameraPlugin(const Text& text, const std::string& file, const std::string& camera,
                     const std::string& frame, const XmlWriter::Attributes& more, XmlWriter* xml) {
  OpenPlugin(frame + "_controller", file, xml);
  xml->Leaf("alwaysOn", "true");
  xml->Leaf("updateRate", text("camera_rate"));
  xml->Leaf("cameraName", camera);
  xml->Leaf("imageTopicName", "image_raw");
  xml->Leaf("cameraInfoTopicName", "camera_info");
  xml->Leaf("frameName", frame);
  xml->Leaf("borderCrop", "false");
  for (const auto& [name, value] : more) xml->Leaf(name, value);
  xml->Close();
}

void AddMonoCamera(const Text& text, const CameraOptions& camera, XmlWriter* xml) {
  OpenSensor("mono_head", "camera", "mono_camera", text("camera_rate"), xml);
  xml->Open("camera", {{"name", "mono"}});
  AddLens(text, camera, "L8", xml);
  xml->Close();
  AddCameraPlugin(text, "libgazebo_ros_camera.so", "camera/mono", "mono", {}, xml);
  xml->Close();
  xml->Close();
}

void AddStereoCamera(const Text& text, const CameraOptions& camera, XmlWriter* xml) {
  OpenSensor("left_head", "multicamera", "stereo_camera", text("camera_rate"), xml);
  xml->Open("camera", {{"name", "left"}});
  AddLens(text, camera, "L8", xml);
  xml->Close();
  xml->Open("camera", {{"name", "right"}});
  xml->Leaf("pose", "0 " + Number(-camera.baseline) + " 0 0 0 0");
  AddLens(text, camera, "L8", xml);
  xml->Close();
  AddCameraPlugin(text, "libgazebo_ros_multicamera.so", "camera", "left",
                  {{"hackBaseline", Number(camera.baseline)}}, xml);
  xml->Close();
  xml->Close();
}

void AddDepthCamera(const Text& text, const CameraOptions& camera, XmlWriter* xml) {
  OpenSensor("depth_head", "depth", "depth_camera", text("camera_rate"), xml);
  xml->Open("camera", {{"name", "depth"}});
  AddLens(text, camera, "R8G8B8", xml);
  xml->Close();
  AddCameraPlugin(text, "libgazebo_ros_depth_camera.so", "camera/depth", "depth",
                  {{"depthImageTopicName", "depth/image_raw"},
                   {"depthImageCameraInfoTopicName", "depth/camera_info"},
                   {"pointCloudTopicName", "points"},
                   {"pointCloudCutoff", "0.4"},
                   {"pointCloudCutoffMax", "20"}},
                  xml);
  xml->Close();
  xml->Close();
}

struct ScanLines {
  std::string samples;
  double low = 0.0;   // rad
  double high = 0.0;  // rad
};

void AddScanLines(const std::string& name, const ScanLines& lines, XmlWriter* xml) {
  xml->Open(name);
  xml->Leaf("samples", lines.samples);
  xml->Leaf("resolution", "1");
  xml->Leaf("min_angle", Number(lines.low));
  xml->Leaf("max_angle", Number(lines.high));
  xml->Close();
}

void AddRays(const Text& text, const LidarOptions& lidar, bool all_rings, XmlWriter* xml) {
  constexpr double kDegree = M_PI / 180.0;
  xml->Open("ray");
  xml->Open("scan");
  // The last firing of a turn is not the first one again.
  const double last = M_PI - 2.0 * M_PI / lidar.firings;
  AddScanLines("horizontal", {text("lidar_firings"), -M_PI, last}, xml);
  if (all_rings) {
    AddScanLines("vertical",
                 {text("lidar_rings"), lidar.lowest_deg * kDegree, lidar.highest_deg * kDegree},
                 xml);
  }
  xml->Close();
  xml->Open("range");
  xml->Leaf("min", text("lidar_min_range"));
  xml->Leaf("max", text("lidar_max_range"));
  xml->Leaf("resolution", "0.001");
  xml->Close();
  xml->Open("noise");
  xml->Leaf("type", "gaussian");
  xml->Leaf("mean", "0");
  // The plugin of the 16 lines adds its own noise.
  xml->Leaf("stddev", all_rings ? "0" : text("lidar_noise"));
  xml->Close();
  xml->Close();
}

void AddLidar(const Text& text, const LidarOptions& lidar, XmlWriter* xml) {
  OpenSensor("lidar", "ray", "lidar_16", text("lidar_rate"), xml);
  AddRays(text, lidar, true, xml);
  OpenPlugin("lidar_16_controller", "libgazebo_ros_velodyne_laser.so", xml);
  xml->Leaf("topicName", "/velodyne_points");
  xml->Leaf("frameName", "lidar");
  xml->Leaf("organize_cloud", "false");
  xml->Leaf("min_range", text("lidar_min_range"));
  xml->Leaf("max_range", text("lidar_max_range"));
  xml->Leaf("gaussianNoise", text("lidar_noise"));
  xml->Close();
  xml->Close();
  xml->Close();

  OpenSensor("lidar", "ray", "laser", text("lidar_rate"), xml);
  AddRays(text, lidar, false, xml);
  OpenPlugin("laser_controller", "libgazebo_ros_laser.so", xml);
  xml->Leaf("topicName", "/scan");
  xml->Leaf("frameName", "lidar");
  xml->Close();
  xml->Close();
  xml->Close();
}

void AddImu(const Text& text, XmlWriter* xml) {
  // Gazebo merges fixed links into one; the sensor's plugins look for this one by its name.
  xml->Open("gazebo", {{"reference", "imu_joint"}});
  xml->Leaf("preserveFixedJoint", "true");
  xml->Close();
  OpenSensor("imu", "imu", "imu_sensor", text("imu_rate"), xml);
  OpenPlugin("imu_sensor_controller", "libgazebo_ros_imu_sensor.so", xml);
  xml->Leaf("topicName", "/imu/data");
  xml->Leaf("bodyName", "imu");
  xml->Leaf("frameName", "imu");
  xml->Leaf("updateRateHZ", text("imu_rate"));
  xml->Leaf("gaussianNoise", text("accelerometer_noise"));
  xml->Leaf("xyzOffset", "0 0 0");
  xml->Leaf("rpyOffset", "0 0 0");
  xml->Close();
  xml->Close();
  xml->Close();
  xml->Open("gazebo");
  OpenPlugin("imu_controller", "libgazebo_ros_imu.so", xml);
  xml->Leaf("alwaysOn", "true");
  xml->Leaf("bodyName", "imu");
  xml->Leaf("frameId", "imu");
  xml->Leaf("topicName", "/imu/motion");
  xml->Leaf("serviceName", "/imu/service");
  xml->Leaf("updateRate", text("imu_rate"));
  xml->Leaf("gaussianNoise", text("gyro_noise"));
  xml->Leaf("xyzOffset", "0 0 0");
  xml->Leaf("rpyOffset", "0 0 0");
  xml->Close();
  xml->Close();
}

// The plugin drives one pair of wheels, so each pair has one; the front one's odometry counts.
Macro DriveMacro() {
  return {"drive", {"pair", "topic", "publishes"}, [](const Text& text, XmlWriter* xml) {
            xml->Open("gazebo");
            OpenPlugin(text("pair") + "_drive", "libgazebo_ros_diff_drive.so", xml);
            xml->Leaf("alwaysOn", "true");
            xml->Leaf("updateRate", text("odometry_rate"));
            xml->Leaf("leftJoint", text("pair") + "_left_wheel_joint");
            xml->Leaf("rightJoint", text("pair") + "_right_wheel_joint");
            xml->Leaf("wheelSeparation", text("track"));
            xml->Leaf("wheelDiameter", text("wheel_diameter"));
            xml->Leaf("wheelAcceleration", "0");
            xml->Leaf("wheelTorque", text("wheel_torque"));
            xml->Leaf("commandTopic", "cmd_vel");
            xml->Leaf("odometryTopic", text("topic"));
            xml->Leaf("odometryFrame", "odom");
            xml->Leaf("odometrySource", "encoder");
            xml->Leaf("robotBaseFrame", "base");
            xml->Leaf("publishOdomTF", text("publishes"));
            xml->Leaf("publishWheelTF", "false");
            xml->Leaf("publishWheelJointState", "false");
            xml->Leaf("legacyMode", "false");
            xml->Close();
            xml->Close();
          }};
}

void AddModelPlugins(XmlWriter* xml) {
  xml->Open("gazebo");
  OpenPlugin("control", "libgazebo_ros_control.so", xml);
  xml->Leaf("robotNamespace", "/");
  xml->Leaf("robotSimType", "gazebo_ros_control/DefaultRobotHWSim");
  xml->Close();
  OpenPlugin("ground_truth", "libgazebo_ros_p3d.so", xml);
  xml->Leaf("alwaysOn", "true");
  xml->Leaf("updateRate", "100");
  xml->Leaf("bodyName", "imu");
  xml->Leaf("topicName", "/ground_truth/odometry");
  xml->Leaf("gaussianNoise", "0");
  xml->Leaf("frameName", "world");
  xml->Close();
  xml->Close();
}

Values Properties(const ScenarioOptions& options) {
  const CameraOptions& camera = options.camera;
  const CameraIntrinsics intrinsics = MakeIntrinsics(camera);
  const double fov = 2.0 * std::atan(0.5 * intrinsics.width / intrinsics.focal.x());
  const double imu_root = std::sqrt(options.imu.rate);
  return {
      {"wheel_radius", Number(kWheelRadius)},
      {"wheel_diameter", Number(2.0 * kWheelRadius)},
      {"wheel_width", Number(kWheelWidth)},
      {"wheel_torque", Number(kWheelTorque)},
      {"track", Number(2.0 * kHalfTrack)},
      {"odometry_rate", Number(options.wheels.rate)},
      {"camera_x", Number(BaseFromCamera(camera, "mono").translation.x() -
                          BaseFromLidar(options.lidar).translation.x())},
      {"camera_pitch", Number(camera.pitch_deg * M_PI / 180.0)},
      {"camera_fov", Number(fov)},
      {"camera_width", Number(camera.width)},
      {"camera_height", Number(camera.height)},
      {"camera_rate", Number(camera.rate)},
      // Of full scale: read noise, and the shot noise of a half full well.
      {"camera_noise",
       Number(std::hypot(camera.read_noise, std::sqrt(0.5 * camera.full_well)) / camera.full_well)},
      {"lidar_rings", Number(options.lidar.rings)},
      {"lidar_firings", Number(options.lidar.firings)},
      {"lidar_rate", Number(options.lidar.rate)},
      {"lidar_min_range", Number(options.lidar.min_range)},
      {"lidar_max_range", Number(options.lidar.max_range)},
      {"lidar_noise", Number(options.lidar.range_sigma)},
      {"imu_rate", Number(options.imu.rate)},
      // Gazebo's noise is of a sample, ours a density.
      {"accelerometer_noise", Number(options.imu.noise.accelerometer_density * imu_root)},
      {"gyro_noise", Number(options.imu.noise.gyro_density * imu_root)},
  };
}

void AddBody(const ScenarioOptions& options, XmlWriter* xml) {
  const Eigen::Vector3d lidar = BaseFromLidar(options.lidar).translation;
  const Eigen::Vector3d imu = BaseFromImu().translation;
  // `base` lies on the ground between the wheels and is no body.
  xml->Open("link", {{"name", "base"}});
  xml->Close();
  AddBoxLink("chassis", Xyz(kChassisSize), BoxInertia(kChassisMass, kChassisSize), "0.8 0.75 0.6 1",
             true, xml);
  AddFixedJoint("base", "chassis", Xyz({0.0, 0.0, kChassisHeight}), "0 0 0", xml);
  const double deck = kChassisHeight + 0.5 * kChassisSize.z();
  const Eigen::Vector3d mast(kMastWidth, kMastWidth, std::max(lidar.z() - 0.05 - deck, 0.05));
  // The mast's link lies below the lidar on the ground's level, so that places on it are heights.
  xml->Open("link", {{"name", "mast"}});
  xml->Close();
  AddFixedJoint("base", "mast", Xyz({lidar.x(), lidar.y(), 0.0}), "0 0 0", xml);
  AddBoxLink("mast_pole", Xyz(mast), BoxInertia(kMastMass, mast), "0.6 0.6 0.6 1", true, xml);
  AddFixedJoint("mast", "mast_pole", Xyz({0.0, 0.0, deck + 0.5 * mast.z()}), "0 0 0", xml);
  AddBoxLink("lidar", Xyz(kHeadSize), BoxInertia(kHeadMass, kHeadSize), "0.1 0.1 0.1 1", false,
             xml);
  AddFixedJoint("mast", "lidar", Xyz({0.0, 0.0, lidar.z()}), "0 0 0", xml);
  AddBoxLink("imu", Xyz(kHeadSize), BoxInertia(kHeadMass, kHeadSize), "0.2 0.2 0.6 1", false, xml);
  AddFixedJoint("base", "imu", Xyz(imu), "0 0 0", xml);
}

std::string WriteRobot(const ScenarioOptions& options, bool xacro) {
  Robot robot(Properties(options), xacro);
  const Macro wheel = WheelMacro();
  const Macro head = HeadMacro();
  const Macro drive = DriveMacro();
  for (const Macro* macro : {&wheel, &head, &drive}) robot.Define(*macro);
  robot.Part([&](const Text&, XmlWriter* xml) { AddBody(options, xml); });
  for (const char* const end : {"front", "rear"}) {
    for (const char* const side : {"left", "right"}) {
      robot.Call(wheel, {std::string(end) + "_" + side,
                         Number(end[0] == 'f' ? kHalfWheelbase : -kHalfWheelbase),
                         Number(side[0] == 'l' ? kHalfTrack : -kHalfTrack)});
    }
  }
  for (const std::string& name : CameraNames(options.camera)) {
    const Eigen::Vector3d place = BaseFromCamera(options.camera, name).translation;
    robot.Call(head, {name, Number(place.y()), Number(place.z())});
  }
  // Below the others, whose rig has no depth camera.
  robot.Call(head, {"depth", "0", Number(options.camera.mast - 0.1)});
  robot.Part([&](const Text& text, XmlWriter* xml) {
    AddMonoCamera(text, options.camera, xml);
    if (options.camera.stereo) AddStereoCamera(text, options.camera, xml);
    AddDepthCamera(text, options.camera, xml);
    AddLidar(text, options.lidar, xml);
    AddImu(text, xml);
  });
  // 1 and 0: xacro would write `true` as Python's True.
  robot.Call(drive, {"front", "odom", "1"});
  robot.Call(drive, {"rear", "odom_rear", "0"});
  robot.Part([](const Text&, XmlWriter* xml) { AddModelPlugins(xml); });
  return robot.Finish();
}

}  // namespace

Inertia BoxInertia(double mass, const Eigen::Vector3d& size) {
  const Eigen::Vector3d squared = size.cwiseAbs2();
  return {mass, mass / 12.0 *
                    Eigen::Vector3d(squared.y() + squared.z(), squared.x() + squared.z(),
                                    squared.x() + squared.y())};
}

Inertia WheelInertia(double mass, double radius, double width) {
  const double across = mass * (3.0 * radius * radius + width * width) / 12.0;
  return {mass, {across, 0.5 * mass * radius * radius, across}};
}

std::string RoverUrdf(const ScenarioOptions& options) { return WriteRobot(options, false); }

std::string RoverXacro(const ScenarioOptions& options) { return WriteRobot(options, true); }

}  // namespace regolith

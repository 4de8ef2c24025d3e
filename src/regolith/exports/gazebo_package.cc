// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/gazebo_package.h"

#include <filesystem>

#include "regolith/core/error.h"
#include "regolith/core/version.h"
#include "regolith/exports/rover_urdf.h"
#include "regolith/exports/xml_writer.h"
#include "regolith/io/atomic_file.h"

namespace regolith {
namespace {

constexpr const char* kPackage = "regolith_world";
constexpr double kDrop = 0.05;  // m above the ground at the start

void MakeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw OutputError(path, "cannot be made: " + error.message());
}

std::string Find(const std::string& file) {
  return std::string("$(find ") + kPackage + ")/" + file;
}

std::string ModelConfig() {
  XmlWriter xml;
  xml.Open("model");
  xml.Leaf("name", kRoverModel);
  xml.Leaf("version", "1.0");
  xml.Leaf("sdf", "rover.urdf", {{"version", "1.6"}});
  xml.Leaf("description", "The rover of Regolith's simulator, with its sensors.");
  xml.Close();
  return xml.Text();
}

std::string PackageXml() {
  XmlWriter xml;
  xml.Open("package", {{"format", "2"}});
  xml.Leaf("name", kPackage);
  xml.Leaf("version", "1.0.0");
  xml.Leaf("description", "Terrain and rover written by regolith terrain " + ProgramVersion());
  xml.Leaf("maintainer", "regolith", {{"email", "regolith@localhost"}});
  xml.Leaf("license", "BSD-3-Clause");
  xml.Leaf("buildtool_depend", "catkin");
  for (const char* const name :
       {"controller_manager", "effort_controllers", "gazebo_plugins", "gazebo_ros",
        "gazebo_ros_control", "joint_state_controller", "joint_state_publisher",
        "robot_state_publisher", "rviz", "topic_tools", "velodyne_gazebo_plugins", "xacro"}) {
    xml.Leaf("exec_depend", name);
  }
  xml.Open("export");
  xml.Empty("gazebo_ros",
            {{"gazebo_media_path", "${prefix}"}, {"gazebo_model_path", "${prefix}/models"}});
  xml.Close();
  xml.Close();
  return xml.Text();
}

std::string PackageCMake() {
  return std::string("cmake_minimum_required(VERSION 3.0.2)\nproject(") + kPackage +
         ")\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
         "install(DIRECTORY ./ DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})\n";
}

void AddArgument(const std::string& name, const std::string& value, XmlWriter* xml) {
  xml->Empty("arg", {{"name", name}, {"default", value}});
}

void AddNode(const std::string& package, const std::string& type, const std::string& arguments,
             XmlWriter* xml) {
  XmlWriter::Attributes attributes = {{"name", type}, {"pkg", package}, {"type", type}};
  if (!arguments.empty()) attributes.emplace_back("args", arguments);
  xml->Empty("node", attributes);
}

void AddDescription(XmlWriter* xml) {
  xml->Empty("param", {{"name", "robot_description"},
                       {"command", "$(find xacro)/xacro " + Find("rover.urdf.xacro")}});
}

std::string GazeboLaunch(const WorldDescription& world, bool has_world) {
  XmlWriter xml;
  xml.Open("launch");
  AddArgument("world", has_world ? Find("terrain.sdf") : "worlds/empty.world", &xml);
  AddArgument("gui", "true", &xml);
  AddArgument("x", has_world ? Number(world.start.x) : "0", &xml);
  AddArgument("y", has_world ? Number(world.start.y) : "0", &xml);
  AddArgument("z", Number(has_world ? world.start.ground + kDrop : kDrop), &xml);
  xml.Open("include", {{"file", "$(find gazebo_ros)/launch/empty_world.launch"}});
  xml.Empty("arg", {{"name", "world_name"}, {"value", "$(arg world)"}});
  xml.Empty("arg", {{"name", "gui"}, {"value", "$(arg gui)"}});
  xml.Empty("arg", {{"name", "use_sim_time"}, {"value", "true"}});
  xml.Close();
  AddDescription(&xml);
  AddNode("gazebo_ros", "spawn_model",
          "-urdf -param robot_description -model rover -x $(arg x) -y $(arg y) -z $(arg z)", &xml);
  xml.Empty("rosparam", {{"file", Find("config/control.yaml")}, {"command", "load"}});
  AddNode("controller_manager", "spawner", "joint_state_controller", &xml);
  AddNode("robot_state_publisher", "robot_state_publisher", "", &xml);
  xml.Comment("Gazebo tells the truth as an Odometry; recordings of Regolith have a pose");
  AddNode("topic_tools", "transform",
          "/ground_truth/odometry /ground_truth/pose geometry_msgs/PoseStamped "
          "'geometry_msgs.msg.PoseStamped(header=m.header, pose=m.pose.pose)' "
          "--import geometry_msgs",
          &xml);
  xml.Close();
  return xml.Text();
}

std::string DisplayLaunch() {
  XmlWriter xml;
  xml.Open("launch");
  AddDescription(&xml);
  AddNode("joint_state_publisher", "joint_state_publisher", "", &xml);
  AddNode("robot_state_publisher", "robot_state_publisher", "", &xml);
  AddNode("rviz", "rviz", "-d " + Find("config/rover.rviz"), &xml);
  xml.Close();
  return xml.Text();
}

std::string ControlYaml() {
  std::string text =
      "# joint_state_controller is started by gazebo.launch; the wheels' own controllers are for\n"
      "# those who drive them one by one instead of through cmd_vel.\n"
      "joint_state_controller:\n  type: joint_state_controller/JointStateController\n"
      "  publish_rate: 50\n";
  for (const char* const wheel : {"front_left", "front_right", "rear_left", "rear_right"}) {
    text += std::string(wheel) +
            "_controller:\n  type: effort_controllers/JointVelocityController\n" +
            "  joint: " + wheel + "_wheel_joint\n  pid: {p: 5.0, i: 1.0, d: 0.0}\n";
  }
  return text;
}

std::string RvizYaml() {
  return "Visualization Manager:\n"
         "  Class: \"\"\n"
         "  Global Options: {Fixed Frame: base, Frame Rate: 30}\n"
         "  Displays:\n"
         "    - {Class: rviz/Grid, Name: Grid, Enabled: true}\n"
         "    - {Class: rviz/RobotModel, Name: Rover, Enabled: true, Robot Description: "
         "robot_description}\n"
         "    - {Class: rviz/TF, Name: TF, Enabled: true}\n"
         "    - {Class: rviz/PointCloud2, Name: Lidar, Enabled: true, Topic: /velodyne_points}\n"
         "    - {Class: rviz/Image, Name: Mono, Enabled: true, Image Topic: "
         "/camera/mono/image_raw}\n"
         "  Views:\n"
         "    Current: {Class: rviz/Orbit, Distance: 4}\n";
}

}  // namespace

void WriteGazeboWorlds(const std::string& folder, const ScenarioOptions& options,
                       const WorldDescription& world) {
  WriteFile(folder + "/terrain.sdf", GazeboWorld(options, world, false));
  WriteFile(folder + "/world.sdf", GazeboWorld(options, world, true));
  const std::string model = folder + "/models/" + kRoverModel;
  MakeFolder(model);
  WriteFile(model + "/model.config", ModelConfig());
  WriteFile(model + "/rover.urdf", RoverUrdf(options));
}

void WriteRoverPackage(const std::string& folder, const ScenarioOptions& options,
                       const WorldDescription& world, bool has_world) {
  WriteFile(folder + "/rover.urdf.xacro", RoverXacro(options));
  WriteFile(folder + "/rover.urdf", RoverUrdf(options));
  WriteFile(folder + "/package.xml", PackageXml());
  WriteFile(folder + "/CMakeLists.txt", PackageCMake());
  MakeFolder(folder + "/launch");
  WriteFile(folder + "/launch/gazebo.launch", GazeboLaunch(world, has_world));
  WriteFile(folder + "/launch/display.launch", DisplayLaunch());
  MakeFolder(folder + "/config");
  WriteFile(folder + "/config/control.yaml", ControlYaml());
  WriteFile(folder + "/config/rover.rviz", RvizYaml());
}

}  // namespace regolith

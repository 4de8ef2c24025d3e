// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <csignal>
#include <functional>
#include <iostream>
#include <map>

#include "regolith/apps/evaluate.h"
#include "regolith/apps/info.h"
#include "regolith/apps/match.h"
#include "regolith/apps/reproduce.h"
#include "regolith/apps/run.h"
#include "regolith/apps/run_setup.h"
#include "regolith/apps/simulate.h"
#include "regolith/apps/terrain.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/core/stop.h"
#include "regolith/core/version.h"

namespace {

using Command = std::function<int()>;

constexpr int kWrongInput = 2;
constexpr int kOtherError = 1;

template <typename Arguments>
void AddOutput(CLI::App* app, Arguments& arguments) {
  app->add_option("--out", arguments.out, "Folder for the results")->required()->type_name("DIR");
  app->add_flag("--overwrite", arguments.overwrite, "Write into a folder that is not empty");
  app->add_flag("--quiet", arguments.quiet, "No progress, errors only");
}

template <typename Arguments>
void AddOverrides(CLI::App* app, Arguments& arguments, const std::string& example) {
  app->add_option("--config", arguments.config, "YAML file laid over the defaults")
      ->type_name("FILE");
  app->add_option("--set", arguments.set, "One setting, such as " + example + "; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

template <typename Arguments>
void AddSettings(CLI::App* app, Arguments& arguments) {
  AddOverrides(app, arguments, "lio.scan_voxel_size=0.5");
  app->add_option("--threads", arguments.threads, "Threads; 0 is one for each core")
      ->check(CLI::Range(0, 256))
      ->type_name("N")
      ->capture_default_str();
}

void AddTerrain(CLI::App& program, std::map<CLI::App*, Command>& commands) {
  const auto arguments = std::make_shared<regolith::TerrainArguments>();
  CLI::App* app = program.add_subcommand(
      "terrain", "Read or generate ground; export it for Gazebo, RViz and 3-D programs");
  app->add_option("--dem", arguments->dem, "Elevation model: any raster that GDAL reads")
      ->type_name("FILE");
  app->add_option("--statistics", arguments->statistics,
                  "moon or mars: ground generated from statistics or, with --dem, added below its "
                  "pixels (default there: the body that the file names)")
      ->type_name("BODY");
  app->add_option("--crop", arguments->crop,
                  "Centre column, centre row and side, pixels; default: the central 2500 square of "
                  "a model, all of generated ground")
      ->expected(3)
      ->type_name("X Y SIZE");
  app->add_option("--side", arguments->side, "Metres a side of generated ground")
      ->type_name("M")
      ->capture_default_str();
  app->add_option("--pixel", arguments->pixel, "Metres a pixel of generated ground")
      ->type_name("M")
      ->capture_default_str();
  app->add_option("--mesh-posts", arguments->mesh_posts,
                  "Posts a side of height map and meshes; 2^n + 1 for a height map")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--export", arguments->exports,
                  "Of heightmap, dae, obj, sdf, urdf, with commas; sdf brings the height map")
      ->delimiter(',')
      ->type_name("LIST");
  app->add_option("--seed", arguments->seed, "Another seed is another world")->type_name("N");
  app->add_flag("--repair", arguments->repair,
                "Fill holes of the elevation model, take out its spikes and stripes");
  AddSettings(app, *arguments);
  AddOutput(app, *arguments);
  app->footer(
      "Example:\n  regolith terrain --statistics moon --export heightmap,dae,sdf,urdf --out "
      "out/regolith_world");
  commands[app] = [arguments] { return regolith::Terrain(*arguments); };
}

void AddSimulate(CLI::App& program, std::map<CLI::App*, Command>& commands) {
  const auto arguments = std::make_shared<regolith::SimulateArguments>();
  CLI::App* app =
      program.add_subcommand("simulate", "Drive a rover over terrain and record its sensors");
  app->add_option("--scenario", arguments->scenario, "Name (config/scenarios) or YAML file")
      ->required()
      ->type_name("NAME");
  app->add_option("--dem", arguments->dem, "Elevation model: any raster that GDAL reads")
      ->type_name("FILE");
  app->add_option("--duration", arguments->duration, "Seconds; the scenario's own where absent")
      ->type_name("S");
  app->add_option("--seed", arguments->seed, "Another seed is another world")->type_name("N");
  app->add_option("--pairs", arguments->pairs,
                  "Image pairs with true correspondence to write into pairs/")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  app->add_flag("--pairs-only", arguments->pairs_only, "Pairs alone, without a recording");
  app->add_option("--quality", arguments->quality, "full or draft")
      ->type_name("Q")
      ->capture_default_str();
  AddSettings(app, *arguments);
  AddOutput(app, *arguments);
  app->footer("Example:\n  regolith simulate --scenario lunar_short --out out/lunar");
  commands[app] = [arguments] { return regolith::Simulate(*arguments); };
}

void AddRun(CLI::App& program, std::map<CLI::App*, Command>& commands) {
  const auto arguments = std::make_shared<regolith::RunArguments>();
  CLI::App* app = program.add_subcommand("run", "Estimate trajectory and map of a recording");
  app->add_option("recording", arguments->recording,
                  "ROS 1 bag, folder of `simulate`, EuRoC, KITTI raw drive or odometry sequence")
      ->required()
      ->type_name("RECORDING");
  app->add_option("--rig", arguments->rig,
                  "Sensors of the rover; not needed where the recording brings it")
      ->type_name("FILE");
  app->add_option("--pipeline", arguments->pipeline, "Name (config/pipelines) or YAML file")
      ->type_name("NAME")
      ->capture_default_str();
  app->add_option(
         "--features", arguments->features,
         "Instead of the pipeline's: ghost, ghost_paper, ghost_lk, superpoint, orb or st_lk")
      ->type_name("NAME");
  app->add_option("--rate", arguments->rate,
                  "1 feeds the recording at its own pace; 0 as fast as it goes")
      ->type_name("X");
  app->add_option("--drop", arguments->drops,
                  "Drop a topic's messages from START to END seconds; repeatable")
      ->type_name("TOPIC:START:END")
      ->allow_extra_args(false);
  app->add_option("--frame", arguments->frame,
                  "Frame of the trajectories: imu, lidar, camera, base")
      ->type_name("F");
  AddSettings(app, *arguments);
  AddOutput(app, *arguments);
  app->footer("Example:\n  regolith run out/lunar --out out/lunar_run");
  commands[app] = [arguments] { return regolith::Run(*arguments); };
}

void AddEvaluate(CLI::App& program, std::map<CLI::App*, Command>& commands) {
  const auto arguments = std::make_shared<regolith::EvaluateArguments>();
  CLI::App* app =
      program.add_subcommand("evaluate", "Errors of trajectories against a reference (TUM files)");
  app->add_option("--reference", arguments->reference, "True trajectory")
      ->required()
      ->type_name("FILE");
  app->add_option("--estimate", arguments->estimates, "Estimated trajectories")
      ->required()
      ->type_name("FILE...");
  app->add_option("--align", arguments->align,
                  "se3, sim3 (with scale), yaw (rotation about z alone), origin (first poses laid "
                  "together) or none")
      ->type_name("A")
      ->capture_default_str();
  app->add_option("--max-difference", arguments->max_difference,
                  "Seconds between associated stamps")
      ->type_name("S")
      ->capture_default_str();
  AddOutput(app, *arguments);
  app->footer(
      "Example:\n  regolith evaluate --reference out/lunar/ground_truth.tum --estimate "
      "out/lunar_run/trajectory.tum --out out/error");
  commands[app] = [arguments] { return regolith::Evaluate(*arguments); };
}

void AddMatch(CLI::App& program, std::map<CLI::App*, Command>& commands) {
  const auto arguments = std::make_shared<regolith::MatchArguments>();
  CLI::App* app = program.add_subcommand("match", "Find the same points in two images");
  app->add_option("image1", arguments->first, "PNG or JPEG")->required()->type_name("IMAGE1");
  app->add_option("image2", arguments->second, "PNG or JPEG")->required()->type_name("IMAGE2");
  app->add_option("--features", arguments->features,
                  "ghost, ghost_paper, ghost_lk, superpoint, orb or st_lk [ghost]")
      ->type_name("NAME");
  app->add_option("--max-keypoints", arguments->max_keypoints, "Keypoints an image [500]")
      ->type_name("N");
  app->add_option("--homography", arguments->homography,
                  "Truth: text file of the 3 x 3 numbers that take pixels of image 1 to image 2")
      ->type_name("FILE");
  app->add_option("--correspondences", arguments->correspondences,
                  "Truth: raster of two bands, x and y in image 2 of each pixel of image 1")
      ->type_name("FILE");
  AddOverrides(app, *arguments, "features.precision=f32");
  app->add_option("--threads", arguments->threads,
                  "Threads of the network's inference; 0 is one for each core [2]")
      ->check(CLI::Range(0, 256))
      ->type_name("N");
  AddOutput(app, *arguments);
  app->footer(
      "Example:\n  regolith match pairs/000000_1.png pairs/000000_2.png --correspondences "
      "pairs/000000_flow.tif --out out/match");
  commands[app] = [arguments] { return regolith::Match(*arguments); };
}

void AddReproduce(CLI::App& program, std::map<CLI::App*, Command>& commands) {
  const auto arguments = std::make_shared<regolith::ReproduceArguments>();
  CLI::App* app = program.add_subcommand(
      "reproduce", "Make the paper's tables and figures with our data; goes on where it was ended");
  app->add_option("--scale", arguments->scale,
                  "short: 40 s drives, about 15 minutes; full: the paper's lengths, hours")
      ->type_name("S")
      ->capture_default_str();
  app->add_option("--seeds", arguments->seeds, "Drives a scenario: seeds 1 to N [1, full: 3]")
      ->type_name("N");
  app->add_option("--duration", arguments->duration,
                  "Seconds of every drive, instead of the scenario's; for trying out")
      ->type_name("S");
  app->add_option("--pairs", arguments->pairs, "Image pairs a drive; 0: no table 1 [4, full: 40]")
      ->type_name("N");
  app->add_option("--scenarios", arguments->scenarios,
                  "Other drives than the paper's two experiments, with commas")
      ->delimiter(',')
      ->type_name("LIST");
  app->add_option("--methods", arguments->methods,
                  "Rows of table 2, with commas [all]: lego_loam, orb_slam2, lvi_sam, paper, "
                  "regolith, lio, vio, wheels, orb_slam2_ghost, kiss_icp")
      ->delimiter(',')
      ->type_name("LIST");
  app->add_option("--quality", arguments->quality, "Of the simulation: full or draft")
      ->type_name("Q")
      ->capture_default_str();
  app->add_option("--python", arguments->python,
                  "Interpreter that has the outside packages (benchmark/requirements_outside*.txt) "
                  "[REGOLITH_OUTSIDE_PYTHON or python3]")
      ->type_name("FILE");
  app->add_option("--threads", arguments->threads, "Threads of every command")
      ->check(CLI::Range(0, 256))
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--out", arguments->out, "Folder; one that was begun by the same command goes on")
      ->required()
      ->type_name("DIR");
  app->add_flag("--quiet", arguments->quiet, "Errors only");
  app->footer("Example:\n  regolith reproduce --scale short --out out/paper");
  commands[app] = [arguments] { return regolith::Reproduce(*arguments); };
}

int RunInfo(const regolith::InfoArguments& arguments) {
  const regolith::RecordingIdentity identity = regolith::IdentifyRecording(arguments.recording);
  std::optional<regolith::RigCalibration> rig;
  std::string source;
  const bool has_rig =
      !arguments.rig_file.empty() || !identity.rig_file.empty() || !identity.preset_rig.empty();
  if (has_rig) rig = regolith::FindRig(identity, arguments.rig_file, &source);
  return regolith::Info(arguments, rig, identity, std::cout);
}

void AddInfo(CLI::App& program, std::map<CLI::App*, Command>& commands) {
  const auto arguments = std::make_shared<regolith::InfoArguments>();
  CLI::App* app =
      program.add_subcommand("info", "What a recording holds, and whether a rig fits it");
  app->add_option("recording", arguments->recording, "As for `run`")
      ->required()
      ->type_name("RECORDING");
  app->add_option("--rig", arguments->rig_file, "Rig to check against the recording")
      ->type_name("FILE");
  app->footer("Example:\n  regolith info drive.bag --rig rover.yaml");
  commands[app] = [arguments] { return RunInfo(*arguments); };
}

int Dispatch(const std::map<CLI::App*, Command>& commands) {
  try {
    for (const auto& [app, command] : commands) {
      if (app->parsed()) return command();
    }
  } catch (const regolith::InputError& error) {
    regolith::LogError(error.what());
    return kWrongInput;
  } catch (const std::exception& error) {
    regolith::LogError(error.what());
    return kOtherError;
  }
  return kOtherError;
}

}  // namespace

int main(int argc, char** argv) {
  // A full disk or a file-size limit shows as a failed write, which names the file.
  std::signal(SIGXFSZ, SIG_IGN);
  regolith::InstallStopSignals();
  CLI::App program("Regolith: lidar-visual-inertial SLAM for planetary rovers", "regolith");
  program.set_version_flag("--version", regolith::ProgramVersion());
  program.require_subcommand(1);
  std::map<CLI::App*, Command> commands;
  AddTerrain(program, commands);
  AddSimulate(program, commands);
  AddRun(program, commands);
  AddEvaluate(program, commands);
  AddMatch(program, commands);
  AddReproduce(program, commands);
  AddInfo(program, commands);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : kWrongInput;
  }
  return Dispatch(commands);
}

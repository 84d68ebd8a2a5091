#include "bench/cli/selector_options.h"

#include <CLI/CLI.hpp>

#include "bench/cli/plugin_option.h"

namespace touchmark::bench::cli {

void add_motion_selectors(CLI::App& command, contestants::MotionSelectors& motion) {
  command
      .add_option(
          "--columns", motion.columns,
          "of motion files, by name or number: x=COL,y=COL,z=COL[,time=COL][,radius=COL]; time_ms, time_us "
          "or time_ns for a unit, time_s=COL,time_ns=COL for a sum")
      ->type_name("COLUMNS");
  command
      .add_option(
          "--motion-scale", motion.scale,
          "factor on the coordinates and radii of motion files, to mesh units: 1000 for metres on a mesh "
          "in millimetres")
      ->type_name("S");
  command
      .add_option(
          "--rate", motion.rate,
          "resample motion files by their times to this servo rate, linearly; default: a row is a step")
      ->type_name("HZ");
}

void add_scene_selectors(CLI::App& command, contestants::Selectors& selectors) {
  command
      .add_option(
          "--scene", selectors.scene,
          "bodies in place of --mesh: a name (touchmark list), a .json or .urdf file or any file with a "
          "node tree")
      ->type_name("SCENE");
  command
      .add_option("--poses", selectors.poses,
                  "how the scene's bodies move: CSV with columns time_s,body,x,y,z,qw,qx,qy,qz")
      ->type_name("CSV");
  command
      .add_option(
          "--package", selectors.packages,
          "of a .urdf: where package://NAME is; repeatable; else ROS_PACKAGE_PATH and AMENT_PREFIX_PATH say")
      ->type_name("NAME=DIR")
      ->expected(1)
      ->take_all();
}

void add_unit(CLI::App& command, std::string& unit) {
  command
      .add_option("--unit", unit, "what a mesh unit is, um, mm, cm, m or in: reports then speak of metres")
      ->type_name("UNIT");
}

void add_selectors(CLI::App& command, ProgramContext& context, contestants::Selectors& selectors,
                   contestants::Variety variety) {
  CLI::Option* mesh = command.add_option("--mesh", selectors.meshes,
                                         "a scene (touchmark list) or a mesh file; modifiers may follow: "
                                         "bunny@scale=1e-3@offset=1e6");
  mesh->type_name("MESH")->expected(1);
  if (variety == contestants::Variety::one) {
    mesh->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  } else {
    mesh->take_all();
  }
  command.add_flag("--normalize", selectors.normalize, "scale to box diagonal 1 about the origin");
  command
      .add_option("--trajectory", selectors.trajectories,
                  "a name (touchmark list) or a motion file, CSV with columns x,y,z; repeatable")
      ->type_name("T")
      ->expected(1)
      ->take_all();
  command
      .add_option("--detector", selectors.detectors,
                  "a contestant (touchmark list) as NAME[:key=value,...]; repeatable")
      ->type_name("D")
      ->expected(1)
      ->take_all();
  add_plugins(command, context, &selectors.detectors);
  command
      .add_option("--query", selectors.query,
                  variety == contestants::Variety::one ? "touches, nearest or sweep"
                                                       : "touches, nearest, sweep or all")
      ->type_name("QUERY")
      ->capture_default_str();
  command.add_option("--radius", selectors.radius, "the probe's, in mesh units or % of the box diagonal")
      ->type_name("LENGTH")
      ->capture_default_str();
  command
      .add_option("--reach", selectors.reach, "how far nearest looks; inf is allowed; default: the radius")
      ->type_name("LENGTH");
  add_motion_selectors(command, selectors.motion);
  command.add_option("--steps", selectors.steps, "steps a trajectory")->type_name("N");
  command.add_option("--seed", selectors.seed, "of trajectories and of the order of measuring")
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace touchmark::bench::cli

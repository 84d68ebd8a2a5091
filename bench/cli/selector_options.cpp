#include "bench/cli/selector_options.h"

#include <CLI/CLI.hpp>

#include "bench/cli/options.h"
#include "bench/cli/plugin_option.h"

namespace touchmark::bench::cli {

void add_motion_selectors(CLI::App& command, contestants::MotionSelectors& motion) {
  add_value(command, "--columns", motion.columns, "COLUMNS",
            "of motion files, by name or number: x=COL,y=COL,z=COL[,time=COL][,radius=COL]; time_ms, time_us "
            "or time_ns for a unit, time_s=COL,time_ns=COL for a sum");
  add_value(command, "--motion-scale", motion.scale, "S",
            "factor on the coordinates and radii of motion files, to mesh units: 1000 for metres on a mesh "
            "in millimetres");
  add_value(command, "--rate", motion.rate, "HZ",
            "resample motion files by their times to this servo rate, linearly; default: a row is a step");
}

void add_scene_selectors(CLI::App& command, contestants::Selectors& selectors) {
  add_value(command, "--scene", selectors.scene, "SCENE",
            "bodies in place of --mesh: a name (touchmark list), a .json or .urdf file or any file with a "
            "node tree");
  add_value(command, "--poses", selectors.poses, "CSV",
            "how the scene's bodies move: CSV with columns time_s,body,x,y,z,qw,qx,qy,qz");
  add_list(
      command, "--package", selectors.packages, "NAME=DIR",
      "of a .urdf: where package://NAME is; repeatable; else ROS_PACKAGE_PATH and AMENT_PREFIX_PATH say");
}

void add_unit(CLI::App& command, std::string& unit) {
  add_value(command, "--unit", unit, "UNIT",
            "what a mesh unit is, um, mm, cm, m or in: reports then speak of metres");
}

void add_selectors(CLI::App& command, ProgramContext& context, contestants::Selectors& selectors,
                   contestants::Variety variety) {
  CLI::Option* mesh = command.add_option(
      "--mesh", selectors.meshes,
      "a mesh by name (touchmark list) or a file; modifiers may follow: bunny@scale=1e-3@offset=1e6");
  mesh->type_name("MESH")->expected(1);
  if (variety == contestants::Variety::one) {
    mesh->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  } else {
    mesh->take_all();
  }
  command.add_flag("--normalize", selectors.normalize, "scale to box diagonal 1 about the origin");
  add_list(command, "--trajectory", selectors.trajectories, "T",
           "a name (touchmark list), as hand:tap, or a motion file, CSV with columns x,y,z; repeatable");
  add_list(command, "--detector", selectors.detectors, "D",
           "a contestant (touchmark list) as NAME[:key=value,...]; repeatable");
  add_plugins(command, context, &selectors.detectors);
  add_value(command, "--query", selectors.query, "QUERY",
            variety == contestants::Variety::one ? "touches, nearest, sweep or, of a scene, moving"
                                                 : "touches, nearest, sweep, moving (of a scene) or all");
  add_value(command, "--radius", selectors.radius, "LENGTH",
            "the probe's, in mesh units or % of the box diagonal");
  add_value(command, "--reach", selectors.reach, "LENGTH",
            "how far nearest looks; inf is allowed; default: the radius");
  add_motion_selectors(command, selectors.motion);
  command
      .add_option_function<std::string>(
          "--drape", [&](const std::string& how) { selectors.motion.drape = how.empty() ? "contact" : how; },
          "lay motion files on the surface, in contact (default) or free of it; they are in metres unless "
          "--motion-scale is given; the mesh is 20 cm across unless --unit is given")
      ->type_name("[contact|free]")
      ->expected(0, 1);
  add_value(command, "--steps", selectors.steps, "N", "steps a trajectory");
  add_value(command, "--seed", selectors.seed, "N", "of trajectories and of the order of measuring");
}

}  // namespace touchmark::bench::cli

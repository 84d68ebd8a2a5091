/// What --scene and --poses name.
#pragma once

#include <string>
#include <vector>

#include "bench/scenes/generated_bodies.h"

namespace touchmark::bench::scenes {

/// Loads a generated scene's name, a file that ends in .json (scene_json.h) or .urdf (urdf.h), or any other
/// file with a node tree, whose bodies are its nodes that have meshes. Of a robot or a tree a name that an
/// earlier body has gets "#2", "#3" and so on, and an empty one is "node". `poses` is a file or
/// empty; it takes the place of a generated scene's motion. `packages` says where a robot's packages are
/// (ros_packages.h). Throws std::invalid_argument, MeshError or
/// ResourceError; each names the offender in one line.
GeneratedScene load_body_scene(const std::string& what, const std::string& poses,
                               const std::vector<std::string>& packages = {});

}  // namespace touchmark::bench::scenes

/// Scenes that are written by hand: JSON that names meshes and says where they are.
#pragma once

#include <string>

#include "bench/scenes/body_scene.h"

namespace touchmark::bench::scenes {

/// Reads {"bodies":[{"name","mesh","position":[x,y,z],"orientation":[w,x,y,z]}]}. A mesh is a name as for
/// --mesh or else a file, relative to the scene's folder, with modifiers as for --mesh; bodies that name the
/// same one share it. In its place a body may have a "shape" with its sizes: docs/reference/scene-files.md
/// lists them. Throws std::invalid_argument, naming the file and the body, for text that is not JSON, keys
/// that are unknown, missing or there twice, names that are empty or there twice, shapes that are none, sizes
/// out of range, lists of another length, anything that is not a finite number, a quaternion of zeros, and no
/// body at all; and MeshError for a mesh that cannot be used.
BodyScene read_scene_json(const std::string& path);

}  // namespace touchmark::bench::scenes

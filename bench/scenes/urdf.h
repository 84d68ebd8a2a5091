/// Robots as scenes: URDF, read by Debian's liburdfdom where the program is built with it.
#pragma once

#include <string>

#include "bench/scenes/body_scene.h"
#include "bench/scenes/ros_packages.h"

namespace touchmark::bench::scenes {

/// Reads a URDF file. A body is an element of a link's collision geometry, or of its visual one where it has
/// none, where it stands when every joint is at 0. It has the link's name, as others of that link have. Boxes
/// and spheres are exact, a cylinder is a prism of `cylinder_sides` sides within it. Meshes are
/// files relative to the URDF's folder, or in packages. Throws std::invalid_argument, naming the file and the
/// link, for what is no URDF, sizes out of range, a scale of 0, a package that is not found, and a robot
/// without geometry; and where the program is built without the library. Throws MeshError for a mesh.
BodyScene read_urdf(const std::string& path, const RosPackages& packages);

inline constexpr unsigned cylinder_sides = 64;

}  // namespace touchmark::bench::scenes

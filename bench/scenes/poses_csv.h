/// Recorded motions of bodies.
#pragma once

#include <string>

#include "bench/scenes/body_scene.h"

namespace touchmark::bench::scenes {

/// Reads CSV with the header time_s,body,x,y,z,qw,qx,qy,qz, its columns in any order. The times of one body's
/// rows ascend; rows of several bodies may stand in any order. Between two rows the position is linear and
/// the orientation a slerp (`between`); before a body's first row and after its last it stays there. Bodies
/// without rows keep the scene's place. Throws std::invalid_argument, naming file and line, for a header or a
/// row of another form, an unknown body, anything that is not a finite number, a quaternion of zeros, times
/// that do not ascend, and no row at all.
BodyMotion read_poses(const std::string& path, const BodyScene& scene);

}  // namespace touchmark::bench::scenes

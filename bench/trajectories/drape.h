/// Motions over flat ground, laid on the surface of any mesh.
#pragma once

#include <span>

#include "bench/trajectories/motion_options.h"
#include "bench/trajectories/trajectory.h"
#include "bench/trajectories/trajectory_shapes.h"

namespace touchmark::bench::trajectories {

/// Returns a position for each one of `flat`, whose x and y are ways along the ground and whose z is the
/// height above it, in mesh units. The walk starts at a random place in a random direction. Its frame is
/// carried along without turning about the normal. Where the surface curves, way and height are those of the
/// centre, and the point below it goes a shorter or a longer way. No position is farther from the surface
/// than its height, or its depth where that is negative. Between walls closer than the height it is nearer.
Positions laid_on_surface(std::span<const Vec3> flat, Motion& motion);

/// Returns the recording, in mesh units, laid on the surface. Its axes of most and of middle variance are
/// ways along the surface, each turned so that its third central moment is positive; the third axis is the
/// height above its median, turned so that the slower side points inward. `contact` clamps heights between
/// half the radius inside and the radius outside; `free` counts them from the lowest. So a recording that is
/// turned or moved gives the same motion. Throws std::invalid_argument where its variance overflows.
Trajectory draped(Trajectory recording, Drape how, Motion motion);

}  // namespace touchmark::bench::trajectories

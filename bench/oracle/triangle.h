/// The oracle's own triangle, so that nothing of core/geometry is between the mesh and the truth.
#pragma once

#include <array>
#include <cstdint>

#include "core/probe.h"
#include "core/scene/pose.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::oracle {

/// Three corners as stored, any of which may coincide or be collinear.
using Triangle = std::array<Vec3, 3>;

/// A triangle of a body: the image of each corner is rotation * corner + translation, in exact arithmetic. Of
/// a round body the image is a point or a segment, and the surface is all that is so far from it.
struct PlacedTriangle {
  Triangle corners;
  const Pose* pose;
  double radius = 0;  ///< 0: the image itself is the surface
};

inline Triangle triangle_of(const TriangleMesh& mesh, std::uint32_t index) {
  return {mesh.corner(index, 0), mesh.corner(index, 1), mesh.corner(index, 2)};
}

}  // namespace touchmark::bench::oracle

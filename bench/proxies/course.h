/// One mesh and one motion over it: what every contestant of the proxy suite runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::bench::proxies {

struct Course {
  std::string name;
  TriangleMesh mesh;
  double radius = 0;          ///< the ball's, mesh units
  double friction = 0;        ///< both coefficients
  Vec3 start = Vec3::Zero();  ///< farther than the radius from the mesh
  std::vector<Vec3> goals;    ///< one a tick
  /// Where the free space that matters is convex: the triangles whose planes bound it, normals into it. The
  /// optimum is then the nearest point to the goal that is the radius off all of them. Empty: no such course.
  std::vector<std::uint32_t> bounds = {};
  std::size_t loop = 0;  ///< The goal's path closes after so many ticks; 0: it does not.
  /// The mesh changes after every so many ticks; 0: never. `moved(n)` is the mesh after the n-th change.
  std::size_t update_every = 0;
  std::function<TriangleMesh(std::size_t)> moved = nullptr;
  /// Meshes of bodies that move, one after another as `mesh` has them; empty: it is no such course. Each is
  /// moved by `places(n)` after the n-th change. The sums are exact, so that both tell the same surface.
  std::vector<TriangleMesh> bodies = {};
  std::function<std::vector<Vec3>(std::size_t)> places = nullptr;
};

}  // namespace touchmark::bench::proxies

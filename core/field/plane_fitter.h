/// Finds a plane that stands for the surface in a cube, and proves how far it may be off.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/field/plane_cell.h"
#include "core/field/sample.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/sign/triangle_tree.h"

namespace touchmark::field {

/// Let h(x) be the height of x above a plane, p a point of the cube, q the mesh's nearest to p, and f the
/// plane's nearest to p.
///
/// - d(p) >= |h(p) - h(q)| >= |h(p)| - e, if h(q) is at most e where p may be above the plane, and at least
///   -e where it may be below. All such q are in the ball about the cube's middle whose radius is the
///   middle's distance and the cube's diagonal.
/// - d(p) <= |h(p)| + d(f) and all f are within half a diagonal of one of the grid's middles, whose distances
///   are samples.
///
/// So |h(p)| is off by no more than the larger of both errors, and the triangle named is within it of f.
class PlaneFitter {
 public:
  struct Limits {
    double error;  ///< mesh units: no plane is off by more
    double unit;   ///< edge of the octree's smallest cube
    double slop;   ///< bounds what rounding does to a place or a height
  };
  struct Cube {
    Vec3 corner;  ///< the lowest
    double edge;
    double radius;  ///< no point of it is farther from its middle
  };
  struct Fit {
    PlaneCell cell;
    std::vector<std::uint32_t> near;  ///< positions in the mesh
    std::vector<std::uint8_t> names;  ///< places in `near`, of all squares of the grid
    double error;
  };

  /// The tree and the triangles, in the mesh's order, outlive the fitter.
  PlaneFitter(const sign::TriangleTree& tree, std::span<const PreparedTriangle> triangles,
              const Limits& limits) noexcept
      : tree_(tree), triangles_(triangles), limits_(limits), allowed_(limits.error - 8 * limits.slop) {}

  /// Returns nothing where no plane was proved to be good enough.
  std::optional<Fit> fit(const Cube& cube, const Sample& middle, const Sampler& sample) const;

 private:
  struct Ball {
    Vec3 center;
    double radius;
  };
  struct Heights {
    double least, most;
  };
  /// A triangle in a ball.
  struct Near {
    std::uint32_t triangle;
    double distance;  ///< from the ball's middle
    Heights height;   ///< above the middle, of what the triangle has in the ball
  };
  /// A triangle that reaches too far above the plane; heights are above that.
  struct Outlier {
    double distance;  ///< from the cube's middle
    double top, middle, top_of_cube;
  };
  struct Grid;

  std::vector<Near> triangles_in(const Ball& ball) const;
  Vec3 mean_normal(std::span<const Near> near, const Ball& ball, const Sample& middle) const noexcept;
  Heights heights_of(const PreparedTriangle& triangle, const Ball& ball, const Vec3& normal) const noexcept;
  bool lay_plane(const Cube& cube, std::span<const Near> near, Fit& fit) const noexcept;
  bool is_out_of_the_way(const Outlier& outlier, double radius) const noexcept;
  bool name_feet(const Cube& cube, const Sampler& sample, Fit& fit) const;
  bool name_squares(const Grid& grid, const Cube& cube, const Sampler& sample, Fit& fit) const;
  Grid grid_over(const Cube& cube, const PlaneCell& cell) const noexcept;

  const sign::TriangleTree& tree_;
  std::span<const PreparedTriangle> triangles_;
  Limits limits_;
  double allowed_;  ///< the error, less what rounding takes of it
};

}  // namespace touchmark::field

/// What Choi & Sung's graphical test asks of a surface, as numbers.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/sphere_cluster/sphere_cluster.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::papers {

/// One of the surfaces: level 0 is the same for every method and stands there once, as `original`.
struct SurfaceMeasures {
  std::string method;
  int level = 0;
  std::size_t triangles = 0;
  double mean_area = 0;        ///< square mesh units
  double relative_volume = 1;  ///< "volume equality": to level 0
  double crease_deg = 0;       ///< length-weighted root mean square of the angles between neighbouring faces
  std::size_t vertices = 0;    ///< those at one place count once
  double mean_edge_ratio = 0;  ///< a triangle's longest edge over its shortest, mean: 1 is equilateral
  bool keeps_vertices = true;  ///< is every vertex of level 0 still where it was, within a float's rounding?
  double mean_offset = 0;      ///< distance of the triangles' centroids to level 0, by area, mesh units
  double vertex_offset = 0;    ///< mean distance of level 0's vertices to the surface, mesh units
  double shrinkage_at_creases = 0;  ///< how far the tenth of level 0's vertices with the sharpest edges are
                                    ///< off the surface, over the mean of all; 0 where none is off
  double concave_bending = 0;       ///< sum over the edges at which the surface is concave of length times
                                    ///< angle, mesh units: dents and ripples add to it
  double centroid_radius = 0;       ///< mean of the spheres about centroids that hold a triangle, mesh units
  double circumradius = 0;          ///< mean of the circumscribed circles' radii, mesh units
};

/// Measures surfaces against the one they were made of.
class SurfaceRuler {
 public:
  /// Keeps a reference to the mesh.
  explicit SurfaceRuler(const TriangleMesh& original);

  SurfaceMeasures measure(std::string method, int level, const TriangleMesh& mesh) const;

 private:
  double mean_offset(const TriangleMesh& mesh) const;
  /// Fills keeps_vertices and shrinkage_at_creases.
  void compare_vertices(const TriangleMesh& mesh, SurfaceMeasures& measures) const;

  const TriangleMesh& original_;
  SphereCluster nearest_;    ///< on the original
  std::vector<Vec3> nodes_;  ///< the original's vertices, the one with the sharpest edge first
  double volume_;            ///< as the paper has it
};

/// Calls visit(length, angle in radians) for every edge of two triangles: how far their faces turn there.
void each_crease(const TriangleMesh& mesh, const std::function<void(double length, double angle)>& visit);

/// Length-weighted root mean square of the angles between neighbouring faces, in degrees. Smooth surfaces
/// halve it with every level, flat facets stay creased.
double crease_deg(const TriangleMesh& mesh);

/// Sum over the edges of two triangles at which a closed surface is concave of length times angle, in mesh
/// units. Splitting triangles without moving the surface keeps it; a dent in a convex place adds to it.
double concave_bending(const TriangleMesh& mesh);

/// The mean over all triangles of the longest edge over the shortest; those without area are left out.
double mean_edge_ratio(const TriangleMesh& mesh);

}  // namespace touchmark::bench::experiments::papers

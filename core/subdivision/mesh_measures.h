/// What Choi & Sung 2017 measure on a mesh, and the plain quantities beside it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/triangle_mesh.h"

namespace touchmark {

/// Square mesh units.
double area(const TriangleMesh& mesh);
inline double mean_triangle_area(const TriangleMesh& mesh) {
  return area(mesh) / static_cast<double>(mesh.size());
}

/// Cubic mesh units, positive when a closed mesh's triangles run counter-clockwise seen from outside.
/// Tetrahedra to the centre of the box: on a mesh that is not closed the number depends on that choice.
double signed_volume(const TriangleMesh& mesh);

/// The paper's volume: the sum of the absolute volumes of the tetrahedra from `center` to every triangle.
/// More than the volume of a mesh that is not star-shaped about the centre.
double absolute_volume(const TriangleMesh& mesh, const Vec3& center);

/// Counts the edges of the mesh as subdivision sees it: vertices at equal coordinates are one, triangles with
/// two corners at one position are left out.
struct EdgeStatistics {
  std::size_t edges = 0;
  std::size_t boundary = 0;  ///< edges of one triangle
  std::size_t seams =
      0;  ///< edges of more than two triangles, or of two that run along it in the same direction
  double shortest = 0;  ///< mesh units; 0 where there is no edge
  double mean = 0;
  double longest = 0;
  /// Every edge has two triangles, of one orientation.
  bool closed() const noexcept { return edges > 0 && boundary == 0 && seams == 0; }
};
EdgeStatistics edge_statistics(const TriangleMesh& mesh);

/// The paper's tightness: the mean of (radius - distance from the centre) over all pairs of a sphere and a
/// centroid in it (distance <= radius), whichever triangle the sphere was made for. Nothing where no centroid
/// lies in a sphere. The smaller the tighter. `radii` are the spheres', as many as `centers`
/// (std::invalid_argument otherwise).
std::optional<double> tightness(std::span<const Vec3> centers, std::span<const double> radii,
                                std::span<const Vec3> centroids);
/// The mean of (radius - distance) / radius over those pairs, which no scale changes; spheres of radius 0 are
/// left out.
std::optional<double> scale_free_tightness(std::span<const Vec3> centers, std::span<const double> radii,
                                           std::span<const Vec3> centroids);

}  // namespace touchmark

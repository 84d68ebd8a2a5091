/// Least squares subdivision surfaces (Boye, Guennebaud, Schlick 2010): Loop's masks, but each weighted mean
/// is projected on the algebraic sphere that fits the mask's vertices and normals.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/subdivision/indexed_faces.h"
#include "core/subdivision/oriented_surface.h"

namespace touchmark {

struct PointsAndNormals {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  ///< unit, or zero where there is none
};

/// For each vertex the sum of its triangles' unit normals times their angle there.
std::vector<Vec3> angle_weighted_normals(const IndexedTriangles& mesh);
/// Divided by their lengths; zero stays zero.
void normalize(std::vector<Vec3>& normals);

/// Returns the new positions of all vertices, then the new ones on `edges`, with the spheres' normals there.
/// Corners and seams are as in Loop's scheme, without a sphere.
PointsAndNormals ls3_points(const TriangleSurface& surface, std::span<const Vec3> positions,
                            std::span<const Vec3> normals, std::span<const std::uint32_t> edges);

}  // namespace touchmark

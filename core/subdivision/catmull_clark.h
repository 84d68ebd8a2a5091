/// Catmull-Clark subdivision (Catmull & Clark 1978): every face of N corners becomes N quadrilaterals.
#pragma once

#include <cstddef>

#include "core/subdivision/indexed_faces.h"

namespace touchmark {

/// - linear: old vertices stay, an edge's vertex is its middle, a triangle's the mean of its corners, a
///   quadrilateral's the middle of the diagonal from corner 0 to corner 2, along which it is cut in the end.
///   The surface stays. (MeshLab's; the paper's tightness comes out with it, not with the mean of four
///   corners.)
/// - smooth: Catmull & Clark's rules; a boundary is a cubic B-spline of its own vertices, corners stay, seams
///   split in the middle.
enum class CatmullClarkPositions { linear, smooth };

/// Each quadrilateral runs from an old vertex over an edge's vertex to the face's vertex (corner 2) and back
/// over the other edge's. N is 3 or 4.
template <std::size_t N>
IndexedQuads catmull_clark(const IndexedFaces<N>& mesh, CatmullClarkPositions positions);

/// Each quadrilateral cut from its old vertex to its face's vertex.
std::vector<TriangleMesh::Corners> triangulated(const IndexedQuads& mesh);

}  // namespace touchmark

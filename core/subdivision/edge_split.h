/// The topological half of a level: which edges split, and what becomes of the triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/subdivision/edge_map.h"
#include "core/subdivision/indexed_faces.h"
#include "core/subdivision/subdivision.h"

namespace touchmark {

struct EdgeSplit {
  static constexpr std::uint32_t whole = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> edges;   ///< the edges that split, ascending
  std::vector<std::uint32_t> vertex;  ///< for every edge the new vertex on it, or `whole`
};

/// Edges longer than `threshold`, strictly (all edges for 0); the new vertices follow the old ones in the
/// order of the edges. `form` meshlab: lengths are squared and compared in float, as there.
EdgeSplit long_edges(std::span<const Vec3> positions, const EdgeMap<3>& edges, double threshold,
                     SubdivisionForm form);

/// How many triangles `faces` become.
std::size_t count_after(std::size_t faces, const EdgeMap<3>& edges, const EdgeSplit& split) noexcept;

/// The triangles after the split: the first part of each in its place, the others at the end. `positions` are
/// the old vertices' and the new ones', and say which diagonal of a trapezoid is the shorter.
std::vector<TriangleMesh::Corners> split_faces(std::span<const TriangleMesh::Corners> faces,
                                               const EdgeMap<3>& edges, const EdgeSplit& split,
                                               std::span<const Vec3> positions);

}  // namespace touchmark

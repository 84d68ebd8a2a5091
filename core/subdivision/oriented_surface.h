/// Neighbours on an oriented triangle surface with or without boundary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/subdivision/edge_map.h"
#include "core/subdivision/indexed_faces.h"

namespace touchmark {

/// Throws MeshError, in the file's numbers, unless every edge has at most two triangles, which run along it
/// in opposite directions, and the triangles at every vertex form one fan. `method` names who asks.
void require_surface(const Welded& welded, std::string_view method);

/// Refers to the faces and edges it is built from. Sides are numbered as in EdgeMap.
class OrientedSurface {
 public:
  using Faces = std::span<const TriangleMesh::Corners>;
  static constexpr std::uint32_t no_side = std::numeric_limits<std::uint32_t>::max();

  /// The faces satisfy require_surface.
  OrientedSurface(Faces faces, const EdgeMap<3>& edges, std::size_t vertices);

  const EdgeMap<3>& edges() const noexcept { return edges_; }
  std::size_t vertices() const noexcept { return out_of_.size(); }

  static std::uint32_t next(std::uint32_t side) noexcept { return side % 3 == 2 ? side - 2 : side + 1; }
  static std::uint32_t previous(std::uint32_t side) noexcept { return side % 3 == 0 ? side + 2 : side - 1; }
  std::uint32_t start(std::uint32_t side) const noexcept { return faces_[side / 3][side % 3]; }
  std::uint32_t end(std::uint32_t side) const noexcept { return start(next(side)); }
  /// The corner of the side's triangle that does not lie on it.
  std::uint32_t apex(std::uint32_t side) const noexcept { return start(previous(side)); }
  /// The side of the neighbouring triangle on the same edge; no_side on a boundary.
  std::uint32_t across(std::uint32_t side) const noexcept { return across_[side]; }

  bool on_boundary(std::uint32_t vertex) const noexcept { return boundary_[vertex]; }
  /// A side that starts at the vertex; on a boundary the first of the fan, which lies on the boundary.
  std::uint32_t side_from(std::uint32_t vertex) const noexcept { return out_of_[vertex]; }
  /// The next side that starts at the same vertex, counter-clockwise; no_side after the last of a boundary's
  /// fan.
  std::uint32_t turned(std::uint32_t side) const noexcept { return across_[previous(side)]; }
  /// Edges at the vertex.
  std::size_t valence(std::uint32_t vertex) const noexcept;
  /// The neighbours counter-clockwise, from the end of `from` (a side that starts at the vertex); on a
  /// boundary from one boundary neighbour to the other, `from` being side_from(vertex).
  void ring(std::uint32_t from, std::vector<std::uint32_t>& neighbours) const;

 private:
  Faces faces_;
  const EdgeMap<3>& edges_;
  std::vector<std::uint32_t> across_;
  std::vector<std::uint32_t> out_of_;
  std::vector<bool> boundary_;
};

}  // namespace touchmark

/// Neighbours among faces of N corners, as far as they form an oriented surface with or without boundary.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/subdivision/edge_map.h"

namespace touchmark {

/// A seam is an edge of more than two faces, or of two that run along it in the same direction. No one can
/// say which face goes on in which across it, so a seam is an end of the surface for each of them.
///
/// A corner is a vertex on a seam, or one where several fans of faces meet in a point. The schemes keep
/// corners where they are and split seams in the middle.
///
/// Refers to the faces and edges it is built from. Sides are numbered as in EdgeMap.
template <std::size_t N>
class OrientedSurface {
 public:
  using Faces = std::span<const std::array<std::uint32_t, N>>;
  static constexpr std::uint32_t no_side = std::numeric_limits<std::uint32_t>::max();
  enum class Location : std::uint8_t { inside, boundary, corner };

  /// Every vertex belongs to a face.
  OrientedSurface(Faces faces, const EdgeMap<N>& edges, std::size_t vertices);

  const EdgeMap<N>& edges() const noexcept { return edges_; }
  std::size_t vertices() const noexcept { return out_of_.size(); }

  static std::uint32_t next(std::uint32_t side) noexcept {
    return side % N == N - 1 ? static_cast<std::uint32_t>(side + 1 - N) : side + 1;
  }
  static std::uint32_t previous(std::uint32_t side) noexcept {
    return side % N == 0 ? static_cast<std::uint32_t>(side + N - 1) : side - 1;
  }
  std::uint32_t start(std::uint32_t side) const noexcept { return faces_[side / N][side % N]; }
  std::uint32_t end(std::uint32_t side) const noexcept { return start(next(side)); }
  /// The corner before the side in its face; in a triangle the one that does not lie on the side.
  std::uint32_t apex(std::uint32_t side) const noexcept { return start(previous(side)); }
  /// The side of the neighbouring face on the same edge; no_side on boundaries and seams.
  std::uint32_t across(std::uint32_t side) const noexcept { return across_[side]; }

  Location location(std::uint32_t vertex) const noexcept { return location_[vertex]; }
  /// Inside the edge has two faces, which are neighbours; on the boundary one; the rest is a seam.
  Location location_of_edge(std::uint32_t edge) const noexcept;

  /// A side that starts at the vertex; on a boundary the first of the fan, which lies on the boundary.
  std::uint32_t side_from(std::uint32_t vertex) const noexcept { return out_of_[vertex]; }
  /// The next side that starts at the same vertex, counter-clockwise; no_side after the last of an open fan.
  std::uint32_t turned(std::uint32_t side) const noexcept { return across_[previous(side)]; }
  /// The last side of a boundary vertex's fan; its apex lies on the boundary.
  std::uint32_t last_side_from(std::uint32_t vertex) const noexcept;
  /// Edges at a vertex that is not a corner.
  std::size_t valence(std::uint32_t vertex) const noexcept;
  /// The neighbours counter-clockwise, from the end of `from` (a side that starts at a vertex which is not a
  /// corner); on a boundary from one boundary neighbour to the other, `from` being side_from(vertex).
  void ring(std::uint32_t from, std::vector<std::uint32_t>& neighbours) const;

 private:
  void join_neighbours();
  void find_boundaries_and_seams();
  void find_meeting_fans();
  std::size_t faces_in_fan(std::uint32_t vertex) const noexcept;

  Faces faces_;
  const EdgeMap<N>& edges_;
  std::vector<std::uint32_t> across_;
  std::vector<std::uint32_t> out_of_;
  std::vector<Location> location_;
};

using TriangleSurface = OrientedSurface<3>;

extern template class OrientedSurface<3>;
extern template class OrientedSurface<4>;

}  // namespace touchmark

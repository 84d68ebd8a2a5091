/// Which sides of which faces are the same edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace touchmark {

/// Side s of face f runs from its corner s to the next one and has the number f * N + s.
/// Edges are numbered in the order in which the faces name them first.
template <std::size_t N>
class EdgeMap {
 public:
  using Face = std::array<std::uint32_t, N>;

  /// Faces name vertices below `vertices`, no vertex twice.
  EdgeMap(std::span<const Face> faces, std::size_t vertices);

  std::size_t size() const noexcept { return ends_.size(); }
  std::uint32_t edge(std::size_t face, std::size_t side) const noexcept { return edge_of_[face * N + side]; }
  std::uint32_t edge(std::uint32_t side) const noexcept { return edge_of_[side]; }
  /// The two vertices, in the direction of the side that named the edge first.
  const std::array<std::uint32_t, 2>& ends(std::size_t edge) const noexcept { return ends_[edge]; }
  /// The sides that lie on the edge, ascending: one on a boundary, two inside, more where it is not a
  /// surface.
  std::span<const std::uint32_t> sides(std::size_t edge) const noexcept {
    return std::span(sides_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
  }

 private:
  std::vector<std::uint32_t> edge_of_;              ///< side -> edge
  std::vector<std::array<std::uint32_t, 2>> ends_;  ///< edge -> vertices
  std::vector<std::uint32_t> first_;                ///< edge -> its first place in sides_
  std::vector<std::uint32_t> sides_;
};

extern template class EdgeMap<3>;
extern template class EdgeMap<4>;

}  // namespace touchmark

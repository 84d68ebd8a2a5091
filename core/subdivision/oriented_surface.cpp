#include "core/subdivision/oriented_surface.h"

namespace touchmark {

template <std::size_t N>
OrientedSurface<N>::OrientedSurface(Faces faces, const EdgeMap<N>& edges, std::size_t vertices)
    : faces_(faces),
      edges_(edges),
      across_(faces.size() * N, no_side),
      out_of_(vertices, no_side),
      location_(vertices, Location::inside) {
  join_neighbours();
  find_boundaries_and_seams();
  find_meeting_fans();
}

template <std::size_t N>
void OrientedSurface<N>::join_neighbours() {
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto sides = edges_.sides(e);
    if (sides.size() != 2 || start(sides[0]) == start(sides[1])) continue;
    across_[sides[0]] = sides[1];
    across_[sides[1]] = sides[0];
  }
}

template <std::size_t N>
typename OrientedSurface<N>::Location OrientedSurface<N>::location_of_edge(
    std::uint32_t edge) const noexcept {
  const auto sides = edges_.sides(edge);
  if (sides.size() == 1) return Location::boundary;
  return across_[sides[0]] == no_side ? Location::corner : Location::inside;
}

template <std::size_t N>
void OrientedSurface<N>::find_boundaries_and_seams() {
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const Location location = location_of_edge(e);
    if (location == Location::inside) continue;
    for (const std::uint32_t v : edges_.ends(e))
      if (location_[v] != Location::corner) location_[v] = location;
  }
  for (std::uint32_t side = 0; side < across_.size(); ++side) {
    std::uint32_t& out = out_of_[start(side)];
    if (out == no_side || across_[side] == no_side) out = side;
  }
}

template <std::size_t N>
std::size_t OrientedSurface<N>::faces_in_fan(std::uint32_t vertex) const noexcept {
  const std::uint32_t first = side_from(vertex);
  std::size_t count = 0;
  std::uint32_t side = first;
  do {
    ++count;
    side = turned(side);
  } while (side != no_side && side != first);
  return count;
}

template <std::size_t N>
void OrientedSurface<N>::find_meeting_fans() {
  std::vector<std::uint32_t> faces(vertices(), 0);
  for (const auto& corners : faces_)
    for (const std::uint32_t v : corners) ++faces[v];
  for (std::uint32_t v = 0; v < vertices(); ++v)
    if (location_[v] != Location::corner && faces_in_fan(v) != faces[v]) location_[v] = Location::corner;
}

template <std::size_t N>
std::uint32_t OrientedSurface<N>::last_side_from(std::uint32_t vertex) const noexcept {
  std::uint32_t side = side_from(vertex);
  while (turned(side) != no_side) side = turned(side);
  return side;
}

template <std::size_t N>
std::size_t OrientedSurface<N>::valence(std::uint32_t vertex) const noexcept {
  return faces_in_fan(vertex) + (location(vertex) == Location::boundary ? 1 : 0);
}

template <std::size_t N>
void OrientedSurface<N>::ring(std::uint32_t from, std::vector<std::uint32_t>& neighbours) const {
  neighbours.clear();
  std::uint32_t side = from;
  do {
    neighbours.push_back(end(side));
    if (turned(side) == no_side) neighbours.push_back(apex(side));
    side = turned(side);
  } while (side != no_side && side != from);
}

template class OrientedSurface<3>;
template class OrientedSurface<4>;

}  // namespace touchmark

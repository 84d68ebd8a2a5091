#include "core/subdivision/oriented_surface.h"

#include <string>

namespace touchmark {
namespace {

std::string listed(std::span<const std::uint32_t> sides, const std::vector<std::uint32_t>& file_triangle) {
  constexpr std::size_t shown = 4;
  std::string text;
  for (std::size_t i = 0; i < sides.size() && i < shown; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(file_triangle[sides[i] / 3]);
  return sides.size() > shown ? text + ", ..." : text;
}

void require_edges(const Welded& welded, const EdgeMap<3>& edges, std::string_view method) {
  const auto& faces = welded.mesh.faces;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides(e);
    if (sides.size() == 1) continue;
    const auto [a, b] = edges.ends(e);
    const std::string edge = "the edge of vertices " + std::to_string(welded.file_vertex[a]) + " and " +
                             std::to_string(welded.file_vertex[b]);
    if (sides.size() > 2) {
      throw MeshError(edge + " belongs to " + std::to_string(sides.size()) + " triangles (" +
                      listed(sides, welded.file_triangle) + "): " + std::string(method) + " takes at most 2");
    }
    if (faces[sides[0] / 3][sides[0] % 3] == faces[sides[1] / 3][sides[1] % 3]) {
      throw MeshError("triangles " + listed(sides, welded.file_triangle) + " run along " + edge +
                      " in the same direction: " + std::string(method) + " takes one orientation");
    }
  }
}

void require_fans(const Welded& welded, const OrientedSurface& surface, std::string_view method) {
  std::vector<std::uint32_t> triangles(surface.vertices(), 0), fan(surface.vertices(), 0);
  for (const auto& corners : welded.mesh.faces)
    for (const std::uint32_t v : corners) ++triangles[v];
  for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
    const std::uint32_t first = surface.side_from(v);
    std::uint32_t side = first;
    do {
      ++fan[v];
      side = surface.turned(side);
    } while (side != OrientedSurface::no_side && side != first);
    if (fan[v] != triangles[v]) {
      throw MeshError("at vertex " + std::to_string(welded.file_vertex[v]) + " only " +
                      std::to_string(fan[v]) + " of " + std::to_string(triangles[v]) +
                      " triangles form a fan: " + std::string(method) + " takes one fan a vertex");
    }
  }
}

}  // namespace

void require_surface(const Welded& welded, std::string_view method) {
  const std::size_t vertices = welded.mesh.positions.size();
  const EdgeMap<3> edges(welded.mesh.faces, vertices);
  require_edges(welded, edges, method);
  require_fans(welded, OrientedSurface(welded.mesh.faces, edges, vertices), method);
}

OrientedSurface::OrientedSurface(Faces faces, const EdgeMap<3>& edges, std::size_t vertices)
    : faces_(faces),
      edges_(edges),
      across_(faces.size() * 3, no_side),
      out_of_(vertices, no_side),
      boundary_(vertices, false) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides(e);
    if (sides.size() != 2) continue;
    across_[sides[0]] = sides[1];
    across_[sides[1]] = sides[0];
  }
  for (std::uint32_t side = 0; side < across_.size(); ++side) {
    const std::uint32_t v = start(side);
    if (across_[side] == no_side) {
      boundary_[v] = true;
      boundary_[end(side)] = true;
      out_of_[v] = side;
    } else if (out_of_[v] == no_side) {
      out_of_[v] = side;
    }
  }
}

std::size_t OrientedSurface::valence(std::uint32_t vertex) const noexcept {
  const std::uint32_t first = side_from(vertex);
  std::size_t triangles = 0;
  std::uint32_t side = first;
  do {
    ++triangles;
    side = turned(side);
  } while (side != no_side && side != first);
  return on_boundary(vertex) ? triangles + 1 : triangles;
}

void OrientedSurface::ring(std::uint32_t from, std::vector<std::uint32_t>& neighbours) const {
  neighbours.clear();
  std::uint32_t side = from;
  while (true) {
    neighbours.push_back(end(side));
    const std::uint32_t following = turned(side);
    if (following == no_side) {
      neighbours.push_back(apex(side));
      return;
    }
    if (following == from) return;
    side = following;
  }
}

}  // namespace touchmark

#include "core/triangle_mesh.h"

#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

#include "core/flushed_denormals.h"

namespace touchmark {
namespace {

constexpr std::size_t max_count = std::numeric_limits<std::uint32_t>::max();

std::string coordinates(const Vec3& v) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return text.str();
}

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Vec3> vertices, std::vector<Corners> triangles,
                           std::vector<TriangleId> ids)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), ids_(std::move(ids)) {
  if (triangles_.empty()) throw MeshError("the mesh has no triangle");
  if (triangles_.size() > max_count)
    throw MeshError("the mesh has " + std::to_string(triangles_.size()) + " triangles, more than " +
                    std::to_string(max_count));
  if (vertices_.size() > max_count)
    throw MeshError("the mesh has " + std::to_string(vertices_.size()) + " vertices, more than " +
                    std::to_string(max_count));
  const std::span<const TriangleId> stored = ids_.stored();
  if (!stored.empty() && stored.size() != triangles_.size())
    throw MeshError(std::to_string(stored.size()) + " ids for " + std::to_string(triangles_.size()) +
                    " triangles");
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (!vertices_[i].allFinite())
      throw MeshError("vertex " + std::to_string(i) + " is not finite: " + coordinates(vertices_[i]));
  check_flushed_denormals(*this);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (const std::uint32_t vertex : triangles_[i]) {
      if (vertex >= vertices_.size())
        throw MeshError("triangle " + std::to_string(i) + " names vertex " + std::to_string(vertex) + " of " +
                        std::to_string(vertices_.size()));
      bounds_.extend(vertices_[vertex]);
    }
  }
  for (std::size_t i = 1; i < stored.size(); ++i)
    if (stored[i] < stored[i - 1])
      throw MeshError("triangle " + std::to_string(i) + " has id " + std::to_string(stored[i]) +
                      " after id " + std::to_string(stored[i - 1]) + ": ids must not decrease");
}

TriangleMesh TriangleMesh::transformed(double scale, const Vec3& shift) const {
  std::vector<Vec3> vertices;
  vertices.reserve(vertices_.size());
  for (const Vec3& v : vertices_) vertices.push_back(scale * (v + shift));
  return {std::move(vertices), triangles_, {ids().begin(), ids().end()}};
}

TriangleMesh TriangleMesh::normalized() const {
  const double size = diagonal();
  if (!(size > 0)) throw MeshError("the mesh cannot be normalised: all its vertices coincide");
  if (!(size <= std::numeric_limits<double>::max()))
    throw MeshError("the mesh cannot be normalised: its box from " + coordinates(bounds_.min) + " to " +
                    coordinates(bounds_.max) + " has a diagonal beyond double");
  return transformed(1 / size, -bounds_.center());
}

}  // namespace touchmark

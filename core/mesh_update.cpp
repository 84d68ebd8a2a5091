#include "core/mesh_update.h"

#include <cstring>
#include <stdexcept>
#include <string>

namespace touchmark {
namespace {

/// A step of a hash.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) noexcept {
  hash = (hash ^ word) * 0x9e3779b97f4a7c15;
  return hash ^ (hash >> 29);
}

void expect_as_many(std::size_t found, std::size_t expected, const char* what) {
  if (found == expected) return;
  throw std::invalid_argument("update: the mesh has " + std::to_string(found) + ' ' + what + ", not the " +
                              std::to_string(expected) + " that the detector was built with");
}

}  // namespace

Connectivity::Connectivity(const TriangleMesh& mesh) noexcept
    : vertices_(mesh.vertices().size()), triangles_(mesh.size()) {
  for (const TriangleMesh::Corners& corners : mesh.triangles()) {
    corners_and_ids_ = mixed(corners_and_ids_, std::uint64_t{corners[0]} << 32 | corners[1]);
    corners_and_ids_ = mixed(corners_and_ids_, corners[2]);
  }
  for (const TriangleId id : mesh.ids()) corners_and_ids_ = mixed(corners_and_ids_, id);
}

void Connectivity::expect(const TriangleMesh& mesh) const {
  const Connectivity found(mesh);
  expect_as_many(found.vertices_, vertices_, "vertices");
  expect_as_many(found.triangles_, triangles_, "triangles");
  if (found.corners_and_ids_ != corners_and_ids_)
    throw std::invalid_argument(
        "update: the triangles have other corners or ids than those that the detector was built with");
}

}  // namespace touchmark

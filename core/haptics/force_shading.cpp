#include "core/haptics/force_shading.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/haptics/proxy_motion.h"

namespace touchmark {
namespace {

/// The shares of the corners in a point of the triangle; those below 0 are of a point beside it.
std::array<double, 3> shares_of(const TriangleMesh& mesh, std::size_t index, const Vec3& point) noexcept {
  const std::array<Vec3, 3> to = {mesh.corner(index, 0) - point, mesh.corner(index, 1) - point,
                                  mesh.corner(index, 2) - point};
  const Vec3 across =
      (mesh.corner(index, 1) - mesh.corner(index, 0)).cross(mesh.corner(index, 2) - mesh.corner(index, 0));
  const double area = across.squaredNorm();
  if (!(area > 0)) return {1, 0, 0};
  return {to[1].cross(to[2]).dot(across) / area, to[2].cross(to[0]).dot(across) / area,
          to[0].cross(to[1]).dot(across) / area};
}

}  // namespace

ForceShading::ForceShading(const TriangleMesh& mesh)
    : mesh_(&mesh), normals_(mesh.vertices().size(), Vec3::Zero()) {
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Vec3 across = (mesh.corner(i, 1) - mesh.corner(i, 0)).cross(mesh.corner(i, 2) - mesh.corner(i, 0));
    for (const std::uint32_t vertex : mesh.triangles()[i]) normals_[vertex] += across;
  }
  for (Vec3& normal : normals_) normal.stableNormalize();
}

/// Returns the triangle of this id that the point is on: a file may have cut several from one polygon.
std::size_t ForceShading::triangle_at(TriangleId id, const Vec3& point) const noexcept {
  if (mesh_->ids().empty()) return id;
  const auto ids = mesh_->ids();
  const auto first = std::ranges::lower_bound(ids, id), last = std::ranges::upper_bound(ids, id);
  std::size_t best = mesh_->size();
  double most = -std::numeric_limits<double>::infinity();
  for (auto at = first; at != last; ++at) {
    const auto index = static_cast<std::size_t>(at - ids.begin());
    const std::array<double, 3> shares = shares_of(*mesh_, index, point);
    const double least = *std::ranges::min_element(shares);
    if (!(least > most)) continue;
    most = least;
    best = index;
  }
  return best;
}

Vec3 ForceShading::shaded(const ProxyState& state, double share) const noexcept {
  if (!(share > 0) || state.contacts != 1 || !state.triangles[0]) return state.force;
  const std::size_t index = triangle_at(*state.triangles[0], state.points[0]);
  if (index >= mesh_->size()) return state.force;
  const std::array<double, 3> shares = shares_of(*mesh_, index, state.points[0]);
  const Vec3& normal = state.normals[0];
  Vec3 smooth = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    smooth += std::clamp(shares[i], 0.0, 1.0) * normals_[mesh_->triangles()[index][i]];
  // The side that the proxy is on, and no farther round than a right angle.
  if (smooth.dot(normal) < 0) smooth = -smooth;
  const double length = smooth.norm();
  if (!(length > 0)) return state.force;
  const Vec3 turned = normal + std::min(share, 1.0) * (smooth / length - normal);
  return state.force + state.force.dot(normal) * (turned.normalized() - normal);
}

}  // namespace touchmark

#include "core/sign/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace touchmark::sign {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const Pseudonormals& normals, std::uint32_t face) noexcept {
  const auto [a, b, c] = normals.corners(face);
  return {normals.position(a), normals.position(b), normals.position(c)};
}

Aabb box_of(const Corners& t) noexcept {
  Aabb box;
  for (const Vec3& corner : t) box.extend(corner);
  return box;
}

bool has_sharp_corner(const Corners& t) noexcept {
  for (std::size_t s = 0; s < 3; ++s) {
    const Vec3 u = t[(s + 1) % 3] - t[s], v = t[(s + 2) % 3] - t[s];
    if (!(u.cross(v).norm() >= sharpest * u.norm() * v.norm())) return true;
  }
  return false;
}

/// Is there a gap between the projections on this axis?
bool parts(const Vec3& axis, const Corners& a, const Corners& b, double gap) noexcept {
  const double length = axis.norm();
  if (!(length > 0)) return false;
  const Vec3& origin = a[0];
  const double b0 = axis.dot(b[0] - origin), b1 = axis.dot(b[1] - origin), b2 = axis.dot(b[2] - origin);
  const double a1 = axis.dot(a[1] - origin), a2 = axis.dot(a[2] - origin);
  const double gap_between = std::max(std::min({b0, b1, b2}) - std::max({0.0, a1, a2}),
                                      std::min({0.0, a1, a2}) - std::max({b0, b1, b2}));
  return gap_between > gap * length;
}

/// Separating axes: the normals, across each pair of edges, and in each plane across its edges.
bool are_disjoint(const Corners& a, const Corners& b, double gap) noexcept {
  const std::array<Vec3, 3> along_a = {a[1] - a[0], a[2] - a[1], a[0] - a[2]};
  const std::array<Vec3, 3> along_b = {b[1] - b[0], b[2] - b[1], b[0] - b[2]};
  const Vec3 normal_a = along_a[0].cross(along_a[1]), normal_b = along_b[0].cross(along_b[1]);
  if (parts(normal_a, a, b, gap) || parts(normal_b, a, b, gap)) return true;
  for (const Vec3& u : along_a)
    for (const Vec3& v : along_b)
      if (parts(u.cross(v), a, b, gap)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (parts(normal_a.cross(along_a[i]), a, b, gap) || parts(normal_b.cross(along_b[i]), a, b, gap))
      return true;
  return false;
}

/// The directions between two unit vectors, as a corner of a face sees its far side.
struct Sector {
  Vec3 first, last, normal;  ///< unit; the normal zero where the corner is sharp

  Sector(const Vec3& u, const Vec3& v) noexcept : first(u.normalized()), last(v.normalized()) {
    normal = first.cross(last);
    const double sine = normal.norm();
    normal = sine >= sharpest ? Vec3(normal / sine) : Vec3::Zero();
  }
  bool has_over_it(const Vec3& direction, double tolerance) const noexcept {
    return normal.cross(first).dot(direction) >= -tolerance &&
           last.cross(normal).dot(direction) >= -tolerance;
  }
  /// From a unit vector to the nearest point of the cone.
  double distance(const Vec3& direction) const noexcept {
    double least = 1;
    for (const Vec3& end : {first, last})
      least = std::min(least, (direction - std::max(0.0, direction.dot(end)) * end).norm());
    if (has_over_it(direction, 0)) least = std::min(least, std::abs(normal.dot(direction)));
    return least;
  }
};

/// Two faces at one vertex. The least angle between two arcs is at an end of one, or they cross.
bool part_at_vertex(const Sector& a, const Sector& b) noexcept {
  if (a.normal.isZero(0) || b.normal.isZero(0)) return false;
  if (a.distance(b.first) < sharpest || a.distance(b.last) < sharpest || b.distance(a.first) < sharpest ||
      b.distance(a.last) < sharpest)
    return false;
  constexpr double tolerance = 0x1p-20;  // far above rounding, far below `sharpest`
  const Vec3 common = a.normal.cross(b.normal);
  const double sine = common.norm();
  // In one plane but for the tolerance, arcs that cross would have an end nearer to the other.
  if (sine < tolerance) return true;
  for (const Vec3& direction : {Vec3(common / sine), Vec3(-common / sine)})
    if (a.has_over_it(direction, tolerance) && b.has_over_it(direction, tolerance)) return false;
  return true;
}

/// Two faces at one edge, each given by its third corner.
bool part_at_edge(const Vec3& from, const Vec3& to, const Vec3& apex_a, const Vec3& apex_b) noexcept {
  const Vec3 edge = (to - from).normalized();
  const auto across = [&](const Vec3& apex) -> Vec3 {
    const Vec3 out = apex - from;
    return (out - out.dot(edge) * edge).normalized();
  };
  const double cosine = across(apex_a).dot(across(apex_b));
  return cosine <= 1 - sharpest * sharpest;  // at most the cosine of twice that angle
}

/// Do two faces keep the distance that being clear means?
bool keep_clear(const Pseudonormals& normals, std::uint32_t f, std::uint32_t g, double gap) noexcept {
  const auto &a = normals.corners(f), &b = normals.corners(g);
  std::array<std::size_t, 3> in_a{}, in_b{};
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a[i] != b[j]) continue;
      in_a[shared] = i;
      in_b[shared++] = j;
    }
  }
  const Corners at_a = corners_of(normals, f), at_b = corners_of(normals, g);
  const auto sector = [](const Corners& t, std::size_t s) {
    return Sector(t[(s + 1) % 3] - t[s], t[(s + 2) % 3] - t[s]);
  };
  if (shared == 0) return are_disjoint(at_a, at_b, gap);
  if (shared == 1) return part_at_vertex(sector(at_a, in_a[0]), sector(at_b, in_b[0]));
  if (shared == 3) return false;
  return part_at_edge(at_a[in_a[0]], at_a[in_a[1]], at_a[3 - in_a[0] - in_a[1]], at_b[3 - in_b[0] - in_b[1]]);
}

}  // namespace

std::vector<bool> clear_faces(const Pseudonormals& normals, const TriangleTree& tree,
                              std::span<const std::uint32_t> face_of, const Aabb& bounds) {
  const double gap = clearance * bounds.extent().maxCoeff();
  std::vector<bool> clear(normals.faces(), true);
  for (std::uint32_t f = 0; f < normals.faces(); ++f) {
    const Corners corners = corners_of(normals, f);
    if (has_sharp_corner(corners)) clear[f] = false;
    const Aabb box = box_of(corners);
    const auto is_near = [&](const Aabb& other) { return box.comes_within(gap, other); };
    tree.visit(is_near, [&](const TriangleTree::Item& item) {
      const std::uint32_t g = face_of[item.index];
      if (g == Pseudonormals::no_face || g <= f || !is_near(box_of(item.corner))) return;
      if (keep_clear(normals, f, g, gap)) return;
      clear[f] = false;
      clear[g] = false;
    });
  }
  return clear;
}

}  // namespace touchmark::sign

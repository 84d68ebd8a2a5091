#include "core/sign/pseudonormals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/geometry/point_triangle.h"

namespace touchmark::sign {
namespace {

/// Fewer roundings than the margin of a decision allows for: core/sign/side_finder.cpp.
constexpr std::size_t max_in_fan = 64;

/// Between the edges from corner s; 0 to pi.
double angle_at(const std::array<Vec3, 3>& corner, std::size_t s) noexcept {
  const Vec3 u = corner[(s + 1) % 3] - corner[s], v = corner[(s + 2) % 3] - corner[s];
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// The nearest point of a triangle: on which feature, and how far from the others.
struct ClosestPoint {
  Pseudonormals::Feature feature;
  std::uint32_t side;
  Vec3 offset;
  double gap;
};

ClosestPoint foot_on_edge(const std::array<Vec3, 3>& corner, const Vec3& center, std::uint32_t s) noexcept {
  const Vec3 edge = corner[(s + 1) % 3] - corner[s], to = center - corner[s];
  const double length = edge.norm();
  const double along = std::clamp(to.dot(edge) / (length * length), 0.0, 1.0);
  return {Pseudonormals::Feature::edge, s, to - along * edge, std::min(along, 1 - along) * length};
}

/// By the regions of Ericson, "Real-Time Collision Detection" (2005), 5.1.5. Where rounding picks a
/// neighbouring feature that point is hardly farther; who relies on it compares distances.
ClosestPoint foot_of(const std::array<Vec3, 3>& corner, const Vec3& center) noexcept {
  using Feature = Pseudonormals::Feature;
  const Vec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0];
  const Vec3 to_a = center - corner[0], to_b = center - corner[1], to_c = center - corner[2];
  const double a_ab = ab.dot(to_a), a_ac = ac.dot(to_a);
  if (a_ab <= 0 && a_ac <= 0) return {Feature::vertex, 0, to_a, 0};
  const double b_ab = ab.dot(to_b), b_ac = ac.dot(to_b);
  if (b_ab >= 0 && b_ac <= b_ab) return {Feature::vertex, 1, to_b, 0};
  const double over_c = a_ab * b_ac - b_ab * a_ac;
  if (over_c <= 0 && a_ab >= 0 && b_ab <= 0) return foot_on_edge(corner, center, 0);
  const double c_ab = ab.dot(to_c), c_ac = ac.dot(to_c);
  if (c_ac >= 0 && c_ab <= c_ac) return {Feature::vertex, 2, to_c, 0};
  const double over_b = c_ab * a_ac - a_ab * c_ac;
  if (over_b <= 0 && a_ac >= 0 && c_ac <= 0) return foot_on_edge(corner, center, 2);
  const double over_a = b_ab * c_ac - c_ab * b_ac;
  if (over_a <= 0 && b_ac - b_ab >= 0 && c_ab - c_ac >= 0) return foot_on_edge(corner, center, 1);
  const double scale = 1 / (over_a + over_b + over_c);
  const double share_b = over_b * scale, share_c = over_c * scale;
  // Barycentric coordinates times heights are distances to the sides.
  const double twice_area = ab.cross(ac).norm();
  const double gap =
      twice_area * std::min({over_a * scale / (ac - ab).norm(), share_b / ac.norm(), share_c / ab.norm()});
  return {Feature::face, 0, to_a - share_b * ab - share_c * ac, gap};
}

}  // namespace

Pseudonormals::Pseudonormals(const IndexedTriangles& welded, const TriangleSurface& surface)
    : positions_(welded.positions), faces_(welded.faces) {
  across_.reserve(3 * faces_.size());
  normals_.reserve(faces_.size());
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const auto [a, b, c] = faces_[f];
    normals_.push_back(prepare(positions_[a], positions_[b], positions_[c], f).normal);
    for (std::uint32_t s = 0; s < 3; ++s) {
      const std::uint32_t other = surface.across(3 * f + s);
      across_.push_back(other == TriangleSurface::no_side ? no_face : other / 3);
    }
  }
  sum_up_vertices(surface);
}

void Pseudonormals::sum_up_vertices(const TriangleSurface& surface) {
  vertex_normals_.assign(positions_.size(), Vec3::Zero());
  shortest_edge_.assign(positions_.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> in_fan(positions_.size(), 0);
  std::vector<bool> flat(positions_.size(), false);
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const auto& corners = faces_[f];
    const std::array<Vec3, 3> at = {positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]};
    for (std::size_t s = 0; s < 3; ++s) {
      const std::uint32_t v = corners[s];
      vertex_normals_[v] += angle_at(at, s) * normals_[f];
      shortest_edge_[v] =
          std::min({shortest_edge_[v], (at[(s + 1) % 3] - at[s]).norm(), (at[(s + 2) % 3] - at[s]).norm()});
      if (++in_fan[v] > max_in_fan || normals_[f].isZero(0)) flat[v] = true;
    }
  }
  for (std::uint32_t v = 0; v < positions_.size(); ++v)
    if (flat[v] || surface.place(v) != TriangleSurface::Place::inside) shortest_edge_[v] = 0;
}

std::optional<Pseudonormals::Reading> Pseudonormals::on_face(std::uint32_t face, const Vec3& center,
                                                             const Vec3& offset, double gap) const noexcept {
  const double distance = offset.norm();
  const double height = normals_[face].dot(center - positions_[faces_[face][0]]);
  return Reading{face, Feature::face, 0, offset, distance, gap, 2 * std::numbers::pi * height / distance};
}

std::optional<Pseudonormals::Reading> Pseudonormals::on_edge(std::uint32_t face, std::uint32_t s,
                                                             const Vec3& offset, double gap) const noexcept {
  const std::uint32_t other = across(face, s);
  if (other == no_face || normals_[other].isZero(0)) return std::nullopt;
  const double distance = offset.norm();
  const Vec3 sum = normals_[face] + normals_[other];
  return Reading{
      face, Feature::edge, s, offset, distance, gap, std::numbers::pi * sum.dot(offset) / distance};
}

std::optional<Pseudonormals::Reading> Pseudonormals::on_vertex(std::uint32_t face, std::uint32_t s,
                                                               const Vec3& offset) const noexcept {
  const std::uint32_t v = faces_[face][s];
  if (!regular(v)) return std::nullopt;
  const double distance = offset.norm();
  return Reading{face,
                 Feature::vertex,
                 s,
                 offset,
                 distance,
                 shortest_edge_[v],
                 vertex_normals_[v].dot(offset) / distance};
}

std::optional<Pseudonormals::Reading> Pseudonormals::at_nearest(std::uint32_t face,
                                                                const Vec3& center) const noexcept {
  if (normals_[face].isZero(0)) return std::nullopt;
  const auto [a, b, c] = faces_[face];
  const ClosestPoint foot = foot_of({positions_[a], positions_[b], positions_[c]}, center);
  switch (foot.feature) {
    case Feature::face:
      return on_face(face, center, foot.offset, foot.gap);
    case Feature::edge:
      return on_edge(face, foot.side, foot.offset, foot.gap);
    case Feature::vertex:
      break;
  }
  return on_vertex(face, foot.side, foot.offset);
}

std::size_t Pseudonormals::bytes() const noexcept {
  return positions_.capacity() * sizeof(Vec3) + faces_.capacity() * sizeof(faces_[0]) +
         across_.capacity() * sizeof(std::uint32_t) + normals_.capacity() * sizeof(Vec3) +
         vertex_normals_.capacity() * sizeof(Vec3) + shortest_edge_.capacity() * sizeof(double);
}

}  // namespace touchmark::sign

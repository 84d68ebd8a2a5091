#include "core/sign/side_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "core/exact/orientation.h"
#include "core/float_limits.h"
#include "core/geometry/distance_error.h"
#include "core/geometry/point_triangle.h"
#include "core/sign/clearance.h"
#include "core/sign/open_edges.h"
#include "core/sign/volume.h"
#include "core/subdivision/edge_map.h"
#include "core/subdivision/indexed_faces.h"
#include "core/subdivision/oriented_surface.h"

namespace touchmark {
namespace {

using sign::Pseudonormals;

/// The winding number that counts as outside: in a room it is the one of infinity that is inside.
Side side_of_count(int count, bool inside_out) noexcept {
  if (inside_out) return count == 0 ? Side::inside : count < 0 ? Side::outside : Side::undecided;
  return count == 0 ? Side::outside : count > 0 ? Side::inside : Side::undecided;
}

/// By mesh index; welding dropped the triangles with two corners in one place and kept the others' order.
std::vector<std::uint32_t> faces_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> face_of;
  face_of.reserve(mesh.size());
  std::uint32_t next = 0;
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    const bool dropped = a == b || b == c || c == a;
    face_of.push_back(dropped ? Pseudonormals::no_face : next++);
  }
  return face_of;
}

bool is_exact(const Accuracy& accuracy) noexcept {
  return accuracy.guarantee == Guarantee::exact && accuracy.relative <= kernel_relative_error &&
         accuracy.absolute == 0;
}

}  // namespace

SideFinder SideFinder::build(const TriangleMesh& mesh) {
  SideFinder finder;
  finder.bounds_ = mesh.bounds();
  finder.ids_.assign(mesh.ids().begin(), mesh.ids().end());
  finder.face_of_ = faces_of(mesh);

  const IndexedTriangles welded = weld(mesh);
  const EdgeMap<3> edges(welded.faces, welded.positions.size());
  const sign::OpenEdges open = sign::open_edges(welded, edges);
  finder.normals_ = Pseudonormals(welded, TriangleSurface(welded.faces, edges, welded.positions.size()));
  std::vector<std::array<Vec3, 2>> ends;
  ends.reserve(open.edges.size());
  for (const auto& [from, to] : open.edges) ends.push_back({welded.positions[from], welded.positions[to]});
  finder.winding_ = sign::Winding(mesh, std::move(ends));

  Surface& surface = finder.surface_;
  surface.open_edges = open.edges.size();
  surface.contrary_edges = open.contrary;
  surface.closed = open.edges.empty() && open.contrary == 0;
  surface.inside_out = surface.closed && sign::volume_sign(mesh) < 0;
  surface.method = open.contrary > 0 ? Method::none
                   : surface.closed  ? Method::crossings
                                     : Method::winding_number;
  if (surface.closed)
    finder.find_simple_faces(
        sign::clear_faces(finder.normals_, finder.winding_.tree(), finder.face_of_, finder.bounds_));
  return finder;
}

/// Faces that are clear and joined by edges have the same winding number in front of them: one of each patch
/// is looked at.
void SideFinder::find_simple_faces(const std::vector<bool>& clear) {
  simple_face_.assign(normals_.faces(), false);
  std::vector<bool> seen(normals_.faces(), false);
  std::vector<std::uint32_t> patch;
  for (std::uint32_t first = 0; first < normals_.faces(); ++first) {
    if (!clear[first] || seen[first]) continue;
    patch.assign(1, first);
    seen[first] = true;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (std::size_t s = 0; s < 3; ++s) {
        const std::uint32_t next = normals_.across(patch[i], s);
        if (next == Pseudonormals::no_face || !clear[next] || seen[next]) continue;
        seen[next] = true;
        patch.push_back(next);
      }
    }
    constexpr std::size_t tries = 16;  // far from the origin there is no double just in front of most faces
    const auto tried = patch.begin() + static_cast<std::ptrdiff_t>(std::min(tries, patch.size()));
    if (std::none_of(patch.begin(), tried, [&](std::uint32_t face) { return is_solid_behind(face); }))
      continue;
    for (const std::uint32_t face : patch) simple_face_[face] = true;
    surface_.simple_triangles += patch.size();
  }
  if (surface_.simple_triangles == 0) return;

  surface_.method = Method::pseudonormals;
  clearance_ = sign::clearance * bounds_.extent().maxCoeff();
  simple_vertex_.assign(normals_.vertices(), true);
  for (std::uint32_t face = 0; face < normals_.faces(); ++face)
    if (!simple_face_[face])
      for (const std::uint32_t v : normals_.corners(face)) simple_vertex_[v] = false;
}

/// Is outside in front of a clear face and inside behind it? By the winding number of a point in front of it,
/// so near that nothing else can be between. False also where there is no such point.
bool SideFinder::is_solid_behind(std::uint32_t face) const {
  const auto [i, j, k] = normals_.corners(face);
  const Vec3 &a = normals_.position(i), &b = normals_.position(j), &c = normals_.position(k);
  const Vec3 middle = a + ((b - a) + (c - a)) / 3;
  double free_radius = std::numeric_limits<double>::infinity();
  const auto is_nearer = [&](const Aabb& box) {
    return box.squared_distance(middle) < free_radius * free_radius;
  };
  winding_.tree().visit(is_nearer, [&](const sign::TriangleTree::Item& item) {
    if (face_of_[item.index] == face) return;
    const PreparedTriangle triangle = prepare(item.corner[0], item.corner[1], item.corner[2], item.index);
    free_radius = std::min(free_radius, std::sqrt(squared_distance(triangle, middle)));
  });
  const Vec3 point = middle + free_radius / 8 * normals_.normal(face);
  const std::optional<Reading> reading = normals_.at_nearest(face, point);
  // The way from the point to the face stays within the half of what is free.
  if (!reading || !((point - middle).norm() + reading->distance < free_radius / 2)) return false;
  if (side_of_plane(a, b, c, point) <= 0) return false;
  const std::optional<int> in_front = winding_.count(point);
  return in_front && *in_front == (surface_.inside_out ? -1 : 0);
}

std::optional<SideFinder::Reading> SideFinder::reading_of_index(std::uint32_t index,
                                                                const Vec3& center) const noexcept {
  if (face_of_[index] == Pseudonormals::no_face) return std::nullopt;
  return normals_.at_nearest(face_of_[index], center);
}

/// The pieces of a polygon share its id: the nearest of them counts.
std::optional<SideFinder::Reading> SideFinder::reading(TriangleId id, const Vec3& center) const noexcept {
  if (ids_.empty()) return id < face_of_.size() ? reading_of_index(id, center) : std::nullopt;
  const auto [first, last] = std::equal_range(ids_.begin(), ids_.end(), id);
  std::optional<Reading> best;
  for (auto piece = first; piece != last; ++piece) {
    const auto other = reading_of_index(static_cast<std::uint32_t>(piece - ids_.begin()), center);
    if (!other) return std::nullopt;
    if (!best || other->distance < best->distance) best = other;
  }
  return best;
}

bool SideFinder::is_simple_at(const Reading& reading) const noexcept {
  if (!simple_face_[reading.face]) return false;
  switch (reading.feature) {
    case Pseudonormals::Feature::face:
      return true;
    case Pseudonormals::Feature::edge:
      return simple_face_[normals_.across(reading.face, reading.side)];
    case Pseudonormals::Feature::vertex:
      break;
  }
  return simple_vertex_[normals_.corners(reading.face)[reading.side]];
}

/// The proof, with e for `error` and d for the distance: docs/exactness.md, E21.
std::optional<Side> SideFinder::by_pseudonormal(const Vec3& center, const Contact& nearest) const noexcept {
  const double error = distance_error(bounds_, center);
  if (!(error <= clearance_)) return std::nullopt;
  const std::optional<Reading> near = reading(nearest.triangle, center);
  if (!near || !is_simple_at(*near)) return std::nullopt;
  // The detector's distance is within a quarter of the error of the least one, this one within as much of its
  // own.
  if (!(near->distance <= nearest.distance + error / 2)) return std::nullopt;
  const double reach = near->feature == Pseudonormals::Feature::face ? near->gap : sign::sharpest * near->gap;
  if (!(sign::sharpest * reach > error && reach * reach > 4 * error * near->distance)) return std::nullopt;
  constexpr double relative_error = 64 * 4 * 20 * unit_roundoff;
  const double uncertain = 32 * error / near->distance + relative_error;
  if (near->in_front > uncertain) return Side::outside;
  if (near->in_front < -uncertain) return Side::inside;
  return std::nullopt;
}

Side SideFinder::side_of_closed(const Vec3& center) const noexcept {
  const std::optional<int> count = winding_.count(center);
  return count ? side_of_count(*count, surface_.inside_out) : Side::on_surface;
}

Side SideFinder::side_of_open(const Vec3& center, TriangleId nearest) const noexcept {
  const std::optional<int> count = winding_.count(center);
  if (!count) return Side::on_surface;
  if (surface_.method == Method::none) return Side::undecided;
  const sign::Winding::Share curtains = winding_.of_curtains(center);
  const double winding = *count - curtains.value, whole = std::round(winding);
  if (!(std::abs(winding - whole) + curtains.error <= clear_share) || whole < 0) return Side::undecided;

  const std::optional<Reading> near = reading(nearest, center);
  constexpr double clearly = 0x1p-20;  // of the directions there are: no more than a tie-break against noise
  if (!near || !(std::abs(near->in_front) > clearly)) return Side::undecided;
  const Side by_number = whole == 0 ? Side::outside : Side::inside;
  const Side by_normal = near->in_front > 0 ? Side::outside : Side::inside;
  return by_number == by_normal ? by_number : Side::undecided;
}

Side SideFinder::side(const Vec3& center, const Contact& nearest, const Accuracy& accuracy,
                      std::uint64_t& counted) const noexcept {
  if (!center.allFinite()) return Side::undecided;
  if (surface_.method == Method::pseudonormals && is_exact(accuracy)) {
    const std::optional<Side> side = by_pseudonormal(center, nearest);
    if (side) return *side;
  }
  ++counted;
  return surface_.closed ? side_of_closed(center) : side_of_open(center, nearest.triangle);
}

std::size_t SideFinder::bytes() const noexcept {
  return winding_.bytes() + normals_.bytes() + face_of_.capacity() * sizeof(std::uint32_t) +
         (simple_face_.capacity() + simple_vertex_.capacity()) / 8 + ids_.capacity() * sizeof(TriangleId);
}

}  // namespace touchmark

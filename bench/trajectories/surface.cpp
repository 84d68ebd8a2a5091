#include "bench/trajectories/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/Geometry>

#include "core/geometry/point_triangle.h"

namespace touchmark::bench::trajectories {
namespace {

/// The edges from corner 0, in units of the largest coordinate, so that no product overflows or vanishes.
struct Edges {
  Vec3 e, f;
};
Edges edges(const TriangleMesh& mesh, std::size_t triangle, double unit) {
  const Vec3& origin = mesh.corner(triangle, 0);
  return {(mesh.corner(triangle, 1) - origin) / unit, (mesh.corner(triangle, 2) - origin) / unit};
}

double area(const Edges& t) { return t.e.cross(t.f).norm(); }
double length(const Edges& t) { return std::max({t.e.norm(), t.f.norm(), (t.f - t.e).norm()}); }
double one(const Edges&) { return 1; }

std::vector<double> running_sum(const TriangleMesh& mesh, double (*weight)(const Edges&)) {
  const double diagonal = mesh.diagonal();
  std::vector<double> sums;
  sums.reserve(mesh.size());
  double sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    sum += weight(edges(mesh, i, diagonal > 0 ? diagonal : 1));
    sums.push_back(sum);
  }
  return sums;
}

std::vector<double> weights(const TriangleMesh& mesh) {
  for (double (*weight)(const Edges&) : {&area, &length}) {
    std::vector<double> sums = running_sum(mesh, weight);
    if (sums.back() > 0) return sums;
  }
  return running_sum(mesh, &one);
}

Vec3 normal_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const PreparedTriangle prepared = prepare(mesh, triangle);
  // Where the point lies on the triangle the contact's normal is the face's, and defined even without area.
  return contact_on(prepared, prepared.corner[0], triangle).normal;
}

}  // namespace

Surface::Surface(const TriangleMesh& mesh)
    : mesh_(mesh), detector_(Nearest::build(mesh)), weight_up_to_(weights(mesh)) {}

Contact Surface::nearest(const Vec3& center) {
  const auto contact = detector_.nearest({center, 0}, std::numeric_limits<double>::infinity(), session_);
  if (!contact) throw std::logic_error("a trajectory left the finite numbers");
  return *contact;
}

SurfacePoint Surface::random_surface_point(support::Random& random) const {
  const double at = random.unit() * weight_up_to_.back();
  const auto found = std::ranges::upper_bound(weight_up_to_, at);
  const auto last = static_cast<std::ptrdiff_t>(mesh_.size()) - 1;
  const auto triangle = static_cast<std::uint32_t>(std::min(found - weight_up_to_.begin(), last));
  const double u = random.unit(), v = random.unit();
  return {support::point_in_triangle(mesh_.corner(triangle, 0), mesh_.corner(triangle, 1),
                                     mesh_.corner(triangle, 2), u, v),
          normal_of(mesh_, triangle)};
}

double Surface::thickness(const SurfacePoint& surface_point, double scale) {
  // The ball behind the place that touches it there has it for nearest until the ball reaches another part.
  // That is the other side only if it faces away: near an edge the ball meets the next face.
  for (int halvings = 10; halvings >= 2; --halvings) {
    const double radius = std::ldexp(scale, -halvings);
    const Contact contact = nearest(surface_point.point - radius * surface_point.normal);
    if (contact.distance < 0.9 * radius)
      return contact.normal.dot(surface_point.normal) > 0.5 ? radius
                                                            : std::numeric_limits<double>::infinity();
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace touchmark::bench::trajectories

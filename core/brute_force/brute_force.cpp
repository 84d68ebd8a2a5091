#include "core/brute_force/brute_force.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/certified_nearest.h"
#include "core/geometry/sphere_triangle_sweep.h"

namespace touchmark {

BruteForce BruteForce::build(const TriangleMesh& mesh, const Options&) {
  BruteForce detector;
  detector.connectivity_ = Connectivity(mesh);
  detector.bounds_ = mesh.bounds();
  detector.triangles_ = prepare(mesh);
  detector.ids_.assign(mesh.ids().begin(), mesh.ids().end());
  return detector;
}

void BruteForce::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  bounds_ = mesh.bounds();
  for (PreparedTriangle& triangle : triangles_)
    if (has_moved(triangle, mesh)) triangle = prepare(mesh, triangle.index);
}

bool BruteForce::touches(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  const double error = distance_error(bounds_, probe.center);
  if (std::isinf(error)) return nearest(probe, probe.radius, session).has_value();
  std::uint64_t tested = 0;
  const bool touching =
      std::any_of(triangles_.begin(), triangles_.end(), [&](const PreparedTriangle& triangle) {
        ++tested;
        const double distance = std::sqrt(squared_distance(triangle, probe.center));
        return is_within(triangle, distance, probe.center, probe.radius, error, session.work.exact_decisions);
      });
  session.work.triangles += tested;
  return touching;
}

std::optional<Contact> BruteForce::nearest(const Probe& probe, double reach,
                                           Session& session) const noexcept {
  session.work.triangles += triangles_.size();
  return nearest_of_all(triangles_, bounds_, probe.center, reach, ids_, session.work.exact_decisions);
}

std::optional<Impact> BruteForce::first_hit(const Sweep& sweep, Session& session) const noexcept {
  HitCandidate first;
  for (const PreparedTriangle& triangle : triangles_) {
    const std::optional<double> fraction = sweep_hit(triangle, sweep, std::min(first.fraction, 1.0));
    if (fraction) first = std::min(first, HitCandidate{*fraction, triangle.index});
  }
  session.work.triangles += triangles_.size();
  if (first.index >= triangles_.size()) return std::nullopt;
  // Touching at the start, which is decided exactly: of all the triangles there the nearest one counts.
  if (const auto start = nearest({sweep.from, sweep.radius}, sweep.radius, session)) return Impact{0, *start};
  return Impact{first.fraction,
                contact_on(triangles_[first.index], position_at(sweep, first.fraction), id(first.index))};
}

std::size_t BruteForce::bytes() const noexcept {
  return triangles_.capacity() * sizeof(PreparedTriangle) + ids_.capacity() * sizeof(TriangleId);
}

}  // namespace touchmark

#include "core/brute_force/brute_force.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/sphere_triangle_sweep.h"

namespace touchmark {

BruteForce BruteForce::build(const TriangleMesh& mesh, const Options&) {
  BruteForce detector;
  detector.triangles_ = prepare(mesh);
  detector.ids_.assign(mesh.ids().begin(), mesh.ids().end());
  return detector;
}

bool BruteForce::touches(const Probe& probe, Session& session) const noexcept {
  std::uint64_t tested = 0;
  const bool touching =
      std::any_of(triangles_.begin(), triangles_.end(), [&](const PreparedTriangle& triangle) {
        ++tested;
        return std::sqrt(squared_distance(triangle, probe.center)) <= probe.radius;
      });
  session.work.triangles += tested;
  return touching;
}

std::optional<Contact> BruteForce::nearest(const Probe& probe, double reach,
                                           Session& session) const noexcept {
  Candidate best;
  for (const PreparedTriangle& triangle : triangles_) {
    best = std::min(best, Candidate{squared_distance(triangle, probe.center), triangle.index});
  }
  session.work.triangles += triangles_.size();
  const bool found = best.index < triangles_.size();  // not so for a probe that is not a number
  if (!found || !(std::sqrt(best.squared_distance) <= reach)) return std::nullopt;
  return contact_on(triangles_[best.index], probe.center, id(best.index));
}

std::optional<Impact> BruteForce::first_hit(const Sweep& sweep, Session& session) const noexcept {
  HitCandidate first;
  for (const PreparedTriangle& triangle : triangles_) {
    const std::optional<double> fraction = sweep_hit(triangle, sweep, std::min(first.fraction, 1.0));
    if (fraction) first = std::min(first, HitCandidate{*fraction, triangle.index});
  }
  session.work.triangles += triangles_.size();
  if (first.index >= triangles_.size()) return std::nullopt;
  if (first.fraction > 0) {
    return Impact{first.fraction,
                  contact_on(triangles_[first.index], position_at(sweep, first.fraction), id(first.index))};
  }
  // Touching at the start: of all the triangles touched there the nearest one counts.
  return Impact{0, *nearest({sweep.from, sweep.radius}, sweep.radius, session)};
}

std::size_t BruteForce::bytes() const noexcept {
  return triangles_.capacity() * sizeof(PreparedTriangle) + ids_.capacity() * sizeof(TriangleId);
}

}  // namespace touchmark

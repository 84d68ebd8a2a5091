#include "core/brute_force/brute_force.h"

#include "core/flushed_denormals.h"

namespace touchmark {

BruteForce BruteForce::build(const TriangleMesh& mesh, const Options&) {
  check_flushed_denormals(mesh);
  BruteForce detector;
  detector.connectivity_ = Connectivity(mesh);
  detector.bounds_ = mesh.bounds();
  detector.triangles_ = prepare(mesh);
  detector.ids_ = mesh.triangle_ids();
  return detector;
}

void BruteForce::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  bounds_ = mesh.bounds();
  for (PreparedTriangle& triangle : triangles_)
    if (has_moved(triangle, mesh)) triangle = prepare(mesh, triangle.index);
}

bool BruteForce::touches(const Probe& probe, Session& session) const noexcept {
  return scan().touches(probe, session.work);
}

std::optional<Contact> BruteForce::nearest(const Probe& probe, double reach,
                                           Session& session) const noexcept {
  return scan().nearest(probe.center, reach, session.work);
}

std::optional<Impact> BruteForce::first_hit(const Sweep& sweep, Session& session) const noexcept {
  return scan().first_hit(sweep, session.work);
}

std::optional<Impact> BruteForce::first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                                   Session& session) const noexcept {
  if (!(motion.max_shift() > 0)) return first_hit(sweep, session);
  return scan().first_hit_moving(sweep, motion, session.work);
}

std::size_t BruteForce::contacts(const Probe& probe, double reach, Session& session,
                                 std::span<Contact> into) const noexcept {
  return scan().contacts(probe.center, reach, into, session.work);
}

std::size_t BruteForce::bytes() const noexcept {
  return triangles_.capacity() * sizeof(PreparedTriangle) + ids_.bytes();
}

}  // namespace touchmark

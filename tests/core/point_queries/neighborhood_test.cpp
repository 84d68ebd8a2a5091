// Contacts and sweeps of a session that goes on asking for both, as a proxy does: what is listed around the
// point changes no bit of an answer, wherever the point goes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

bool are_equal(const Contact& a, const Contact& b) {
  return a.triangle == b.triangle && a.distance == b.distance && a.point == b.point && a.normal == b.normal;
}

/// Walks at about the radius from the surface in steps of this length, mostly along it, and back to it.
void expect_brute_force_on_a_walk(const TriangleMesh& mesh, double radius, double step,
                                  const std::string& where) {
  const auto ours = SphereCluster::build(mesh);
  const auto all = BruteForce::build(mesh);
  SphereCluster::Session session, asks_nearest;
  BruteForce::Session plain;
  test::Random random(7);
  Vec3 place = mesh.bounds().max;
  for (int tick = 0; tick < 60; ++tick) {
    const Contact nearest = *all.nearest({place, 0}, infinity, plain);
    place = nearest.point + (radius + 1e-6 * step) * nearest.normal;
    const double distance = all.nearest({place, 0}, infinity, plain)->distance;
    for (const double reach : {distance, std::nextafter(distance, 0.0), 1.1 * radius}) {
      std::array<Contact, 16> found, expected;
      const std::size_t count = all.contacts({place, 0}, reach, plain, expected);
      ASSERT_EQ(ours.contacts({place, 0}, reach, session, found), count) << where << ", tick " << tick;
      const std::size_t fit = std::min(count, found.size());
      for (std::size_t i = 0; i < fit; ++i)
        ASSERT_TRUE(are_equal(found[i], expected[i])) << where << ", tick " << tick << ", contact " << i;
      ASSERT_EQ(ours.nearest_contacts({place, 0}, reach, asks_nearest, found), fit) << where;
      for (std::size_t i = 0; i < fit; ++i)
        ASSERT_TRUE(are_equal(found[i], expected[i])) << where << ", tick " << tick << ", nearest " << i;
    }
    const Vec3 any = step * random.direction();
    const Vec3 along = any - any.dot(nearest.normal) * nearest.normal;
    for (const Vec3& way : {along, any, Vec3(-step * nearest.normal)}) {
      const Sweep sweep{place, place + way, radius};
      const std::optional<Impact> found = ours.first_hit(sweep, session), hit = all.first_hit(sweep, plain);
      ASSERT_EQ(found.has_value(), hit.has_value()) << where << ", tick " << tick;
      ASSERT_EQ(ours.first_hit(sweep, asks_nearest).has_value(), hit.has_value())
          << where << ", tick " << tick;
      if (!hit) continue;
      ASSERT_EQ(found->fraction, hit->fraction) << where << ", tick " << tick;
      ASSERT_TRUE(are_equal(found->contact, hit->contact)) << where << ", tick " << tick;
    }
    place += along;
  }
}

TEST(Neighborhood, ChangesNoBitOfContactsAndSweepsAlongAWalk) {
  for (const test::NamedMesh& named : test::test_meshes()) {
    const double size = named.mesh.diagonal();
    for (const double radius : {0.003, 0.05, 0.4})
      for (const double step : {1e-5, 0.002, 0.1})
        expect_brute_force_on_a_walk(
            named.mesh, radius * size, step * size,
            named.name + ", radius " + std::to_string(radius) + ", step " + std::to_string(step));
  }
}

}  // namespace
}  // namespace touchmark

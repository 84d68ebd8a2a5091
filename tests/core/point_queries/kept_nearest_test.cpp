/// A session keeps the nearest triangle and lists those around it, so that most ticks of a slow point look at
/// nothing else: the bits of brute force, whatever is asked in between.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/same_contact.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using test::same_bits;
using Session = SphereCluster::Session;

/// A place near the mesh: as far off a random triangle's middle as this part of the mesh.
Vec3 near_surface(const test::NamedMesh& named, double part, test::Random& random) {
  const auto triangle = static_cast<std::uint32_t>(random.between(0, static_cast<double>(named.mesh.size())));
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < 3; ++k) middle += named.mesh.corner(triangle, k) / 3;
  return middle + random.point(part * named.size);
}

/// Walks so slowly that lists pay, in and out of the reach, with other questions in between.
void expect_walks_alike(const SphereCluster& detector, const test::NamedMesh& named, double step,
                        std::uint64_t seed) {
  test::Random random(seed);
  const auto every = BruteForce::build(named.mesh);
  BruteForce::Session plain;
  Session session;
  for (int walk = 0; walk < 6; ++walk) {
    const double reach = walk == 5 ? infinity : 0.004 * named.size * (1 + walk);
    Vec3 at = near_surface(named, 0.005, random);
    Vec3 heading = random.point(step * named.size);
    for (int tick = 0; tick < 120; ++tick) {
      if (tick % 7 == 0) heading = random.point(step * named.size);
      at += heading;
      ASSERT_TRUE(same_bits(detector.nearest({at, 0}, reach, session), every.nearest({at, 0}, reach, plain)))
          << named.name << ", step " << step << ", walk " << walk << ", tick " << tick;
      const Probe ball{at, std::min(reach, named.size)};
      if (tick % 11 == 3) {
        ASSERT_EQ(detector.touches(ball, session), every.touches(ball, plain)) << named.name << tick;
      }
      if (tick % 13 == 5) {
        const Sweep sweep{at, at + heading, 0.5 * ball.radius};
        const auto hit = detector.first_hit(sweep, session), expected = every.first_hit(sweep, plain);
        ASSERT_EQ(hit.has_value(), expected.has_value()) << named.name << ", tick " << tick;
        if (hit) {
          ASSERT_EQ(hit->fraction, expected->fraction) << named.name << ", tick " << tick;
        }
      }
      if (tick % 17 == 9) detector.prepare(session);
    }
  }
}

TEST(KeptNearest, GivesTheBitsOfBruteForce) {
  std::uint64_t seed = 1;
  for (const test::NamedMesh& named : test::test_meshes()) {
    const auto detector = SphereCluster::build(named.mesh);
    for (const double step : {0.0, 1e-12, 1e-7, 1e-5, 1e-4, 1e-3})
      expect_walks_alike(detector, named, step, ++seed);
  }
}

TEST(KeptNearest, GivesTheSameBitsAndWorkWithEveryInstructionSet) {
  const test::NamedMesh named{"bumpy", test::bumpy_sphere(40, 0.02, 3), 1};
  SphereCluster::Options narrow;
  narrow.widest = Simd::portable;
  const auto wide = SphereCluster::build(named.mesh), portable = SphereCluster::build(named.mesh, narrow);
  expect_walks_alike(portable, named, 1e-5, 3);
  Session one, other;
  Vec3 at(0.6, 0.7, 0.45);
  test::Random random(5);
  for (int tick = 0; tick < 500; ++tick) {
    at += random.point(1e-4);
    ASSERT_TRUE(same_bits(wide.nearest({at, 0}, 1, one), portable.nearest({at, 0}, 1, other))) << tick;
    ASSERT_EQ(one.work.total(), other.work.total()) << tick;
  }
}

/// Far from the origin doubles are so far apart that the rounding of positions counts.
TEST(KeptNearest, GivesTheBitsOfBruteForceWhereDoublesAreFarApart) {
  for (const double offset : {0x1p30, 0x1p44, 0x1p50}) {
    const Vec3 far = Vec3::Constant(offset);
    const test::NamedMesh named{"far off", test::soup(200, 0.3, 2).transformed(1, far), 1.3, far};
    for (const double step : {1e-6, 1e-3})
      expect_walks_alike(SphereCluster::build(named.mesh), named, step, 5);
  }
}

/// Between two plates, from one towards the other, so slowly that lists are made: what is listed near the
/// first is long within what the list was made for when the second, which is not listed, is nearer.
TEST(KeptNearest, SeesThatSomethingElseIsNearerAfterItMoved) {
  const TriangleMesh mesh({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}, {-2, -2, 1}, {2, -2, 1}, {0, 2, 1}},
                          {{0, 1, 2}, {3, 4, 5}});
  const auto detector = SphereCluster::build(mesh);
  for (const double step : {0.001, 0.01, 0.05}) {
    Session session;
    for (double z = 0.2003; z < 0.9; z += step) {
      const auto contact = detector.nearest({Vec3(0, -0.5, z), 0}, 2, session);
      ASSERT_TRUE(contact) << step;
      EXPECT_EQ(contact->triangle, z < 0.5 ? 0U : 1U) << step << ", " << z;
      EXPECT_NEAR(contact->distance, std::min(z, 1 - z), 1e-15) << step << ", " << z;
    }
  }
}

// A mesh of so few triangles is listed whole, and its list goes on however far the point leaps. A plane that
// was found far from where the list was made once passed over a corner that the point then came to.
TEST(KeptNearest, ComesBackToACornerAfterLeapsAsLongAsTheMesh) {
  test::Random random(8);
  for (const TriangleMesh& mesh : {TriangleMesh({{0, 0, 0}, {1, 2, 3}}, {{0, 1, 1}, {0, 0, 1}}),
                                   TriangleMesh({{0, 0, 0}, {1, 2, 3}, {2, 1, 0.3}, {0.7, 0.1, 2}},
                                                {{0, 1, 2}, {1, 3, 2}, {3, 0, 2}})}) {
    const auto detector = SphereCluster::build(mesh);
    const auto every = BruteForce::build(mesh);
    BruteForce::Session plain;
    Session session;
    const auto ask = [&](const Vec3& at, double reach) {
      return same_bits(detector.nearest({at, 0}, reach, session), every.nearest({at, 0}, reach, plain));
    };
    for (int round = 0; round < 300; ++round) {
      Vec3 at = mesh.vertices().front() + random.point(0.01);
      for (int tick = 0; tick < 10; ++tick) ASSERT_TRUE(ask(at += random.point(1e-5), infinity)) << round;
      for (const double reach : {0.0, 0.01, infinity}) ASSERT_TRUE(ask(random.point(4), reach)) << round;
      for (const Vec3& vertex : mesh.vertices())
        for (const double reach : {0.0, infinity}) ASSERT_TRUE(ask(vertex, reach)) << round;
    }
  }
}

// What was kept of a surface is not believed after the surface has moved.
TEST(KeptNearest, IsForgottenWhenTheMeshMoves) {
  const TriangleMesh before = test::bumpy_sphere(30, 0.02, 4);
  const TriangleMesh after = before.transformed(1, Vec3(0.01, 0, 0));
  auto detector = SphereCluster::build(before);
  Session session;
  Vec3 at(0.6, 0.7, 0.45);
  for (int tick = 0; tick < 50; ++tick) detector.nearest({at += Vec3(1e-6, 0, 0), 0}, 1, session);
  detector.update(after);
  Session fresh;
  EXPECT_TRUE(same_bits(detector.nearest({at, 0}, 1, session), detector.nearest({at, 0}, 1, fresh)));
}

TEST(KeptNearest, LooksAtOneTriangleInMostTicksOfASlowPoint) {
  const auto detector = SphereCluster::build(test::bumpy_sphere(60, 0.02, 4));
  Session session;
  Vec3 at(0.6, 0.7, 0.45);
  constexpr int ticks = 1000;
  int alone = 0;
  std::uint64_t before = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    detector.nearest({at += Vec3(2e-6, 1e-6, 0), 0}, 0.1, session);
    if (session.work.total() == before + 1) ++alone;
    before = session.work.total();
  }
  EXPECT_GE(alone, ticks * 9 / 10);
}

/// A reach that grows beyond what the list covers asks anew.
TEST(KeptNearest, IsAskedWithAnyReach) {
  const test::NamedMesh named{"bumpy", test::bumpy_sphere(60, 0.02, 4), 1};
  const auto detector = SphereCluster::build(named.mesh);
  test::Random random(8);
  Session session;
  Vec3 at(0.6, 0.7, 0.45);
  for (int tick = 0; tick < 400; ++tick) {
    at += random.point(1e-5);
    Session fresh;
    const double distance = detector.nearest({at, 0}, infinity, fresh)->distance;
    for (const double reach : {0.0, 0.5 * distance, std::nextafter(distance, 0.0), distance,
                               std::nextafter(distance, infinity), 1.5 * distance, 10 * distance}) {
      Session other;
      ASSERT_TRUE(
          same_bits(detector.nearest({at, 0}, reach, session), detector.nearest({at, 0}, reach, other)))
          << tick << ", " << reach / distance;
    }
  }
}

}  // namespace
}  // namespace touchmark

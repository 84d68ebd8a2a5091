/// One of many points, of which little is remembered, is answered as by a session that remembers nothing:
/// the same bits, however it moved.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/float_limits.h"
#include "core/search/many/nearest_many.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/same_contact.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using test::same_bits;

static_assert(FollowsPoints<SphereCluster>);
static_assert(sizeof(SphereCluster::FollowedPoint) == 384);

/// Walks from a random place, in steps as long as this part of the mesh.
void expect_followed_alike(const SphereCluster& detector, const test::NamedMesh& named, double step,
                           std::uint64_t seed) {
  test::Random random(seed);
  SphereCluster::FollowedPoint followed;
  Work work;
  for (int walk = 0; walk < 3; ++walk) {
    Vec3 at = test::random_point(named, random);
    for (int tick = 0; tick < 30; ++tick) {
      at += random.point(step * named.size);
      for (const double reach : {0.0, 0.01 * named.size, 0.3 * named.size, infinity}) {
        SphereCluster::Session fresh;
        ASSERT_TRUE(same_bits(detector.nearest({at, 0}, reach, followed, work),
                              detector.nearest({at, 0}, reach, fresh)))
            << named.name << ", step " << step << ", walk " << walk << ", tick " << tick << ", reach "
            << reach;
      }
    }
  }
}

TEST(FollowedPoint, IsAnsweredAsOneOfWhichNothingIsKnown) {
  std::uint64_t seed = 1;
  for (const test::NamedMesh& named : test::test_meshes()) {
    const auto detector = SphereCluster::build(named.mesh);
    for (const double step : {0.0, 1e-9, 1e-4, 1e-2, 0.3})
      expect_followed_alike(detector, named, step, ++seed);
  }
}

TEST(FollowedPoint, IsAnsweredAlikeByEveryInstructionSetAndForm) {
  const test::NamedMesh named = test::test_meshes().front();
  for (const Simd widest : {Simd::portable, Simd::avx2}) {
    SphereCluster::Options options;
    options.widest = widest;
    options.construction =
        widest == Simd::avx2 ? SphereCluster::Construction::lazy : SphereCluster::Construction::whole;
    expect_followed_alike(SphereCluster::build(named.mesh, options), named, 1e-3, 3);
  }
}

/// Far from the origin doubles are so far apart that the rounding of positions counts.
TEST(FollowedPoint, IsAnsweredAlikeWhereDoublesAreFarApart) {
  for (const double offset : {0x1p30, 0x1p44, 0x1p50}) {
    const Vec3 far = Vec3::Constant(offset);
    const test::NamedMesh named{"far off", test::soup(200, 0.3, 2).transformed(1, far), 1.3, far};
    expect_followed_alike(SphereCluster::build(named.mesh), named, 1e-2, 5);
  }
}

/// In the middle of a sphere everything is equally near, and on a fan's axis or among a thousand equal
/// triangles far more than a list holds.
TEST(FollowedPoint, IsAnsweredAlikeWhereMoreIsNearThanIsListed) {
  const test::NamedMesh inside{"inside", test::bumpy_sphere(30, 0, 1), 1e-3};
  const test::NamedMesh equal{"equal", test::repeated(1000), 1};
  for (const test::NamedMesh& named : {inside, equal}) {
    const auto detector = SphereCluster::build(named.mesh);
    for (const double step : {0.0, 1e-4, 0.1}) expect_followed_alike(detector, named, step, 7);
  }
}

/// Between two plates, from one towards the other: what is listed near the first is long within what the list
/// was made for when the second, which is not listed, is nearer.
TEST(FollowedPoint, SeesThatSomethingElseIsNearerAfterItMoved) {
  const TriangleMesh mesh({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}, {-2, -2, 1}, {2, -2, 1}, {0, 2, 1}},
                          {{0, 1, 2}, {3, 4, 5}});
  const auto detector = SphereCluster::build(mesh);
  for (const double step : {0.01, 0.05, 0.15, 0.35}) {
    SphereCluster::FollowedPoint followed;
    Work work;
    for (double z = 0.2003; z < 0.9; z += step) {
      const auto contact = detector.nearest({Vec3(0, -0.5, z), 0}, 2, followed, work);
      ASSERT_TRUE(contact) << step;
      EXPECT_EQ(contact->triangle, z < 0.5 ? 0U : 1U) << step << ", " << z;
      EXPECT_NEAR(contact->distance, std::min(z, 1 - z), 1e-15) << step << ", " << z;
    }
  }
}

TEST(FollowedPoint, LooksAtFewTrianglesWhereItHardlyMoves) {
  const auto detector = SphereCluster::build(test::bumpy_sphere(60, 0.02, 4));
  SphereCluster::FollowedPoint followed;
  Work work;
  Vec3 at(0.6, 0.7, 0.45);
  detector.nearest({at, 0}, 0.1, followed, work);
  const std::uint64_t first = work.total();
  for (int tick = 0; tick < 10; ++tick) detector.nearest({at += Vec3(1e-5, 0, 0), 0}, 0.1, followed, work);
  EXPECT_LE(work.total() - first, 10u * decltype(SphereCluster::FollowedPoint::list)::capacity);
}

}  // namespace
}  // namespace touchmark

// Far from the origin doubles are so far apart that a place of the detectors' own frame has none near it:
// what is measured at the nearest one must not be taken for what holds of the place.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/meshes/displaced.h"
#include "bench/support/random.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/search/linear_scan.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using bench::support::Random;

Vec3 somewhere(Random& random, double largest) {
  const auto one = [&] { return largest * (2 * random.unit() - 1); };
  const double x = one(), y = one(), z = one();
  return {x, y, z};
}

/// Of extent 1 but for bumps, and that many times its extent away, where its vertices are rounded.
TriangleMesh ball_at(int exponent, int rings = 8) {
  const Vec3 place = std::ldexp(1.0, exponent) * Vec3(1, -0.7, 0.3);
  return test::bumpy_sphere(rings, 0.05, 1).transformed(0.5, place);
}

TEST(FilterFrameFarAway, BoundsWhatRoundingDoesToAPlace) {
  Random random(3);
  double worst = 0;
  for (int exponent = 0; exponent <= 52; ++exponent) {
    const FilterFrame frame = FilterFrame::around(ball_at(exponent).bounds());
    const double bound = frame.from_frame_error(1.1);
    for (int i = 0; i < 200; ++i) {
      const Vec3 place = somewhere(random, 1.1);
      // The difference of two doubles so close together is one.
      const double off = (frame.to_frame(frame.from_frame(place)) - place).norm();
      ASSERT_LE(off, bound) << "2^" << exponent;
      if (exponent >= 20) worst = std::max(worst, off / bound);
    }
  }
  EXPECT_GT(worst, 0.3) << "a bound so far off serves nobody";
}

TEST(FilterFrameFarAway, HoldsTheMeshWhereItsMiddleIsRoundedToItsBorder) {
  const double far = 0x1p52;
  const Aabb box{Vec3::Constant(far), Vec3::Constant(far + 1)};
  const FilterFrame frame = FilterFrame::around(box);
  for (const Vec3& corner : {box.min, box.max}) {
    EXPECT_LE(frame.to_frame(corner).norm(), frame.radius());
    // tau is 8 u of the point's coordinates and of the farthest corner's distance.
    const double largest = frame.to_frame(corner).norm();
    EXPECT_GE(static_cast<double>(frame.plane_error(Vec3::Zero())), 8 * 0x1p-24 * largest * (1 - 0x1p-20));
  }
}

/// Doubles on the mesh, near it and anywhere about it: a session goes on from one to the next.
std::vector<Vec3> centers_near(const TriangleMesh& mesh, std::size_t count) {
  Random random(11);
  const Vec3 extent = mesh.bounds().extent();
  std::vector<Vec3> centers;
  while (centers.size() < count) {
    const Vec3& vertex = mesh.vertices()[random.below(mesh.vertices().size())];
    centers.push_back(vertex);
    centers.emplace_back(vertex + somewhere(random, 0.05).cwiseProduct(extent));
    centers.emplace_back(mesh.bounds().center() + somewhere(random, 0.7).cwiseProduct(extent));
  }
  return centers;
}

/// At the distance, at the doubles beside it, and a probe of radius 0, which touches where it is on the mesh.
template <class D>
void expect_answers_of_brute_force(const D& detector, const BruteForce& exact,
                                   const std::vector<Vec3>& centers, const std::string& name) {
  typename D::Session session;
  BruteForce::Session plain;
  std::size_t touches = 0, contacts = 0;
  for (const Vec3& center : centers) {
    const double distance = exact.nearest({center, 0}, infinity, plain)->distance;
    for (const double radius :
         {distance, std::nextafter(distance, infinity), std::nextafter(distance, 0), 0.0}) {
      const Probe probe{center, radius};
      touches += detector.touches(probe, session) != exact.touches(probe, plain) ? 1U : 0U;
      const auto contact = detector.nearest(probe, radius, session),
                 right = exact.nearest(probe, radius, plain);
      const bool same =
          contact.has_value() == right.has_value() &&
          (!contact || (contact->triangle == right->triangle && contact->point == right->point &&
                        contact->distance == right->distance));
      contacts += same ? 0 : 1;
    }
  }
  EXPECT_EQ(touches, 0U) << name;
  EXPECT_EQ(contacts, 0U) << name;
}

template <class D>
void expect_of_built_and_updated(const TriangleMesh& mesh, const typename D::Options& options,
                                 const std::string& name) {
  const BruteForce exact = BruteForce::build(mesh);
  const std::vector<Vec3> centers = centers_near(mesh, 60);
  expect_answers_of_brute_force(D::build(mesh, options), exact, centers, name);
  D updated = D::build(bench::meshes::displaced(mesh, 1), options);
  typename D::Session session;
  for (const Vec3& center : centers) updated.nearest({center, 0}, 0.1, session);  // makes what is made later
  updated.update(mesh);
  expect_answers_of_brute_force(updated, exact, centers, name + ", updated");
}

class FarFromOrigin : public testing::TestWithParam<int> {};

TEST_P(FarFromOrigin, EveryFormAnswersAsBruteForce) {
  const TriangleMesh mesh = ball_at(GetParam(), 10);
  constexpr auto lazy_groups = GridGroup::Construction::lazy;
  constexpr auto lazy_samples = SphereCluster::Construction::lazy;
  expect_of_built_and_updated<GridGroup>(mesh, {}, "grid-group");
  expect_of_built_and_updated<GridGroup>(mesh, {.construction = lazy_groups}, "grid-group, lazy");
  expect_of_built_and_updated<GridGroup>(mesh, {.bytes_per_triangle = 1e5, .construction = lazy_groups},
                                         "grid-group, lazy, much memory");
  expect_of_built_and_updated<GridGroup>(mesh, {.cell = 0.02}, "grid-group, small cells");
  expect_of_built_and_updated<SphereCluster>(mesh, {}, "sphere-cluster");
  expect_of_built_and_updated<SphereCluster>(mesh, {.construction = lazy_samples}, "sphere-cluster, lazy");
  expect_of_built_and_updated<AabbTree>(mesh, {}, "aabb-tree");
  expect_of_built_and_updated<PublishedGridGroup>(mesh, {}, "cubes as published");
  expect_of_built_and_updated<PublishedGridGroup>(mesh, {.shape = PublishedGridGroup::Shape::sphere},
                                                  "balls as published");
  expect_of_built_and_updated<PublishedSphereCluster>(mesh, {}, "spheres as published");
}

/// Doubles are a quarter apart, so a path of a few of them has no middle. A ball that comes down on a plane
/// of wide triangles just reaches it, or does not.
TEST(SweepFarAway, MeetsWhatOnlyTheEndOfAShortPathReaches) {
  constexpr double far = 0x1p50, step = 0.25;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < 25; ++i) vertices.emplace_back(far + 512 * (i % 5), far + 512 * (i / 5), far);
  for (std::uint32_t i = 0; i < 20; ++i) {
    if (i % 5 == 4) continue;
    triangles.push_back({i, i + 1, i + 5});
    triangles.push_back({i + 1, i + 6, i + 5});
  }
  const TriangleMesh mesh(vertices, triangles);
  const SphereCluster clusters = SphereCluster::build(mesh);
  const AabbTree tree = AabbTree::build(mesh);
  Random random(5);
  int hits = 0, passes = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto steps = [&](std::uint64_t below) { return step * static_cast<double>(random.below(below)); };
    const double radius = step + steps(4), way = step + steps(5), above = radius + steps(6);
    const double x = far + 300 + steps(4000), y = far + 300 + steps(4000);
    const Sweep sweep{{x, y, far + above}, {x + steps(3), y, far + above - way}, radius};
    const bool meets = above - way <= radius;
    AabbTree::Session in_tree;
    SphereCluster::Session in_clusters;
    ASSERT_EQ(clusters.first_hit(sweep, in_clusters).has_value(), meets) << i;
    ASSERT_EQ(tree.first_hit(sweep, in_tree).has_value(), meets) << i;
    ++(meets ? hits : passes);
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(passes, 100);
}

INSTANTIATE_TEST_SUITE_P(PowersOfTwo, FarFromOrigin, testing::Values(27, 31, 34, 42, 50, 52));

}  // namespace
}  // namespace touchmark

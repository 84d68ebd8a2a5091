#include "core/aabb_tree/aabb_tree.h"

#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"

namespace touchmark {
namespace {

using bench::support::Random;

static_assert(AnswersTouches<AabbTree> && AnswersNearest<AabbTree> && AnswersSweep<AabbTree>);

/// Triangles of all sizes, some degenerate, some twice, in one place and far from the origin.
TriangleMesh soup(std::size_t triangles, double offset) {
  Random random(triangles);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3 place = random.point();
    const double size = i % 7 == 0 ? 1 : 0.05;
    for (int k = 0; k < 3; ++k) vertices.push_back(Vec3::Constant(offset) + place + size * random.point());
    corners.push_back({3 * i, 3 * i + 1, i % 11 == 0 ? 3 * i : 3 * i + 2});
    if (i % 13 == 5) corners.back() = corners[i - 1];
  }
  return {std::move(vertices), std::move(corners)};
}

void expect_same(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->triangle, b->triangle);
  EXPECT_EQ(a->distance, b->distance);
  EXPECT_EQ(a->point, b->point);
  EXPECT_EQ(a->normal, b->normal);
}

TEST(AabbTree, AnswersAsBruteForceDoesToTheLastBit) {
  for (const double offset : {0.0, 1e6}) {
    for (const std::size_t size : {1u, 2u, 5u, 300u}) {
      const TriangleMesh mesh = soup(size, offset);
      const AabbTree tree = AabbTree::build(mesh, {2});
      const BruteForce reference = BruteForce::build(mesh);
      AabbTree::Session session;
      BruteForce::Session brute;
      Random random(99);
      for (int i = 0; i < 400; ++i) {
        const Probe probe{Vec3::Constant(offset) + 1.5 * random.point(), 0.1};
        for (const double reach : {0.0, 0.1, infinity}) {
          expect_same(tree.nearest(probe, reach, session), reference.nearest(probe, reach, brute));
        }
        EXPECT_EQ(tree.touches(probe, session), reference.touches(probe, brute));
        const Sweep sweep{probe.center, Vec3::Constant(offset) + 1.5 * random.point(), i % 3 == 0 ? 0 : 0.05};
        const auto hit = tree.first_hit(sweep, session), expected = reference.first_hit(sweep, brute);
        ASSERT_EQ(hit.has_value(), expected.has_value());
        if (hit) {
          EXPECT_EQ(hit->fraction, expected->fraction);
          expect_same(hit->contact, expected->contact);
        }
      }
    }
  }
}

TEST(AabbTree, LooksAtFewTrianglesOfMany) {
  const AabbTree tree = AabbTree::build(soup(3000, 0));
  AabbTree::Session session;
  tree.touches({{0, 0, 0}, 0.001}, session);
  EXPECT_LT(session.work.triangles, 1000u);
}

TEST(AabbTree, HundredsOfTrianglesInOnePlaceAreStillSplit) {
  std::vector<TriangleMesh::Corners> corners(500, {0, 1, 2});
  const AabbTree tree = AabbTree::build(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, corners));
  AabbTree::Session session;
  EXPECT_EQ(tree.nearest({{0.2, 0.2, 1}, 0}, infinity, session)->triangle, 0u);
}

TEST(AabbTree, GivesEveryTriangleWithinTheReachToABroadPhase) {
  const TriangleMesh mesh = soup(3000, 0);
  const AabbTree tree = AabbTree::build(mesh);
  const Vec3 center(0.1, 0.2, 0.3);
  Work work;
  std::set<std::uint32_t> visited;
  tree.for_each_near(center, 0.25, work, [&](const PreparedTriangle& t) { visited.insert(t.index); });
  std::size_t near = 0;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    if (squared_distance(prepare(mesh, i), center) > 0.25 * 0.25) continue;
    ++near;
    EXPECT_TRUE(visited.contains(i)) << i;
  }
  EXPECT_GT(near, 5u);
  EXPECT_LT(visited.size(), mesh.size());
}

TEST(AabbTree, AProbeThatIsNotANumberTouchesNothing) {
  const AabbTree tree = AabbTree::build(soup(20, 0));
  AabbTree::Session session;
  const Vec3 nan = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(tree.nearest({nan, 1}, infinity, session));
  EXPECT_FALSE(tree.touches({nan, 1}, session));
  EXPECT_FALSE(tree.first_hit({nan, {0, 0, 0}, 1}, session));
}

TEST(AabbTree, RefusesALeafSizeOutOfRange) {
  EXPECT_THROW(AabbTree::build(soup(3, 0), {0}), std::invalid_argument);
  EXPECT_THROW(AabbTree::build(soup(3, 0), {256}), std::invalid_argument);
}

TEST(AabbTree, MeasuresTheLastTriangleFirstAndOnlyAfterAContact) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 8}, {1, 0, 8}, {0, 1, 8}},
                          {{0, 1, 2}, {3, 4, 5}});
  const AabbTree tree = AabbTree::build(mesh);
  AabbTree::Session session;
  EXPECT_FALSE(tree.nearest({{0.25, 0.25, -4}, 0}, 0.5, session));
  EXPECT_FALSE(tree.touches({{0.25, 0.25, -4}, 0.5}, session));
  EXPECT_EQ(session.work.triangles, 0u);
  EXPECT_TRUE(tree.nearest({{0.25, 0.25, 7.75}, 0}, 0.5, session));
  const Work asked = session.work;
  EXPECT_TRUE(tree.touches({{0.25, 0.25, 7.75}, 0.5}, session));
  EXPECT_EQ(session.work.total(), asked.total() + 1);
  EXPECT_FALSE(tree.touches({{0.25, 0.25, -4}, 0.5}, session));
  const std::uint64_t triangles = session.work.triangles;
  EXPECT_FALSE(tree.touches({{0.25, 0.25, -4}, 0.5}, session));
  EXPECT_EQ(session.work.triangles, triangles);
}

}  // namespace
}  // namespace touchmark

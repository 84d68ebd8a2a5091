#include "core/grid_group/grid_group.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/search/plane_filter/plane_filter.h"
#include "tests/core/grid_group/meshes.h"
#include "tests/core/touch_then_nearest.h"

namespace touchmark {
namespace {

static_assert(AnswersTouches<GridGroup> && AnswersNearest<GridGroup> && AnswersSweep<GridGroup>);
static_assert(Updates<PublishedGridGroup> && AnswersTouches<PublishedGridGroup> &&
              AnswersNearest<PublishedGridGroup> && AnswersSweep<PublishedGridGroup> &&
              AnswersContacts<PublishedGridGroup>);

using Shape = PublishedGridGroup::Shape;
using testing::icosphere;

TriangleMesh two_triangles() {
  return TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
}

/// Calls check.operator()<D>(options) for the published forms and ours.
template <class Check>
void for_each_form(double cell, const Check& check) {
  for (const Shape shape : {Shape::cube, Shape::sphere, Shape::centered_sphere})
    check.template operator()<PublishedGridGroup>({.shape = shape, .cell = cell});
  check.template operator()<GridGroup>({.cell = cell});
}

template <class D>
std::optional<Contact> nearest(const D& detector, const Vec3& center, double reach) {
  typename D::Session session;
  return detector.nearest({center, 0}, reach, session);
}

TEST(GridGroup, FindsTheEdgeSharedByTwoCells) {
  // Cells of 0.5 have a border where the diagonal edge runs through (0.5, 0.5).
  for_each_form(0.5, [&]<class D>(const typename D::Options& options) {
    const auto contact = nearest(D::build(two_triangles(), options), {0.5, 0.5, 0.25}, 1);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->triangle, 0u);
    EXPECT_EQ(contact->distance, 0.25);
  });
}

TEST(GridGroup, FindsWhatLiesBeyondTheCellOfAProbeWithARadiusLargerThanACell) {
  for_each_form(0.1, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(two_triangles(), options);
    typename D::Session session;
    EXPECT_TRUE(detector.touches({{0.75, 0.75, 2}, 2}, session));
    EXPECT_FALSE(detector.touches({{0.75, 0.75, 2}, std::nextafter(2, 0)}, session));
    EXPECT_EQ(nearest(detector, {0.75, 0.75, 2}, 2)->triangle, 1u);
  });
}

// Sampled distances that claimed too much free space missed one point in seventy of these.
TEST(GridGroup, FindsWhatIsBarelyWithinReachOfAFreshSession) {
  testing::Random random(11);
  for (const TriangleMesh& mesh : {icosphere(5), testing::soup(3000, 0.05, 2), testing::one_spans_all()}) {
    const GridGroup detector = GridGroup::build(mesh);
    const BruteForce brute = BruteForce::build(mesh, {});
    for (int i = 0; i < 1500; ++i) {
      const Vec3 center = random.point(i % 3 == 0 ? 3 : 1.3);
      BruteForce::Session session;
      const double distance = brute.nearest({center, 0}, infinity, session)->distance;
      ASSERT_TRUE(nearest(detector, center, distance * (1 + 1e-9))) << center.transpose();
      ASSERT_FALSE(nearest(detector, center, distance * (1 - 1e-9))) << center.transpose();
    }
  }
}

// A touch ends at any triangle within the radius; what a session remembers of it is no bound of the nearest.
TEST(GridGroup, ATouchTellsNothingOfWhatIsNearerThanWhatItFound) {
  testing::Random random(12);
  for (const TriangleMesh& mesh : {icosphere(5), testing::soup(3000, 0.05, 2), testing::one_spans_all()}) {
    const GridGroup detector = GridGroup::build(mesh);
    const BruteForce brute = BruteForce::build(mesh, {});
    GridGroup::Session session;
    for (int i = 0; i < 1500; ++i) {
      const Vec3 center = random.point(i % 3 == 0 ? 3 : 1.3);
      BruteForce::Session measured;
      const double distance = brute.nearest({center, 0}, infinity, measured)->distance;
      const auto nearest = test::nearest_after_touches(detector, center, distance, session);
      ASSERT_FALSE(HasFailure());
      ASSERT_TRUE(nearest) << center.transpose();
      ASSERT_EQ(nearest->distance, distance) << center.transpose();
    }
  }
}

TEST(GridGroup, FindsTheNearestFromFarAwayWithoutLimit) {
  for_each_form(0, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(icosphere(3), options);
    for (const double away : {10.0, 1e3, 1e8, 1e12}) {
      const auto contact = nearest(detector, {0, 0, away}, infinity);
      ASSERT_TRUE(contact) << away;
      EXPECT_NEAR(contact->distance / (away - 1), 1, 0.02) << away;
    }
  });
}

TEST(GridGroup, AllTrianglesOfASphereAreCandidatesAtItsCentre) {
  for_each_form(0, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(icosphere(4), options);
    EXPECT_NEAR(nearest(detector, {0, 0, 0}, infinity)->distance, 1, 0.01);
    EXPECT_FALSE(nearest(detector, {0, 0, 0}, 0.9));
  });
}

TEST(GridGroup, AProbeThatIsNotANumberTouchesNothing) {
  for_each_form(0, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(icosphere(1), options);
    typename D::Session session;
    for (int k = 0; k < 3; ++k) {
      Vec3 center = Vec3::Zero();
      center[k] = std::nan("");
      EXPECT_FALSE(detector.nearest({center, 1}, infinity, session));
      EXPECT_FALSE(detector.touches({center, infinity}, session));
      EXPECT_FALSE(detector.first_hit({center, Vec3::Zero(), 1}, session));
    }
    EXPECT_FALSE(detector.nearest({Vec3::Zero(), 0}, std::nan(""), session));
    EXPECT_FALSE(detector.touches({Vec3::Zero(), std::nan("")}, session));
    EXPECT_FALSE(detector.nearest({Vec3(0, 0, 1), 0}, -1, session));
    // And leaves the session usable.
    EXPECT_TRUE(detector.nearest({Vec3(0, 0, 1), 0}, 1, session));
  });
}

TEST(GridGroup, AnInfinitelyFarProbeTouchesNothingWithinAFiniteReach) {
  for_each_form(0, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(icosphere(1), options);
    typename D::Session session;
    EXPECT_FALSE(detector.nearest({Vec3(infinity, 0, 0), 0}, 1e300, session));
    EXPECT_FALSE(detector.touches({Vec3(0, -infinity, 0), 1}, session));
  });
}

TEST(GridGroup, ReportsTheIdsOfTheFile) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {7, 9});
  for_each_form(0, [&]<class D>(const typename D::Options& options) {
    EXPECT_EQ(nearest(D::build(mesh, options), {0.75, 0.75, 2}, infinity)->triangle, 9u);
  });
}

TEST(GridGroup, ASweepStopsAtTheSurface) {
  for_each_form(0.2, [&]<class D>(const typename D::Options& options) {
    const D detector = D::build(two_triangles(), options);
    typename D::Session session;
    const auto impact = detector.first_hit({{0.75, 0.75, 2}, {0.75, 0.75, -2}, 0.5}, session);
    ASSERT_TRUE(impact);
    EXPECT_LE(impact->fraction, 1.5 / 4);
    EXPECT_GE(impact->fraction, 1.5 / 4 - 0x1p-50);
    EXPECT_EQ(impact->contact.triangle, 1u);
    EXPECT_FALSE(detector.first_hit({{0.75, 0.75, 2}, {0.75, 0.75, 0.6}, 0.5}, session));
    EXPECT_FALSE(detector.first_hit({{3, 3, 2}, {3, 3, -2}, 0.5}, session));
    EXPECT_EQ(detector.first_hit({{0.75, 0.75, 0.25}, {0.75, 0.75, 5}, 0.5}, session)->fraction, 0);
  });
}

template <class D>
std::string refusal(const typename D::Options& options) {
  try {
    D::build(two_triangles(), options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GridGroup, RefusesOptionsByName) {
  EXPECT_NE(refusal<GridGroup>({.cell = -1}).find("cell is -1"), std::string::npos);
  EXPECT_NE(refusal<GridGroup>({.cell = std::nan("")}).find("cell is nan"), std::string::npos);
  EXPECT_NE(refusal<GridGroup>({.cell = infinity}).find("cell is inf"), std::string::npos);
  EXPECT_NE(refusal<PublishedGridGroup>({.cell = infinity}).find("cell is inf"), std::string::npos);
  EXPECT_NE(refusal<PublishedGridGroup>({.cell = -1}).find("cell is -1"), std::string::npos);
  EXPECT_NE(refusal<PublishedGridGroup>({.cell = std::nan("")}).find("cell is nan"), std::string::npos);
  EXPECT_NE(refusal<GridGroup>({.bytes_per_triangle = 10}).find("bytes_per_triangle is 10"),
            std::string::npos);
  EXPECT_NE(refusal<GridGroup>({.bytes_per_triangle = std::nan("")}).find("bytes_per_triangle is nan"),
            std::string::npos);
}

TEST(GridGroupScan, TestsEveryGroupAndThenTheTrianglesOfThoseThatHoldTheProbe) {
  // Four cells of 8 by 8 squares; the probe is well inside one of them.
  const auto detector = PublishedGridGroup::build(testing::plate(16), {.cell = 0.53});
  ASSERT_EQ(detector.groups(), 4u);
  PublishedGridGroup::Session session;
  EXPECT_TRUE(detector.nearest({{0.2, 0.2, 0.01}, 0}, 0.02, session));
  EXPECT_EQ(session.work.cells, 4u);
  EXPECT_GE(session.work.triangles, 8u * 8u * 2u);
  EXPECT_LE(session.work.triangles, 9u * 9u * 2u);
  EXPECT_FALSE(detector.nearest({{5, 5, 5}, 0}, 0.1, session));
  EXPECT_EQ(session.work.cells, 8u);
}

TEST(GridGroupScan, SpheresHoldTheProbeAtLeastAsOftenAsCuboids) {
  // A ball around a flat cell is far larger than its cuboid, so more triangles are tested.
  const TriangleMesh mesh = icosphere(4);
  std::uint64_t triangles[2] = {0, 0};
  for (const Shape shape : {Shape::cube, Shape::sphere}) {
    const auto detector = PublishedGridGroup::build(mesh, {.shape = shape, .groups = 200});
    PublishedGridGroup::Session session;
    testing::Random random(12);
    for (int i = 0; i < 200; ++i) detector.nearest({random.point(1).normalized(), 0}, 0.01, session);
    triangles[shape == Shape::sphere] = session.work.triangles;
  }
  EXPECT_GT(triangles[1], triangles[0]);
}

TEST(GridGroupScan, ACenteredSphereSitsOnTheCuboidAndIsNoSmallerThanTheSmallest) {
  const TriangleMesh mesh = icosphere(3);
  const auto of_shape = [&](Shape shape) {
    return PublishedGridGroup::build(mesh, {.shape = shape, .cell = 0.3});
  };
  const auto cuboids = of_shape(Shape::cube), smallest = of_shape(Shape::sphere),
             centered = of_shape(Shape::centered_sphere);
  ASSERT_EQ(centered.spheres().size(), cuboids.groups());
  for (std::size_t group = 0; group < cuboids.groups(); ++group) {
    const Sphere& sphere = centered.spheres()[group];
    EXPECT_EQ(sphere.center, Vec3(cuboids.boxes()[group].center()));
    EXPECT_GE(sphere.radius * (1 + 1e-12), smallest.spheres()[group].radius);
    double farthest = 0;
    for (const std::uint32_t triangle : centered.members(group))
      for (int k = 0; k < 3; ++k)
        farthest = std::max(farthest, (mesh.corner(triangle, k) - sphere.center).norm());
    EXPECT_NEAR(sphere.radius, farthest, 1e-12);
  }
}

TEST(GridGroupScan, MakesAboutAsManyGroupsAsAsked) {
  for (const std::size_t wanted : {50u, 379u, 783u, 2115u}) {
    const auto detector = PublishedGridGroup::build(icosphere(5), {.groups = wanted});
    EXPECT_GT(detector.groups(), wanted / 2);
    EXPECT_LT(detector.groups(), wanted * 2);
    EXPECT_FALSE(detector.coarsened());
  }
}

TEST(GridGroupScan, SaysSoWhenTheCellsAskedForWouldBeTooMany) {
  const auto detector = PublishedGridGroup::build(icosphere(2), {.cell = 1e-7});
  EXPECT_TRUE(detector.coarsened());
  EXPECT_GT(detector.cell(), 1e-7);
  EXPECT_FALSE(PublishedGridGroup::build(icosphere(2), {.cell = 0.1}).coarsened());
}

TEST(GridGroupScan, EveryGroupEnclosesItsTrianglesAndEveryTriangleIsInAGroup) {
  for (const testing::NamedMesh& named : testing::nasty_meshes()) {
    const TriangleMesh& mesh = named.mesh;
    if (!FilterFrame::fits(mesh.bounds())) continue;  // it has no groups
    for (const Shape shape : {Shape::cube, Shape::sphere, Shape::centered_sphere}) {
      const auto scan = PublishedGridGroup::build(mesh, {shape, 0.1 * mesh.diagonal(), 0});
      std::vector<bool> grouped(mesh.size());
      for (std::size_t group = 0; group < scan.groups(); ++group) {
        for (const std::uint32_t triangle : scan.members(group)) {
          grouped[triangle] = true;
          for (int i = 0; i < 3; ++i) {
            const Vec3& corner = mesh.corner(triangle, i);
            EXPECT_TRUE(shape == Shape::cube ? scan.boxes()[group].contains(corner)
                                             : scan.spheres()[group].contains(corner))
                << named.name;
          }
        }
      }
      EXPECT_EQ(std::count(grouped.begin(), grouped.end(), false), 0) << named.name;
    }
  }
}

TEST(GridGroup, CountsTheMeshInItsBytes) {
  const TriangleMesh mesh = icosphere(3);
  for_each_form(0, [&]<class D>(const typename D::Options& options) {
    EXPECT_GE(D::build(mesh, options).bytes(), mesh.size() * 9 * sizeof(double));
  });
}

TEST(GridGroup, ASessionOfAnotherDetectorChangesNoAnswer) {
  const GridGroup large = GridGroup::build(icosphere(3)), small = GridGroup::build(two_triangles());
  GridGroup::Session session;
  ASSERT_TRUE(large.nearest({{0, 0.9, 0}, 0}, infinity, session));
  EXPECT_EQ(small.nearest({{0.75, 0.75, 2}, 0}, infinity, session)->distance, 2);
  EXPECT_FALSE(large.nearest({{5, 0, 0}, 0}, 1, session));
  EXPECT_TRUE(small.nearest({{0.75, 0.75, 0.5}, 0}, 1, session));
}

}  // namespace
}  // namespace touchmark

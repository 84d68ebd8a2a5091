#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include "baselines/embree/embree_detector.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "tests/baselines/follows.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {
namespace {

static_assert(AnswersTouches<EmbreeDetector> && AnswersNearest<EmbreeDetector> &&
              !AnswersSweep<EmbreeDetector>);

using Options = EmbreeDetector::Options;
using Geometry = EmbreeDetector::Geometry;
using Quality = EmbreeDetector::Quality;

TriangleMesh soup(double scale, double offset) {
  Random random(5);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const Vec3 place = random.point();
    for (int k = 0; k < 3; ++k)
      vertices.push_back(scale * (Vec3::Constant(offset) + place + (i % 9 == 0 ? 1 : 0.05) * random.point()));
    corners.push_back({3 * i, 3 * i + 1, i % 17 == 0 ? 3 * i : 3 * i + 2});
  }
  return {std::move(vertices), std::move(corners)};
}

/// Octahedra about the origin: triangles of good shape, with corners and edges in common.
TriangleMesh octahedra(std::uint32_t count, double scale) {
  Random random(6);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 center = random.point();
    const double size = 0.05 * (1.5 + random.between(-1, 1));
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0})
        vertices.push_back(scale * (center + sign * size * Vec3::Unit(axis)));
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      corners.push_back({6 * i + (octant & 1), 6 * i + 2 + (octant >> 1 & 1), 6 * i + 4 + (octant >> 2)});
  }
  return {std::move(vertices), std::move(corners)};
}

TEST(Embree, AnswersAsBruteForceDoesToTheLastBit) {
  const std::vector<Options> forms = {{Geometry::user, Quality::medium, true},
                                      {Geometry::user, Quality::medium, true, Asking::plain},
                                      {Geometry::triangle_exact, Quality::medium, true},
                                      {Geometry::triangle_exact, Quality::high, false}};
  struct Place {
    double scale, offset;
  };
  for (const Place place : {Place{1, 0}, Place{1, 1e6}, Place{1e-6, 0}, Place{1e6, 0}}) {
    const TriangleMesh mesh = soup(place.scale, place.offset);
    const BruteForce reference = BruteForce::build(mesh);
    for (const Options& form : forms) {
      const EmbreeDetector embree = EmbreeDetector::build(mesh, form);
      EmbreeDetector::Session session;
      BruteForce::Session brute;
      Random random(8);
      for (int i = 0; i < 300; ++i) {
        const Probe probe{
            place.scale * (Vec3::Constant(place.offset) + (i % 50 == 0 ? 40 : 1.3) * random.point()),
            place.scale * 0.1};
        EXPECT_EQ(embree.touches(probe, session), reference.touches(probe, brute));
        for (const double reach : {0.0, probe.radius, infinity}) {
          const auto contact = embree.nearest(probe, reach, session),
                     expected = reference.nearest(probe, reach, brute);
          ASSERT_EQ(contact.has_value(), expected.has_value());
          if (!contact) continue;
          EXPECT_EQ(contact->triangle, expected->triangle);
          EXPECT_EQ(contact->distance, expected->distance);
          EXPECT_EQ(contact->point, expected->point);
        }
      }
    }
  }
}

TEST(Embree, SinglePrecisionIsWithinWhatItClaimsOnTrianglesOfGoodShape) {
  const Options form{Geometry::triangle};
  for (const double scale : {1.0, 1e-6, 1e6}) {
    const TriangleMesh mesh = octahedra(200, scale);
    const BruteForce reference = BruteForce::build(mesh);
    const EmbreeDetector embree = EmbreeDetector::build(mesh, form);
    const Accuracy accuracy = embree.accuracy();
    EXPECT_EQ(accuracy.guarantee, Guarantee::approximate);
    EmbreeDetector::Session session;
    BruteForce::Session brute;
    Random random(9);
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      const Probe probe{scale * 1.3 * random.point(), 0};
      const auto contact = embree.nearest(probe, infinity, session),
                 expected = reference.nearest(probe, infinity, brute);
      ASSERT_TRUE(contact && expected);
      const double error = std::abs(contact->distance - expected->distance);
      EXPECT_LE(error, accuracy.relative * 3 * scale + accuracy.absolute);
      EXPECT_NEAR((probe.center - contact->point).norm(), contact->distance, 1e-6 * scale);
      worst = std::max(worst, error / scale);
      const double apart = 4 * (accuracy.relative * 3 * scale + accuracy.absolute);
      EXPECT_TRUE(embree.touches({probe.center, expected->distance + apart}, session));
      EXPECT_FALSE(embree.touches({probe.center, expected->distance - apart}, session));
    }
    EXPECT_GT(worst, 1e-10);  // doubles would not err as much
  }
}

TEST(Embree, ForgettingTheSessionChangesNoAnswerInAnyForm) {
  const TriangleMesh mesh = octahedra(200, 1);
  for (const Geometry geometry : {Geometry::user, Geometry::triangle, Geometry::triangle_exact}) {
    for (const Asking query : {Asking::checked, Asking::plain}) {
      const EmbreeDetector embree = EmbreeDetector::build(mesh, {geometry, Quality::medium, true, query});
      EmbreeDetector::Session kept;
      Random random(10);
      for (int i = 0; i < 2000; ++i) {
        EmbreeDetector::Session fresh;
        const Probe probe{1.2 * random.point(), 0.05};
        const double reach = i % 5 == 0 ? infinity : 0.1;
        const auto contact = embree.nearest(probe, reach, kept), again = embree.nearest(probe, reach, kept),
                   alone = embree.nearest(probe, reach, fresh);
        ASSERT_EQ(contact.has_value(), alone.has_value());
        if (contact) {
          EXPECT_EQ(contact->triangle, alone->triangle);
          EXPECT_EQ(contact->distance, alone->distance);
          EXPECT_EQ(again->triangle, alone->triangle);
        }
        EXPECT_EQ(embree.touches(probe, kept), embree.touches(probe, fresh));
      }
    }
  }
}

TEST(Embree, AsksNothingFartherFromTheBoxThanTheReach) {
  const TriangleMesh mesh = soup(1, 0);
  const Aabb box = mesh.bounds();
  for (const Geometry geometry : {Geometry::user, Geometry::triangle}) {
    const EmbreeDetector embree = EmbreeDetector::build(mesh, {geometry});
    EmbreeDetector::Session session;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 center = box.center();
      center[axis] = box.max[axis] + 0.25;
      EXPECT_FALSE(embree.nearest({center, 0}, 0.125, session));
      EXPECT_FALSE(embree.touches({center, 0.125}, session));
    }
    EXPECT_EQ(session.work.triangles, 0u);
  }
}

TEST(Embree, MeasuresTheLastTriangleFirstAndOnlyAfterAContact) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 8}, {1, 0, 8}, {0, 1, 8}},
                          {{0, 1, 2}, {3, 4, 5}});
  const EmbreeDetector embree = EmbreeDetector::build(mesh);
  EmbreeDetector::Session session;
  EXPECT_FALSE(embree.nearest({{0.25, 0.25, 4}, 0}, 0.5, session));
  EXPECT_EQ(session.work.triangles, 0u);
  EXPECT_TRUE(embree.touches({{0.25, 0.25, 7.75}, 0.5}, session));
  EXPECT_EQ(session.last, 1u);
  const auto asked = session.work.triangles;
  EXPECT_TRUE(embree.touches({{0.25, 0.25, 7.8}, 0.5}, session));
  EXPECT_EQ(session.work.triangles, asked + 1);
}

TEST(Embree, LeavesTheFloatingPointModesAlone) {
  const unsigned before = _mm_getcsr();
  const EmbreeDetector embree = EmbreeDetector::build(soup(1, 0));
  EmbreeDetector::Session session;
  embree.nearest({{0, 0, 0}, 0}, infinity, session);
  constexpr unsigned modes = 0xffc0;  // all but the sticky exception flags
  EXPECT_EQ(_mm_getcsr() & modes, before & modes);
}

TEST(Embree, CountsItsMemory) {
  const TriangleMesh mesh = soup(1, 0);
  EXPECT_GT(EmbreeDetector::build(mesh).bytes(), mesh.size() * (sizeof(PreparedTriangle) + 16));
}

TEST(Embree, AProbeThatIsNotANumberTouchesNothing) {
  const EmbreeDetector embree = EmbreeDetector::build(soup(1, 0));
  EmbreeDetector::Session session;
  const Vec3 nan = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(embree.nearest({nan, 1}, infinity, session));
  EXPECT_FALSE(embree.touches({nan, 1}, session));
}

TEST(Embree, FollowsVerticesThatMove) {
  const TriangleMesh mesh = soup(1, 0);
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (std::size_t i = 0; i < vertices.size(); i += 2) vertices[i] += Vec3(0.1, 0.3, -0.2);
  const TriangleMesh other(vertices, {mesh.triangles().begin(), mesh.triangles().end()});
  for (const EmbreeDetector::Options& form : std::vector<EmbreeDetector::Options>{
           {},
           {EmbreeDetector::Geometry::triangle_exact, EmbreeDetector::Quality::medium, true},
           {EmbreeDetector::Geometry::user, EmbreeDetector::Quality::refit, true},
           {EmbreeDetector::Geometry::triangle_exact, EmbreeDetector::Quality::refit, false}})
    expect_to_follow<EmbreeDetector>(mesh, other, form);
}

}  // namespace
}  // namespace touchmark::baselines

#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include "baselines/embree/embree_detector.h"
#include "core/brute_force/brute_force.h"
#include "tests/baselines/follows.h"

namespace touchmark::baselines {
namespace {

static_assert(AnswersTouches<EmbreeDetector> && AnswersNearest<EmbreeDetector> &&
              !AnswersSweep<EmbreeDetector>);

constexpr double infinity = std::numeric_limits<double>::infinity();
using Options = EmbreeDetector::Options;
using Geometry = EmbreeDetector::Geometry;
using Quality = EmbreeDetector::Quality;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double coordinate() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }
  Vec3 point() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
};

TriangleMesh soup(double scale, double offset) {
  Random random(5);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const Vec3 place = random.point();
    for (int k = 0; k < 3; ++k) {
      vertices.push_back(scale * (Vec3::Constant(offset) + place + (i % 9 == 0 ? 1 : 0.05) * random.point()));
    }
    corners.push_back({3 * i, 3 * i + 1, i % 17 == 0 ? 3 * i : 3 * i + 2});
  }
  return {std::move(vertices), std::move(corners)};
}

TEST(Embree, AnswersAsBruteForceDoesToTheLastBit) {
  const std::vector<Options> forms = {{Geometry::user, Quality::medium, true},
                                      {Geometry::triangle, Quality::medium, true},
                                      {Geometry::triangle, Quality::high, false}};
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
           {EmbreeDetector::Geometry::triangle, EmbreeDetector::Quality::medium, true},
           {EmbreeDetector::Geometry::user, EmbreeDetector::Quality::refit, true},
           {EmbreeDetector::Geometry::triangle, EmbreeDetector::Quality::refit, false}}) {
    expect_to_follow<EmbreeDetector>(mesh, other, form);
  }
}

}  // namespace
}  // namespace touchmark::baselines

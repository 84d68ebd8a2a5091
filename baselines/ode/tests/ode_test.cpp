#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <ode/ode.h>

#include "baselines/ode/ode_detector.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "tests/baselines/asking.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {
namespace {

using Sides = OdeDetector::Sides;

static_assert(AnswersTouches<OdeDetector> && AnswersNearest<OdeDetector> && !AnswersSweep<OdeDetector>);

TEST(Ode, KnowsAMeshFromTheSideOfItsNormalsUnlessItIsThereTwice) {
  const OdeDetector front = OdeDetector::build(square()),
                    both = OdeDetector::build(square(), {.sides = Sides::both});
  OdeDetector::Session session, other;
  const Probe above{{0.25, 0.25, 0.3}, 0.5}, below{{0.25, 0.25, -0.3}, 0.5};
  EXPECT_TRUE(front.touches(above, session));
  EXPECT_FALSE(front.touches(below, session));
  EXPECT_TRUE(both.touches(above, other));
  EXPECT_TRUE(both.touches(below, other));
  const auto contact = both.nearest(below, 0.5, other);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->triangle, 0u);
  EXPECT_DOUBLE_EQ(contact->distance, 0.3);
  EXPECT_EQ(contact->normal, Vec3(0, 0, -1));
}

TEST(Ode, OnBothSidesFindsWhatBruteForceFindsWithinItsAccuracy) {
  for (const TriangleMesh& mesh : {bumps(12), soup(200, 5)}) {
    const OdeDetector ode = OdeDetector::build(mesh, {.sides = Sides::both});
    const BruteForce reference = BruteForce::build(mesh);
    const Accuracy accuracy = ode.accuracy();
    OdeDetector::Session session;
    BruteForce::Session other;
    Random random(7);
    int found = 0;
    for (int i = 0; i < 400; ++i) {
      const Probe probe{1.3 * random.point(), 0};
      for (const double reach : {0.2, infinity}) {
        const auto contact = ode.nearest(probe, reach, session),
                   expected = reference.nearest(probe, reach, other);
        ASSERT_EQ(contact.has_value(), expected.has_value()) << i;
        if (!contact) continue;
        ++found;
        EXPECT_NEAR(contact->distance, expected->distance, accuracy.absolute + 3 * accuracy.relative) << i;
      }
    }
    EXPECT_GT(found, 400);
  }
}

TEST(Ode, GivesTheSameAnswerWhateverItIsAskedFirst) {
  expect_asking_changes_no_answer<OdeDetector>(bumps(20), {.sides = Sides::front}, true);
  expect_asking_changes_no_answer<OdeDetector>(bumps(20), {.sides = Sides::both}, true);
}

/// All triangles of a dense sheet touch the ball: more than dCollide is given room for.
TEST(Ode, FindsTheNearestOfMoreContactsThanItHasRoomFor) {
  const TriangleMesh mesh = bumps(80);  // 12,800 triangles
  const OdeDetector ode = OdeDetector::build(mesh, {.sides = Sides::both, .query = Asking::plain});
  const BruteForce reference = BruteForce::build(mesh);
  OdeDetector::Session session;
  BruteForce::Session other;
  const Probe probe{{0.1, 0.2, 5}, 0};
  const auto contact = ode.nearest(probe, 20, session), expected = reference.nearest(probe, 20, other);
  ASSERT_TRUE(contact && expected);
  EXPECT_NEAR(contact->distance, expected->distance, 1e-5);
}

TEST(Ode, RefusesProbesThatCannotBeSquared) {
  const OdeDetector ode = OdeDetector::build(square());
  OdeDetector::Session session;
  EXPECT_FALSE(ode.touches({{1e200, 0, 0}, 1}, session));
  EXPECT_FALSE(ode.nearest({{std::nan(""), 0, 0}, 1}, 1, session));
}

/// Traps of the library itself, which README.md names.
class OdeTraps : public testing::Test {
 protected:
  OdeTraps() {
    dInitODE2(0);
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double), 4, corners_.data(), 6,
                                3 * sizeof(dTriIndex));
    mesh_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
    ball_ = dCreateSphere(nullptr, 0.5);
  }
  ~OdeTraps() override {
    dGeomDestroy(ball_);
    dGeomDestroy(mesh_);
    dGeomTriMeshDataDestroy(data_);
  }

  std::vector<dContactGeom> collide(double x, double y, double z) {
    dGeomSetPosition(ball_, x, y, z);
    std::vector<dContactGeom> contacts(16);
    contacts.resize(
        static_cast<std::size_t>(dCollide(ball_, mesh_, 16, contacts.data(), sizeof(dContactGeom))));
    return contacts;
  }

 private:
  std::vector<double> vertices_{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  std::vector<dTriIndex> corners_{0, 1, 2, 1, 3, 2};
  dTriMeshDataID data_;
  dGeomID mesh_, ball_;
};

TEST_F(OdeTraps, TheDepthOfABallCentredOnAFaceIsNoNumber) {
  bool nan = false;
  for (const dContactGeom& contact : collide(0.25, 0.25, 0)) nan = nan || std::isnan(contact.depth);
  EXPECT_TRUE(nan);
}

TEST_F(OdeTraps, TheDepthAtAnEdgeIsNotTheRadiusLessTheDistance) {
  const double distance = std::hypot(0.25, 0.25, 0.3);  // from (0.25, 0.25, 0.3) to the shared edge's middle
  for (const dContactGeom& contact : collide(0.25, 0.25, 0.3)) {
    if (contact.side2 == 1) {
      EXPECT_LT(contact.depth, 0.5 - distance - 0.01);
    }
  }
}

}  // namespace
}  // namespace touchmark::baselines

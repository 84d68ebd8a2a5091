#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/libccd/libccd_detector.h"
#include "core/brute_force/brute_force.h"
#include "tests/baselines/answers.h"
#include "tests/baselines/every_form.h"
#include "tests/baselines/meshes.h"
#include "tests/baselines/threads.h"

namespace touchmark::baselines {
namespace {

using Algorithm = LibccdDetector::Algorithm;
using Frame = LibccdDetector::Frame;

static_assert(AnswersTouches<LibccdDetector> && AnswersNearest<LibccdDetector>);
static_assert(!AnswersSweep<LibccdDetector>, "libccd has no sweep, its name notwithstanding");

/// What GJK with EPA and MPR are good for where the ball and the triangle are of a size, in radii.
constexpr double good = 0.01;

std::string name(const LibccdDetector::Options& form) {
  return form.algorithm == Algorithm::gjk ? "gjk" : "mpr";
}

[[maybe_unused]] const bool tests_each_form =
    test_each_form<LibccdDetector>("EachLibccd", {{Algorithm::gjk}, {Algorithm::mpr}}, name,
                                   {.reach = 0.51, .short_reach = 0.49, .radius = 0.501, .away = 0.5});

class EveryLibccd : public testing::TestWithParam<Algorithm> {
 protected:
  LibccdDetector build(const TriangleMesh& mesh) const { return LibccdDetector::build(mesh, {GetParam()}); }
  LibccdDetector::Session session;
};
INSTANTIATE_TEST_SUITE_P(Libccd, EveryLibccd, testing::Values(Algorithm::gjk, Algorithm::mpr),
                         [](const auto& parameter) { return name({parameter.param}); });

TEST_P(EveryLibccd, FindsTheTriangleBelowTheProbe) {
  const auto contact = build(square()).nearest({{0.7, 0.7, 0.5}, 0}, 1, session);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->triangle, 1u);
  EXPECT_NEAR(contact->distance, 0.5, good);
  EXPECT_GT(contact->normal.z(), 0.99);
  EXPECT_NEAR(contact->normal.norm(), 1, 1e-12);
}

TEST_P(EveryLibccd, AnswersAtInfiniteReach) {
  const auto contact = build(square()).nearest({{0.7, 0.7, -20}, 0}, infinity, session);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->distance, 20, 20 * good);
}

void expect_touches_of_brute_force(const TriangleMesh& mesh, const LibccdDetector& detector, double size) {
  int far_off = 0;
  const auto check = [&](const Contact& contact, double distance) {
    far_off += std::abs(contact.distance - distance) > 0.1 * 0.2 * size;  // a tenth of the reach
  };
  const int touching = expect_the_touches_of_brute_force(mesh, detector, size, 0.2 * size, check);
  EXPECT_LE(far_off, touching / 20);  // some always are: see the traps
}

TEST_P(EveryLibccd, FindsTheTouchingProbesOfBruteForce) {
  const TriangleMesh mesh = bumps(12);
  expect_touches_of_brute_force(mesh, build(mesh), 1);
}

TEST_P(EveryLibccd, FindsThemOnAMeshOfMicronsToo) {
  const TriangleMesh mesh = bumps(12).transformed(1e-6, Vec3::Zero());
  expect_touches_of_brute_force(mesh, build(mesh), 1e-6);
}

TEST_P(EveryLibccd, ThreadsWithASessionEachGiveTheSameBits) {
  expect_threads_to_get_the_same_bits(build(bumps(12)), 100);
}

TEST_P(EveryLibccd, CountsPairsAndBoxes) {
  const LibccdDetector detector = build(bumps(12));
  detector.nearest({{0, 0, 0.2}, 0}, 0.3, session);
  EXPECT_GT(session.work.boxes, session.work.triangles);
  EXPECT_GT(session.work.triangles, 0u);
}

TEST(Libccd, RefusesAToleranceThatIsNotPositive) {
  for (const double tolerance : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(LibccdDetector::build(square(), {Algorithm::gjk, Frame::fitted, tolerance}),
                 std::invalid_argument);
  }
}

TEST(Libccd, SaysThatItIsApproximate) {
  EXPECT_EQ(LibccdDetector::build(square()).accuracy().guarantee, Guarantee::approximate);
}

/// Faults of libccd 2.1 as Debian 12 ships it: these pass while the faults are there. When one fails, libccd
/// has changed: see baselines/libccd/README.md for what may then go.
struct Wrong {
  int missed = 0, false_contacts = 0;
};

Wrong wrong_touches(Frame frame, double scale) {
  const TriangleMesh mesh = bumps(12).transformed(scale, Vec3::Zero());
  const LibccdDetector detector = LibccdDetector::build(mesh, {Algorithm::gjk, frame});
  const BruteForce reference = BruteForce::build(mesh);
  LibccdDetector::Session session;
  BruteForce::Session reference_session;
  Random random(3);
  Wrong wrong;
  for (int trial = 0; trial < 1000; ++trial) {
    const Probe probe{scale * random.point(), 0.2 * scale * random.unit()};
    const bool expected = reference.touches(probe, reference_session);
    const bool touching = detector.touches(probe, session);
    wrong.missed += expected && !touching;
    wrong.false_contacts += touching && !expected;
  }
  return wrong;
}

TEST(LibccdTraps, SmallScenesAreWrongUnlessScaled) {
  const Wrong small = wrong_touches(Frame::mesh, 1e-5);
  EXPECT_GT(small.missed + small.false_contacts, 20);
  const Wrong scaled = wrong_touches(Frame::fitted, 1e-5);
  EXPECT_EQ(scaled.missed + scaled.false_contacts, 0);
}

TEST(LibccdTraps, DepthsAreFarOffForABallOnALargeTriangle) {
  // A ball of 0.001 at half its radius above a triangle of size 1.
  const TriangleMesh triangle({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {TriangleMesh::Corners{0, 1, 2}});
  const LibccdDetector detector = LibccdDetector::build(triangle, {Algorithm::mpr});
  LibccdDetector::Session session;
  Random random(6);
  double worst = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 center(0.05 + 0.4 * random.unit(), 0.05 + 0.4 * random.unit(), 0.0005);
    const auto contact = detector.nearest({center, 0}, 0.001, session);
    if (contact) worst = std::max(worst, std::abs(contact->distance - 0.0005) / 0.001);
  }
  EXPECT_GT(worst, 0.1);
}

TEST(LibccdTraps, ABarePointOnATriangleIsOftenMissed) {
  const TriangleMesh mesh = bumps(12);
  const LibccdDetector detector = LibccdDetector::build(mesh, {Algorithm::mpr});
  LibccdDetector::Session session;
  Random random(7);
  int found = 0;
  for (std::size_t trial = 0; trial < 100; ++trial) {
    const double u = random.unit(), v = (1 - u) * random.unit();
    const Vec3 inside =
        (1 - u - v) * mesh.corner(trial, 0) + u * mesh.corner(trial, 1) + v * mesh.corner(trial, 2);
    found += detector.touches({inside, 0}, session);
  }
  EXPECT_LT(found, 50);
}

}  // namespace
}  // namespace touchmark::baselines

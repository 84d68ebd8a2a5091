#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/fcl/fcl_ccd.h"
#include "baselines/fcl/fcl_detector.h"
#include "baselines/fcl/fcl_scene.h"
#include "core/brute_force/brute_force.h"
#include "tests/baselines/every_form.h"
#include "tests/baselines/exact_form.h"
#include "tests/baselines/follows.h"
#include "tests/baselines/meshes.h"
#include "tests/baselines/scenes.h"
#include "tests/baselines/threads.h"

namespace touchmark::baselines {
namespace {

using Volume = FclDetector::Volume;
using Method = FclDetector::Method;
using Narrow = FclDetector::Narrow;

static_assert(AnswersTouches<FclDetector> && AnswersNearest<FclDetector>);
static_assert(AnswersSweep<FclCcd> && !AnswersTouches<FclCcd> && !AnswersNearest<FclCcd>);
static_assert(!AnswersSweep<FclDetector>, "FCL's continuous collision does not work; see README.md");

constexpr Volume all_volumes[] = {Volume::kios, Volume::obbrss, Volume::obb, Volume::rss, Volume::aabb};

/// Every configuration that FCL can do.
std::vector<FclDetector::Options> configurations() {
  std::vector<FclDetector::Options> all;
  for (const Volume volume : all_volumes) {
    all.push_back({volume, Method::collide, Narrow::fcl});
    for (const Narrow narrow : {Narrow::fcl, Narrow::exact}) {
      all.push_back({volume, Method::traverse, narrow});
      if (volume != Volume::obb) all.push_back({volume, Method::distance, narrow});
    }
  }
  return all;
}

std::string name(const FclDetector::Options& options) {
  constexpr const char* volumes[] = {"kios", "obbrss", "obb", "rss", "aabb"};
  constexpr const char* methods[] = {"collide", "traverse", "distance"};
  return std::string("bv_") + volumes[static_cast<int>(options.bv)] + "_method_" +
         methods[static_cast<int>(options.method)] +
         (options.narrow == Narrow::exact ? "_narrow_exact" : "_narrow_fcl");
}

[[maybe_unused]] const bool tests_each_form =
    test_each_form<FclDetector>("EachFcl", configurations(), name, {.rounding = 1e-14});

class EveryFcl : public testing::TestWithParam<FclDetector::Options> {
 protected:
  FclDetector build(const TriangleMesh& mesh) const { return FclDetector::build(mesh, GetParam()); }
  FclDetector::Session session;
};

INSTANTIATE_TEST_SUITE_P(Fcl, EveryFcl, testing::ValuesIn(configurations()),
                         [](const auto& parameter) { return name(parameter.param); });

TEST_P(EveryFcl, AnswersAtInfiniteReach) {
  const auto contact = build(square()).nearest({{0.75, 0.75, -200}, 0}, infinity, session);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->distance, 200, 1e-12);
  EXPECT_LT((contact->normal - Vec3(0, 0, -1)).norm(), 1e-12);
}

TEST_P(EveryFcl, ABarePointOnTheMeshTouchesIt) {
  const FclDetector detector = build(square());
  EXPECT_TRUE(detector.touches({{0.75, 0.75, 0}, 0}, session));
  const auto contact = detector.nearest({{0.75, 0.75, 0}, 0}, 0.1, session);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->triangle, 1u);
  EXPECT_EQ(contact->distance, 0);
  EXPECT_NEAR(std::abs(contact->normal.z()), 1, 1e-14);
}

TEST_P(EveryFcl, AMeshOfOneTriangleIsEnough) {
  const FclDetector detector =
      build(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {TriangleMesh::Corners{0, 1, 2}}));
  EXPECT_NEAR(detector.nearest({{0.25, 0.25, 0.5}, 0}, 1, session)->distance, 0.5, 1e-15);
}

TEST_P(EveryFcl, FindsExactlyTheTouchingProbesOfBruteForce) {
  const TriangleMesh mesh = bumps(12);
  const FclDetector detector = build(mesh);
  const BruteForce reference = BruteForce::build(mesh);
  BruteForce::Session reference_session;
  Random random(3);
  int touching = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Probe probe{random.point(), 0.3 * random.unit()};
    const bool expected = reference.touches(probe, reference_session);
    EXPECT_EQ(detector.touches(probe, session), expected) << trial;
    EXPECT_EQ(detector.nearest(probe, probe.radius, session).has_value(), expected) << trial;
    touching += expected;
  }
  EXPECT_GT(touching, 30);
}

TEST_P(EveryFcl, CountsItsBytes) {
  const TriangleMesh mesh = bumps(12);
  // At least the vertices and three corners a triangle are there, and no more than 3 kB a triangle.
  EXPECT_GT(build(mesh).bytes(), mesh.size() * 12 + mesh.vertices().size() * sizeof(Vec3));
  EXPECT_LT(build(mesh).bytes(), mesh.size() * 3000);
}

/// Only those with our kernel: they must equal BruteForce bit for bit, slivers and ties included.
class ExactFcl : public EveryFcl {};
INSTANTIATE_TEST_SUITE_P(Fcl, ExactFcl, testing::ValuesIn([] {
                           std::vector<FclDetector::Options> exact;
                           for (const auto& options : configurations())
                             if (options.narrow == Narrow::exact) exact.push_back(options);
                           return exact;
                         }()));

TEST_P(ExactFcl, GivesTheBitsOfBruteForce) {
  expect_the_bits_of_brute_force_everywhere([this](const TriangleMesh& mesh) { return build(mesh); });
}

TEST_P(ExactFcl, EqualsBruteForceOnTrianglesWithoutArea) {
  Random random(8);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Vec3 place = random.point(), along = 0.3 * random.point();
    for (const double t : {0.0, i % 3 == 0 ? 0.0 : 0.5, i % 2 == 0 ? 0.0 : 1.0})
      vertices.push_back(place + t * along);
    corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const TriangleMesh mesh(vertices, corners);
  expect_the_bits_of_brute_force(mesh, build(mesh), 1, Vec3::Zero());
}

TEST(Fcl, DistanceMethodIsAsAccurateAsDoublesOnAWellShapedMesh) {
  const TriangleMesh mesh = bumps(12);
  const FclDetector detector = FclDetector::build(mesh, {Volume::rss, Method::distance, Narrow::fcl});
  const BruteForce reference = BruteForce::build(mesh);
  FclDetector::Session session;
  BruteForce::Session reference_session;
  Random random(9);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 center = random.point();
    const auto contact = detector.nearest({center, 0}, infinity, session);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->distance, reference.nearest({center, 0}, infinity, reference_session)->distance,
                2 * detector.accuracy().relative);
  }
}

TEST(Fcl, OnlyTheExactFormOverBoxesIsProvablyExact) {
  EXPECT_EQ(FclDetector::build(square()).accuracy().guarantee, Guarantee::approximate);
  EXPECT_EQ(
      FclDetector::build(square(), {Volume::kios, Method::distance, Narrow::exact}).accuracy().guarantee,
      Guarantee::approximate);
  EXPECT_EQ(
      FclDetector::build(square(), {Volume::aabb, Method::distance, Narrow::exact}).accuracy().guarantee,
      Guarantee::exact);
}

TEST(Fcl, RefusesWhatItCannotDo) {
  EXPECT_THROW(FclDetector::build(square(), {Volume::obb, Method::distance, Narrow::fcl}),
               std::invalid_argument);
  EXPECT_THROW(FclDetector::build(square(), {Volume::kios, Method::collide, Narrow::exact}),
               std::invalid_argument);
}

TEST(Fcl, CountsTheVolumesItLooksAt) {
  const FclDetector detector = FclDetector::build(bumps(12), {Volume::kios, Method::distance, Narrow::fcl});
  FclDetector::Session session;
  detector.nearest({{0, 0, 0.2}, 0}, 0.3, session);
  EXPECT_GT(session.work.boxes, 0u);
  EXPECT_GT(session.work.triangles, 0u);
}

TEST(Fcl, ThreadsWithASessionEachGiveTheSameBits) {
  expect_threads_to_get_the_same_bits(FclDetector::build(bumps(12)));
}

TEST(Fcl, FollowsVerticesThatMove) {
  const TriangleMesh mesh = bumps(12), other = moved(mesh);
  for (const FclDetector::Options& form : std::vector<FclDetector::Options>{
           {FclDetector::Volume::aabb, FclDetector::Method::distance, FclDetector::Narrow::exact},
           {FclDetector::Volume::aabb, FclDetector::Method::traverse, FclDetector::Narrow::exact},
           {FclDetector::Volume::kios, FclDetector::Method::traverse, FclDetector::Narrow::exact},
           {FclDetector::Volume::obbrss, FclDetector::Method::distance, FclDetector::Narrow::exact}})
    expect_to_follow<FclDetector>(mesh, other, form);
}

/// The square |x|, |y| <= 1 at z = 0.
TriangleMesh square() {
  return {{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}, {{0, 1, 2}, {0, 2, 3}}};
}

TEST(FclCcd, StopsAtTheLastSampleBeforeContact) {
  const FclCcd detector = FclCcd::build(square(), {11});
  FclCcd::Session session;
  // Samples are a tenth apart; the ball of 0.35 touches from z = 0.35 on, the eighth sample is at 0.3.
  const std::optional<Impact> impact =
      detector.first_hit({Vec3(0.2, 0.1, 1), Vec3(0.2, 0.1, 0), 0.35}, session);
  ASSERT_TRUE(impact.has_value());
  EXPECT_NEAR(impact->fraction, 0.6, 1e-12);
  EXPECT_NEAR(impact->contact.normal.z(), 1, 1e-9);
}

TEST(FclCcd, SeesNothingBetweenTwoSamples) {
  const FclCcd detector = FclCcd::build(square(), {11});
  FclCcd::Session session;
  EXPECT_FALSE(detector.first_hit({Vec3(0.2, 0.1, 1), Vec3(0.2, 0.1, -0.9), 0.01}, session).has_value());
}

TEST(FclCcd, FollowsItsMesh) {
  FclCcd detector = FclCcd::build(square(), {11});
  detector.update(square().transformed(1, Vec3(0, 0, -5)));
  FclCcd::Session session;
  EXPECT_FALSE(detector.first_hit({Vec3(0.2, 0.1, 1), Vec3(0.2, 0.1, 0), 0.35}, session).has_value());
  EXPECT_TRUE(detector.first_hit({Vec3(0.2, 0.1, -4), Vec3(0.2, 0.1, -5), 0.35}, session).has_value());
}

TEST(FclScene, FindsTheNearestBodyWhileBodiesMove) {
  const FclDetector::Options exact{FclDetector::Volume::aabb, FclDetector::Method::distance,
                                   FclDetector::Narrow::exact};
  expect_nearest_body<FclScene>(exact, Vec3::Zero());
  expect_nearest_body<FclScene>(exact, Vec3(0, 1 << 20, 3));
}

}  // namespace
}  // namespace touchmark::baselines

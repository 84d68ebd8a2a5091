// What is chosen for a mesh, and that what was chosen answers as it would alone.
#include "core/auto/auto_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/auto/overlap.h"
#include "core/brute_force/brute_force.h"
#include "tests/core/grid_group/meshes.h"

namespace touchmark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Unconnected triangles whose corners are anywhere in the cube.
TriangleMesh large_soup(std::size_t triangles) {
  testing::Random random(7);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> corners;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    for (int k = 0; k < 3; ++k) vertices.push_back(random.point(1));
    corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {vertices, corners};
}

/// Returns the same triangles with some vertices a little elsewhere.
TriangleMesh dented(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (std::size_t i = 0; i < vertices.size(); i += 5) vertices[i] *= 0.99;
  return {vertices, {mesh.triangles().begin(), mesh.triangles().end()}};
}

std::vector<Vec3> centers_about(const TriangleMesh& mesh) {
  testing::Random random(11);
  std::vector<Vec3> centers;
  for (int i = 0; i < 200; ++i)
    centers.push_back(mesh.bounds().center() + random.point(0.7 * mesh.diagonal()));
  for (std::size_t i = 0; i < mesh.size(); i += 1 + mesh.size() / 100)  // and a slow way along the surface
    centers.push_back(mesh.corner(i, 0) + random.point(1e-3 * mesh.diagonal()));
  return centers;
}

bool same(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return std::memcmp(a->point.data(), b->point.data(), sizeof(double) * 3) == 0 &&
         std::memcmp(a->normal.data(), b->normal.data(), sizeof(double) * 3) == 0 &&
         a->distance == b->distance && a->triangle == b->triangle;
}

void expect_answers_of_brute_force(const AutoDetector& detector, const TriangleMesh& mesh,
                                   AutoDetector::Session& session) {
  const BruteForce all = BruteForce::build(mesh);
  BruteForce::Session plain;
  const double radius = 0.01 * mesh.diagonal();
  Vec3 before = mesh.bounds().center();
  for (const Vec3& center : centers_about(mesh)) {
    const Probe probe{center, radius};
    EXPECT_EQ(detector.touches(probe, session), all.touches(probe, plain));
    EXPECT_TRUE(same(detector.nearest(probe, infinity, session), all.nearest(probe, infinity, plain)));
    EXPECT_TRUE(same(detector.nearest(probe, radius, session), all.nearest(probe, radius, plain)));
    std::array<Contact, 8> some, expected_some;
    const std::size_t count = detector.contacts(probe, radius, session, some);
    ASSERT_EQ(count, all.contacts(probe, radius, plain, expected_some));
    for (std::size_t i = 0; i < std::min(count, some.size()); ++i)
      EXPECT_TRUE(same(some[i], expected_some[i])) << "contact " << i;
    const Sweep sweep{before, center, radius};
    const std::optional<Impact> impact = detector.first_hit(sweep, session),
                                expected = all.first_hit(sweep, plain);
    ASSERT_EQ(impact.has_value(), expected.has_value());
    if (impact) {
      EXPECT_EQ(impact->fraction, expected->fraction);
    }
    before = center;
  }
}

TEST(AutoDetector, GivesTheBitsOfBruteForceWhateverItHolds) {
  const TriangleMesh mesh = testing::icosphere(3), moved = dented(mesh);
  for (const Form form : {Form::sphere_cluster, Form::grid_group, Form::aabb_tree}) {
    SCOPED_TRACE(name_of(form));
    AutoDetector detector = AutoDetector::build(mesh, {.form = form});
    EXPECT_EQ(detector.choice().form(), form);
    AutoDetector::Session session;
    expect_answers_of_brute_force(detector, mesh, session);
    detector.update(moved);
    expect_answers_of_brute_force(detector, moved, session);
  }
}

TEST(AutoDetector, CountsWorkInItsOwnSessionAndBelievesThatItWasReset) {
  const TriangleMesh mesh = testing::icosphere(3);
  for (const Form form : {Form::sphere_cluster, Form::grid_group, Form::aabb_tree}) {
    SCOPED_TRACE(name_of(form));
    const AutoDetector detector = AutoDetector::build(mesh, {.form = form});
    AutoDetector::Session session;
    detector.nearest({Vec3(1.01, 0, 0), 0}, infinity, session);
    const std::uint64_t once = session.work.total();
    EXPECT_GT(once, 0U);
    session.work = {};
    detector.nearest({Vec3(0, 1.01, 0), 0}, infinity, session);
    EXPECT_GT(session.work.total(), 0U);
    EXPECT_LT(session.work.total(), 4 * once);
  }
}

TEST(AutoDetector, KeepsWithinMemoryOrSaysWhatItWouldTake) {
  const TriangleMesh mesh = testing::icosphere(5);
  const std::size_t usual = AutoDetector::build(mesh).bytes();
  const std::size_t least = AutoDetector::build(mesh, {.form = Form::aabb_tree}).bytes();
  ASSERT_LT(least, usual);
  for (const double limit :
       {static_cast<double>(usual), 0.5 * static_cast<double>(usual + least), static_cast<double>(least)}) {
    EXPECT_LE(static_cast<double>(AutoDetector::build(mesh, {.max_bytes = limit}).bytes()), limit);
  }
  try {
    AutoDetector::build(mesh, {.max_bytes = static_cast<double>(least) - 1});
    FAIL() << "it was built";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(least)), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(std::to_string(least - 1)), std::string::npos) << error.what();
  }
}

TEST(BestFor, TakesSpheresUnlessATrialOfWhatOverlapsTellsOtherwise) {
  EXPECT_EQ(best_for(testing::icosphere(4)).form(), Form::sphere_cluster);
  EXPECT_EQ(best_for(large_soup(500)).form(), Form::sphere_cluster);
  EXPECT_NE(best_for(large_soup(500), {.trial_ms = 1e9}).form(), Form::aabb_tree);
}

TEST(BestFor, ChoosesTheSameForAMeshOfAnotherSizeAndPlace) {
  for (const TriangleMesh& mesh : {testing::icosphere(3), large_soup(3000)}) {
    const Form form = best_for(mesh).form();
    for (const double scale : {0x1p-100, 0x1p-10, 0x1p100})
      EXPECT_EQ(best_for(testing::moved(mesh, scale, Vec3::Zero())).form(), form);
    EXPECT_EQ(best_for(testing::moved(mesh, 1, Vec3(0x1p20, -0x1p20, 0))).form(), form);
  }
}

TEST(BestFor, TakesAMeshOfOneTriangleOrOfAPoint) {
  const TriangleMesh one({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), point({{1, 2, 3}}, {{0, 0, 0}});
  for (const TriangleMesh& mesh : {one, point}) {
    const AutoDetector detector = AutoDetector::build(mesh);
    AutoDetector::Session session;
    const std::optional<Contact> contact = detector.nearest({Vec3(1, 2, 4), 0}, infinity, session);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->triangle, 0U);
  }
}

TEST(BestFor, TriesOnlyWhatOverlapsAndOnlyWhereThereIsTimeToBuildBoth) {
  const TriangleMesh mesh = large_soup(200);
  EXPECT_FALSE(best_for(mesh).tried);
  EXPECT_FALSE(best_for(mesh, {.trial_ms = 1e-9}).tried);
  EXPECT_FALSE(best_for(testing::icosphere(3), {.trial_ms = 1e9}).tried);
  for (const Wish::Query query :
       {Wish::Query::any, Wish::Query::touches, Wish::Query::nearest, Wish::Query::sweep}) {
    const Wish wish{.query = query, .reach = infinity, .speed = 0, .trial_ms = 1e9};
    EXPECT_TRUE(best_for(mesh, wish).tried);
    AutoDetector::Session session;
    expect_answers_of_brute_force(AutoDetector::build(mesh, wish), mesh, session);
  }
}

TEST(BestFor, RefusesWishesThatAreNegativeOrNotANumber) {
  const TriangleMesh mesh = testing::icosphere(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {-1.0, nan}) {
    EXPECT_THROW(best_for(mesh, {.reach = wrong}), std::invalid_argument);
    EXPECT_THROW(best_for(mesh, {.speed = wrong}), std::invalid_argument);
    EXPECT_THROW(best_for(mesh, {.max_bytes = wrong}), std::invalid_argument);
    EXPECT_THROW(best_for(mesh, {.trial_ms = wrong}), std::invalid_argument);
  }
}

TEST(Overlap, IsTheShareOfOtherTrianglesWhoseBoxesHoldAMiddle) {
  // A strip of squares, each cut along its diagonal: both halves have its box, and no other holds a middle.
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  constexpr std::uint32_t squares = 100;
  for (std::uint32_t i = 0; i <= squares; ++i)
    for (const double y : {0.0, 1.0}) vertices.push_back({static_cast<double>(i), y, 0});
  for (std::uint32_t i = 0; i < squares; ++i) {
    triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  EXPECT_NEAR(overlap_of({vertices, triangles}), 1.0 / (2 * squares - 1), 1e-12);
  EXPECT_EQ(overlap_of({vertices, {triangles.front()}}), 0);  // there is no other
  const std::vector<TriangleMesh::Corners> twins(50, triangles.front());
  EXPECT_EQ(overlap_of({vertices, twins}), 1);
}

}  // namespace
}  // namespace touchmark

#include "core/scene/scene.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/random_pose.h"
#include "tests/core/scene/square_bodies.h"

namespace touchmark {
namespace {

static_assert(Detector<Scene<BruteForce>> && AnswersTouches<Scene<BruteForce>>);
static_assert(AnswersContacts<Scene<BruteForce>>);
static_assert(AnswersNearest<Scene<SphereCluster>> && AnswersSweep<Scene<SphereCluster>>);

using test::square, test::at;

TEST(Scene, AnswersWithTheBodyThatIsNearest) {
  Scene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(square()));
  const BodyId low = scene.add(shape, at(0, 0, 0)), high = scene.add(shape, at(0, 0, 3));
  Scene<BruteForce>::Session session;
  const auto contact = scene.nearest_body({{0.5, 0.25, 1}, 0}, 5, session);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->body, low);
  EXPECT_EQ(contact->contact.distance, 1);
  EXPECT_EQ(contact->contact.point, Vec3(0.5, 0.25, 0));
  EXPECT_EQ(scene.nearest_body({{0.5, 0.25, 2}, 0}, 5, session)->body, high);
  EXPECT_FALSE(scene.nearest_body({{0.5, 0.25, 1.5}, 0}, 1, session));
}

/// Past an edge, or to the plane, by one ulp on either side.
TEST(Scene, SidesDecideASweepOfABarePointToTheUlp) {
  Pose turned = at(2, 0, 0);
  turned.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // a quarter: the square is the same again
  for (const Pose& pose : {at(0, 0, 0), at(2, 0, 0), turned}) {
    Scene<SphereCluster> scene;
    scene.add(scene.add_shape(Shape<SphereCluster>::build(square())), pose);
    Scene<SphereCluster>::Session session;
    const Vec3 t = pose.translation;
    const auto hits = [&](const Vec3& from, const Vec3& to) {
      return scene.first_hit({from, to, 0}, session).has_value();
    };
    const double edge = t.x() + 1;
    for (const auto& [x, expected] : {std::pair{std::nextafter(edge, 0), true}, std::pair{edge, true},
                                      std::pair{std::nextafter(edge, 9), false}}) {
      EXPECT_EQ(hits({x, 0.25, 1}, {x, 0.25, -1}), expected) << x;
      EXPECT_EQ(hits({x, 0.25, -1}, {x, 0.25, 1}), expected) << x;
    }
    for (const auto& [z, expected] :
         {std::pair{-0x1p-60, true}, std::pair{0.0, true}, std::pair{0x1p-60, false}}) {
      EXPECT_EQ(hits(t + Vec3(0.5, 0.25, 1), t + Vec3(0.5, 0.25, z)), expected) << z;
      EXPECT_EQ(hits(t + Vec3(0.5, 0.25, z), t + Vec3(0.5, 0.25, 1)), expected) << z;
    }
  }
}

/// Whole numbers take ten times as long, and each counts as 64 looks where work is limited.
TEST(Scene, SweepsOfBarePointsTakeHardlyAnyWholeNumbers) {
  Scene<SphereCluster> scene;
  test::Random random(5);
  scene.add(scene.add_shape(Shape<SphereCluster>::build(square())), test::random_pose(random, {1, 2, 3}));
  Scene<SphereCluster>::Session session;
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from = Vec3(1, 2, 3) + random.point(1), to = Vec3(1, 2, 3) + random.point(1);
    hits += scene.first_hit({from, to, 0}, session) ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(session.work.exact_decisions, 10U);
}

/// Over 200 triangles of one plane, at a height that doubles hardly tell from the radius.
TEST(Scene, ABallThatSlidesAlongABodyTakesHardlyAnyWholeNumbers) {
  constexpr std::uint32_t n = 10;
  constexpr double radius = 0.25;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) {
      vertices.emplace_back(x / 10.0, y / 10.0, 0);
      if (x == n || y == n) continue;
      const std::uint32_t corner = y * (n + 1) + x;
      faces.push_back({corner, corner + 1, corner + n + 1});
      faces.push_back({corner + 1, corner + n + 2, corner + n + 1});
    }
  Scene<SphereCluster> scene;
  scene.add(scene.add_shape(Shape<SphereCluster>::build(TriangleMesh(vertices, faces))), at(1, 2, 0));
  for (const auto& [height, expected] :
       {std::pair{radius, true}, std::pair{std::nextafter(radius, 1), false}}) {
    Scene<SphereCluster>::Session session;
    const Sweep sweep{{1.05, 2.43, height}, {1.91, 2.56, height}, radius};
    EXPECT_EQ(scene.first_hit(sweep, session).has_value(), expected);
    EXPECT_LT(session.work.exact_decisions, 10U) << height;
  }
}

TEST(Scene, FollowsBodiesThatMoveAndForgetsThoseRemoved) {
  Scene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(square()));
  const BodyId body = scene.add(shape, at(0, 0, 0));
  Scene<BruteForce>::Session session;
  EXPECT_TRUE(scene.touches({{0, 0, 1}, 1}, session));
  scene.move(body, at(0, 0, -1e-9));
  EXPECT_FALSE(scene.touches({{0, 0, 1}, 1}, session));
  scene.move(body, at(0, 0, 0.5));
  EXPECT_TRUE(scene.touches({{0, 0, 1}, 1}, session));
  scene.remove(body);
  EXPECT_FALSE(scene.touches({{0, 0, 1}, 1}, session));
  EXPECT_FALSE(scene.has(body));
  EXPECT_THROW(scene.move(body, at(0, 0, 0)), SceneError);
  const BodyId next = scene.add(shape, at(0, 0, 0));
  EXPECT_NE(next, body);
}

TEST(Scene, MovesNoBodyToAPoseThatIsNotRigid) {
  Scene<BruteForce> scene;
  const BodyId body = scene.add(scene.add_shape(Shape<BruteForce>::build(square())), at(0, 0, 0));
  Pose reflected, sheared;
  reflected.rotation(2, 2) = -1;
  sheared.rotation(0, 1) = 1e-5;
  for (const Pose& pose : {reflected, sheared, at(0, std::nan(""), 0), at(0, 0, HUGE_VAL)}) {
    EXPECT_THROW(scene.move(body, pose), PoseError);
    EXPECT_EQ(scene.pose(body), at(0, 0, 0));
  }
}

TEST(Scene, GivesTheContactsOfAllBodiesNearestFirst) {
  Scene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(square()));
  const BodyId near = scene.add(shape, at(0, 0, 1)), far = scene.add(shape, at(0, 0, -2));
  Scene<BruteForce>::Session session;
  std::array<BodyContact, 3> into;
  EXPECT_EQ(scene.contacts_of_bodies({{0, 0, 0}, 0}, 2, session, into), 4u);
  EXPECT_EQ(into[0].body, near);
  EXPECT_EQ(into[0].contact.triangle, 0u);
  EXPECT_EQ(into[1].contact.triangle, 1u);
  EXPECT_EQ(into[2].body, far);
  EXPECT_EQ(into[2].contact.distance, 2);
  EXPECT_EQ(scene.contacts_of_bodies({{0, 0, 0}, 0}, 1.5, session, into), 2u);
}

TEST(Scene, SeesALongBodyThatOnlyTurns) {
  Scene<BruteForce> scene;
  const TriangleMesh rod({{-10, 0, -0.1}, {10, 0, -0.1}, {10, 0, 0.1}}, {{0, 1, 2}});
  const BodyId body = scene.add(scene.add_shape(Shape<BruteForce>::build(rod)), Pose());
  Scene<BruteForce>::Session session;
  const Probe probe{{0, 9, 0}, 0.5};
  EXPECT_FALSE(scene.touches(probe, session));
  scene.move(body, pose_of({0, 0, 0}, 1, 0, 0, 1));  // a quarter turn
  EXPECT_TRUE(scene.touches(probe, session));
}

TEST(Scene, SeesWhoTeleportsOrAppearsUnderTheProbeAndNotWhoIsGone) {
  Scene<SphereCluster> scene;
  const ShapeId shape = scene.add_shape(Shape<SphereCluster>::build(square()));
  const BodyId far = scene.add(shape, at(0, 0, 50));
  for (int i = 0; i < 100; ++i) scene.add(shape, at(40 + 3 * i, 0, 0));
  Scene<SphereCluster>::Session session;
  const Probe probe{{0, 0, 0.5}, 1};
  EXPECT_FALSE(scene.touches(probe, session));
  scene.move(far, at(0, 0, 0));
  EXPECT_TRUE(scene.touches(probe, session));
  EXPECT_EQ(scene.nearest_body(probe, 1, session)->body, far);
  scene.remove(far);
  EXPECT_FALSE(scene.touches(probe, session));
  const BodyId added = scene.add(shape, at(0, 0, 1));
  EXPECT_EQ(scene.nearest_body(probe, 1, session)->body, added);
}

TEST(Scene, InFreeSpaceLooksAtNoBodyHoweverManyThereAreAndAllMove) {
  Scene<SphereCluster> scene;
  const ShapeId shape = scene.add_shape(Shape<SphereCluster>::build(square()));
  std::vector<BodyId> bodies;
  for (int i = 0; i < 3000; ++i) bodies.push_back(scene.add(shape, at(20 + 3 * (i % 50), 3 * (i / 50), 0)));
  Scene<SphereCluster>::Session session;
  EXPECT_FALSE(scene.touches({{0, 0, 0}, 0.1}, session));
  const std::uint64_t before = session.work.total();
  EXPECT_GT(session.work.bodies, 0u);
  for (int tick = 1; tick <= 100; ++tick) {
    for (const BodyId& body : bodies) {
      Pose pose = scene.pose(body);
      pose.translation.z() += 0.01;
      scene.move(body, pose);
    }
    EXPECT_FALSE(scene.touches({{0.01 * tick, 0, 0}, 0.1}, session));
  }
  EXPECT_EQ(session.work.total(), before);
}

TEST(Scene, PreparesInFreeSpaceWithoutALookAtABodyAndAnswersAsBefore) {
  Scene<SphereCluster> scene;
  const ShapeId shape = scene.add_shape(Shape<SphereCluster>::build(square()));
  const BodyId body = scene.add(shape, at(0, 0, 0));
  for (int i = 1; i < 100; ++i) scene.add(shape, at(0, 0, -3 * i));
  Scene<SphereCluster>::Session session;
  const Probe probe{{0, 0, 1}, 0.25};
  for (int tick = 0; tick < 3; ++tick) EXPECT_FALSE(scene.touches(probe, session));
  const Work before = session.work;
  scene.move(body, at(0, 0, 0.5));
  scene.prepare(session);
  EXPECT_EQ(session.work.bodies, before.bodies);
  EXPECT_FALSE(scene.touches(probe, session));
  scene.move(body, at(0, 0, 0.75));
  scene.prepare(session);
  EXPECT_TRUE(scene.touches(probe, session));
  scene.prepare(session);
  EXPECT_EQ(scene.nearest_body(probe, 1, session)->contact.distance, 0.25);
}

TEST(Scene, PreparedAfterAMoveBesideABodyLooksAtNoBodyAndAnswersAsItWouldHave) {
  Scene<SphereCluster> scene;
  const ShapeId shape = scene.add_shape(Shape<SphereCluster>::build(square()));
  const BodyId body = scene.add(shape, at(0, 0, 0));
  for (int i = 1; i < 100; ++i) scene.add(shape, at(0, 0, -3 * i));
  Scene<SphereCluster>::Session prepared, plain;
  std::uint64_t looked_prepared = 0, looked_plain = 0;
  for (int tick = 0; tick < 64; ++tick) {
    const Probe probe{{0.001 * tick, 0, 0.3}, 0.25};
    if (tick % 8 == 0) {
      scene.move(body, at(0, 0, 1e-4 * tick));
      scene.prepare(prepared);
    }
    const std::uint64_t before_prepared = prepared.work.bodies, before_plain = plain.work.bodies;
    const auto expected = scene.nearest_body(probe, 0.5, plain);
    const auto found = scene.nearest_body(probe, 0.5, prepared);
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(found->body, expected->body);
    EXPECT_EQ(found->contact.distance, expected->contact.distance);
    EXPECT_EQ(found->contact.triangle, expected->contact.triangle);
    if (tick < 16) continue;  // a list that served less than four queries is not made again at once
    looked_prepared += prepared.work.bodies - before_prepared;
    looked_plain += plain.work.bodies - before_plain;
  }
  EXPECT_EQ(looked_prepared, 0u);
  EXPECT_GE(looked_plain, 6u);  // at least one in each of the six frames
}

// A proxy asks so after a move: is it free where it is, what is on its way, and what is around its end?
TEST(Scene, PreparedAfterTheQuestionsOfAProxyAndAMoveLooksAtLessAndAnswersAsItWouldHave) {
  Scene<SphereCluster> scene;
  const ShapeId shape = scene.add_shape(Shape<SphereCluster>::build(square()));
  const BodyId body = scene.add(shape, at(0, 0, 0));
  for (int i = 1; i < 100; ++i) scene.add(shape, at(0, 0, -3 * i));
  for (const bool lists : {true, false}) {
    Scene<SphereCluster>::Session prepared, plain;
    const auto answers = [&](int tick, Scene<SphereCluster>::Session& session, std::uint64_t& looked) {
      const Vec3 from(0.001 * tick, 0, 0.3), to(0.001 * tick + 0.001, 0, 0.3);
      const std::uint64_t before = session.work.bodies;
      std::vector<double> told{scene.touches({from, 0.25}, session) ? 1.0 : 0.0};
      looked += session.work.bodies - before;
      const auto hit = scene.first_hit_body({from, to, 0.25}, session);
      told.push_back(hit ? hit->impact.fraction : -1);
      std::array<Contact, 4> into;
      if (lists) told.push_back(static_cast<double>(scene.contacts({to, 0}, 0.5, session, into)));
      if (lists) told.push_back(into[0].distance);
      return told;
    };
    std::uint64_t looked_prepared = 0, looked_plain = 0;
    for (int tick = 0; tick < 64; ++tick) {
      if (tick % 8 == 0) scene.move(body, at(0, 0, tick % 16 == 0 ? 0 : 0.045));
      if (tick % 8 == 0) scene.prepare(prepared);
      EXPECT_EQ(answers(tick, prepared, looked_prepared), answers(tick, plain, looked_plain)) << tick;
    }
    EXPECT_LT(looked_prepared, looked_plain);
  }
}

TEST(Scene, PreparedInFreeSpaceStillKnowsWhatWasAskedLast) {
  Scene<SphereCluster> scene;
  const BodyId body = scene.add(scene.add_shape(Shape<SphereCluster>::build(square())), at(0, 0, 0));
  Scene<SphereCluster>::Session session;
  EXPECT_FALSE(scene.nearest_body({{0, 0, 2}, 0}, 0.5, session));
  scene.move(body, at(0, 0, 0.25));
  scene.prepare(session);
  EXPECT_EQ(session.last.question.query, LastQuestion::Query::nearest);
  EXPECT_EQ(session.last.question.reach, 0.5);
  EXPECT_EQ(session.last.point, Vec3(0, 0, 2));
}

TEST(Scene, PreparedAfterOneQueryAndAMoveStillExpectsTheProbeWhereItWas) {
  Scene<SphereCluster> scene;
  const BodyId body = scene.add(scene.add_shape(Shape<SphereCluster>::build(square())), at(100, 0, 0));
  Scene<SphereCluster>::Session session;
  const Probe probe{{100, 0, 0.3}, 0.5};
  EXPECT_TRUE(scene.touches(probe, session));
  scene.move(body, at(100, 0, 0.1));
  scene.prepare(session);
  EXPECT_FALSE(session.near.is_jumping());
  EXPECT_TRUE(scene.touches(probe, session));
}

TEST(Scene, OfTenThousandBodiesBuildsTheShapesOfTheTenThatAreNear) {
  Scene<BruteForce> scene;
  scene.reserve(10000);
  int made = 0;
  for (int i = 0; i < 10000; ++i) {
    const ShapeId shape = scene.add_shape(ShapeSource<BruteForce>{square().bounds(), [&made] {
                                                                    ++made;
                                                                    return Shape<BruteForce>::build(square());
                                                                  }});
    scene.add(shape, at(3 * (i % 100), 3 * (i / 100), 0));
  }
  Scene<BruteForce>::Session session;
  // Over a row of ten, each of which comes within 0.5; the next rows stay 1 away.
  for (int tick = 0; tick <= 270; ++tick) {
    const Probe probe{{0.1 * tick, 0, 0.3}, 0.5};
    const int before = made;
    scene.build_near(probe, 0.2, session);
    EXPECT_LE(made, before + 1);  // bounded work a tick
    const int ahead = made;
    EXPECT_EQ(scene.touches(probe, session), scene.nearest_body(probe, 0.5, session).has_value());
    EXPECT_EQ(made, ahead);  // and none in a query
  }
  EXPECT_EQ(made, 10);
  EXPECT_EQ(scene.shapes_built(), 10u);
}

TEST(Scene, LeavesOutABodyWhoseSourceFailsAndSaysSo) {
  Scene<BruteForce> scene;
  const auto fail = []() -> Shape<BruteForce> { throw MeshError("no such file"); };
  scene.add(scene.add_shape(ShapeSource<BruteForce>{square().bounds(), fail}), at(0, 0, 0));
  Scene<BruteForce>::Session session;
  EXPECT_EQ(scene.failure(), nullptr);
  EXPECT_FALSE(scene.touches({{0, 0, 0}, 1}, session));
  EXPECT_NE(scene.failure(), nullptr);
  Scene<BruteForce> other;
  other.add(other.add_shape(ShapeSource<BruteForce>{square().bounds(), fail}), at(0, 0, 0));
  EXPECT_THROW(other.build_near({{0, 0, 0}, 1}, 1, session), MeshError);
}

TEST(Scene, TakesAtMostTwoHundredBytesABodyBesideItsShape) {
  Scene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(square()));
  scene.reserve(100000);
  for (int i = 0; i < 100000; ++i) scene.add(shape, at(3 * (i % 300), 3 * (i / 300), 0));
  EXPECT_LE(scene.bytes_of_bodies(), 200u * 100000u);
  Scene<BruteForce>::Session session;
  EXPECT_EQ(scene.nearest_body({{450, 450, 2}, 0}, 3, session)->contact.distance, 2);
  EXPECT_LT(session.work.bodies, 200u);  // of a hundred thousand
}

TEST(Scene, AnswersNothingToWhatIsNoNumber) {
  Scene<BruteForce> scene = Scene<BruteForce>::build(square());
  Scene<BruteForce>::Session session;
  EXPECT_FALSE(scene.touches({{std::nan(""), 0, 0}, 1}, session));
  EXPECT_FALSE(scene.touches({{0, 0, 0}, -1}, session));
  EXPECT_FALSE(scene.nearest({{0, 0, 0}, 0}, std::nan(""), session));
  EXPECT_FALSE(scene.first_hit({{0, HUGE_VAL, 0}, {0, 0, 0}, 1}, session));
  EXPECT_TRUE(scene.nearest({{0, 0, 1e300}, 0}, HUGE_VAL, session));
}

// Moves count together in spans in which no body is moved twice, of which only the widest counts.
TEST(Scene, SeesABodyThatMovesAfterAnotherMovedAsFarAndAQuestionBetween) {
  Scene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(square()));
  const BodyId first = scene.add(shape, at(100, 0, 0)), second = scene.add(shape, at(0, 0, 10));
  Scene<BruteForce>::Session session;
  scene.move(first, at(200, 0, 0));
  EXPECT_FALSE(scene.touches({{0, 0, 0}, 0.5}, session));
  scene.move(second, at(0, 0, 0.25));
  EXPECT_TRUE(scene.touches({{0, 0, 0}, 0.5}, session));
  EXPECT_EQ(scene.nearest_body({{0, 0, 0}, 0}, 0.5, session)->body, second);
}

TEST(Scene, SeesABodyThatHasComeInStepsEachOfWhichIsSmall) {
  Scene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(square()));
  for (int i = 0; i < 100; ++i) scene.add(shape, at(0, 0, 3 + 0.01 * i));
  const BodyId body = scene.add(shape, at(0, 0, 10));
  for (int i = 999; i >= 0; --i) scene.move(body, at(0, 0, 0.01 * i));
  Scene<BruteForce>::Session session;
  EXPECT_TRUE(scene.touches({{0, 0, 0}, 0.5}, session));
  // A point that jumps asks for nothing but what is within its reach.
  for (const double z : {1000.0, -1000.0, 1000.0}) EXPECT_FALSE(scene.touches({{0, 0, z}, 0.5}, session));
  EXPECT_TRUE(scene.touches({{0, 0, 0}, 0.5}, session));
  for (int i = 0; i < 1000; ++i) scene.move(body, at(0, 0, 0.01 * (i % 2)));
  EXPECT_TRUE(scene.touches({{0, 0, 0}, 0.5}, session));
  for (int i = 0; i < 1000; ++i) scene.move(body, at(0, 0, -0.01 * i));
  session = {};
  EXPECT_FALSE(scene.touches({{0, 0, 0}, 0.5}, session));
  EXPECT_EQ(scene.nearest_body({{0, 0, 0}, 0}, 20, session)->contact.distance, 3);
}

}  // namespace
}  // namespace touchmark

#include "core/scene/shared_scene.h"

#include <array>
#include <atomic>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/square_bodies.h"

namespace touchmark {
namespace {

using test::square, test::at;

TEST(SharedScene, ShowsNothingBeforeItIsPublishedAndThenAllOfIt) {
  SharedScene<BruteForce> shared;
  SharedScene<BruteForce>* scene = &shared;
  Scene<BruteForce>::Session session;
  const ShapeId shape = scene->add_shape(Shape<BruteForce>::build(square()));
  const BodyId a = scene->add(shape, at(0, 0, 0)), b = scene->add(shape, at(0, 0, 5));
  EXPECT_EQ(scene->read()->size(), 0u);
  scene->publish();
  EXPECT_EQ(scene->read()->nearest_body({{0, 0, 1}, 0}, infinity, session)->body, a);
  scene->move(a, at(0, 0, -9));
  scene->move(b, at(0, 0, 2));
  EXPECT_EQ(scene->read()->nearest_body({{0, 0, 1}, 0}, infinity, session)->contact.distance, 1);
  scene->publish();
  EXPECT_EQ(scene->read()->nearest_body({{0, 0, 1.5}, 0}, infinity, session)->body, b);
  EXPECT_EQ(scene->read()->nearest_body({{0, 0, 1.5}, 0}, infinity, session)->contact.distance, 0.5);
  scene->remove(b);
  scene->publish();
  scene->add(shape, at(0, 0, 1));
  EXPECT_EQ(scene->read()->nearest_body({{0, 0, 1}, 0}, infinity, session)->contact.distance, 10);
  scene->publish();
  scene->publish();  // nothing new
  EXPECT_EQ(scene->read()->nearest_body({{0, 0, 1}, 0}, infinity, session)->contact.distance, 0);
}

/// A plain scene that is told the same answers the same bits, whichever copy is read, also after many frames
/// of bodies that come, go, drift and jump.
TEST(SharedScene, AnswersAsAPlainSceneDoes) {
  SharedScene<SphereCluster> shared;
  Scene<SphereCluster> plain;
  Scene<SphereCluster>::Session session, of_plain;
  const ShapeId shape = shared.add_shape(Shape<SphereCluster>::build(square()));
  plain.add_shape(Shape<SphereCluster>::build(square()));
  std::mt19937_64 engine(3);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  const auto pose = [&] {
    return pose_of({between(-9, 9), between(-9, 9), between(-9, 9)}, 1, between(-1, 1), between(-1, 1), 0);
  };
  std::vector<BodyId> bodies;
  for (int frame = 0; frame < 400; ++frame) {
    for (int change = 0; change < 5; ++change) {
      const std::size_t which = bodies.empty() ? 0 : engine() % bodies.size();
      if (bodies.size() < 40 || engine() % 8 == 0) {
        const Pose there = pose();
        bodies.push_back(shared.add(shape, there));
        EXPECT_EQ(plain.add(shape, there), bodies.back());
      } else if (engine() % 8 == 0) {
        shared.remove(bodies[which]);
        plain.remove(bodies[which]);
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(which));
      } else {
        Pose there = plain.pose(bodies[which]);
        there.translation.x() += 0.01;
        if (engine() % 8 == 0) there = pose();
        shared.move(bodies[which], there);
        plain.move(bodies[which], there);
      }
    }
    shared.publish();
    const Vec3 point(between(-9, 9), 0.01 * frame, between(-1, 1));
    const auto expected = plain.nearest_body({point, 0}, infinity, of_plain);
    const auto found = shared.read()->nearest_body({point, 0}, infinity, session);
    ASSERT_TRUE(found && expected);
    ASSERT_EQ(found->body, expected->body);
    ASSERT_EQ(found->contact.distance, expected->contact.distance);
    ASSERT_EQ(shared.read()->size(), plain.size());
  }
}

/// Two plates always two apart move together between threads: whoever sees one of them moved and the other
/// not measures another distance.
TEST(SharedScene, IsOneFrameToEveryReaderWhileAnotherThreadPublishes) {
  SharedScene<BruteForce> shared;
  const ShapeId shape = shared.add_shape(Shape<BruteForce>::build(square()));
  const BodyId low = shared.add(shape, at(0, 0, -1)), high = shared.add(shape, at(0, 0, 1));
  for (int i = 0; i < 30; ++i) shared.add(shape, at(10 + 3 * i, 0, 0));
  shared.publish();
  std::atomic<bool> done = false;
  std::atomic<int> torn = 0;
  std::array<std::atomic<int>, 2> ticks{};
  const auto ask = [&](std::size_t who) {
    Scene<BruteForce>::Session session;
    while (!done) {
      const auto frame = shared.read();
      const auto near = frame->nearest_body({{0, 0, 0}, 0}, 1.5, session);
      if (near) {
        // The nearer plate is at z, the other at z + 2 or z - 2.
        const double z = near->contact.point.z();
        const auto other = frame->nearest_body({{0, 0, near->body == low ? z + 2 : z - 2}, 0}, 1.5, session);
        if (!other || other->body == near->body || other->contact.distance != 0) ++torn;
      } else {
        ++torn;
      }
      ++ticks[who];
    }
  };
  std::array readers{std::thread(ask, 0), std::thread(ask, 1)};
  // Until both have asked often enough to have met frames that come and go.
  for (int frame = 0; frame < 150 || ticks[0] < 300 || ticks[1] < 300; ++frame) {
    const double z = 0.25 * (frame % 4) - 0.5;  // sums of quarters are exact
    shared.move(low, at(0, 0, z - 1));
    shared.move(high, at(0, 0, z + 1));
    shared.publish();
  }
  done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(torn, 0);
}

TEST(SharedScene, SeesABodyThatMovesInTheFrameAfterAnotherMovedAsFar) {
  SharedScene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(square()));
  const BodyId first = scene.add(shape, {Eigen::Matrix3d::Identity(), {100, 0, 0}});
  const BodyId second = scene.add(shape, {Eigen::Matrix3d::Identity(), {0, 0, 10}});
  scene.publish();
  Scene<BruteForce>::Session session;
  scene.move(first, {Eigen::Matrix3d::Identity(), {200, 0, 0}});
  scene.publish();
  EXPECT_FALSE(scene.read()->touches({{0, 0, 0}, 0.5}, session));
  scene.move(second, {Eigen::Matrix3d::Identity(), {0, 0, 0.25}});
  scene.publish();
  EXPECT_TRUE(scene.read()->touches({{0, 0, 0}, 0.5}, session));
}

TEST(SharedScene, CountsBothCopiesOfWhereBodiesAreAndTheShapesOnce) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Shape<BruteForce> shape = Shape<BruteForce>::build(mesh);
  Scene<BruteForce> one;
  SharedScene<BruteForce> shared;
  const ShapeId in_one = one.add_shape(shape), in_shared = shared.add_shape(shape);
  one.reserve(1000);
  shared.reserve(1000);
  for (int i = 0; i < 1000; ++i) {
    Pose pose;
    pose.translation.x() = 3 * i;
    one.add(in_one, pose);
    shared.add(in_shared, pose);
  }
  EXPECT_GE(shared.bytes_of_bodies(), one.bytes_of_bodies());
  shared.publish();
  shared.move(shared.add(in_shared, Pose()), Pose());  // the other copy follows
  EXPECT_GE(shared.bytes_of_bodies(), 2 * one.bytes_of_bodies() * 9 / 10);
  EXPECT_EQ(shared.bytes() - shared.bytes_of_bodies(), one.bytes_of_shapes());
  EXPECT_EQ(Scene<BruteForce>::bytes_of_session(), sizeof(Scene<BruteForce>::Session));
}

}  // namespace
}  // namespace touchmark

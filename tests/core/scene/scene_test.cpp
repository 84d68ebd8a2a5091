#include "core/scene/scene.h"

#include <memory>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

static_assert(Detector<Scene<BruteForce>> && AnswersTouches<Scene<BruteForce>>);
static_assert(AnswersNearest<Scene<SphereCluster>> && AnswersSweep<Scene<SphereCluster>>);

/// The square |x|, |y| <= 1 in the plane z = 0, seen from above.
TriangleMesh square() {
  return TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

Pose at(double x, double y, double z) { return {Eigen::Matrix3d::Identity(), {x, y, z}}; }

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

}  // namespace
}  // namespace touchmark

// Scenes of the C interface: the same bits as in C++, errors that name the argument.
#include "core/scene/scene.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/c/touchmark.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace {

using touchmark::Shape;
using touchmark::SphereCluster;
using touchmark::Vec3;
using Bodies = touchmark::Scene<SphereCluster>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double origin[3] = {0, 0, 0};

void expect_error(const std::string& text) { EXPECT_EQ(touchmark_last_error(), text); }

/// Owns a scene and a session of it.
class Asked {
 public:
  touchmark_scene* scene = touchmark_scene_create();
  touchmark_scene_session* session = touchmark_scene_session_create(scene);

  Asked() = default;
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;
  ~Asked() {
    touchmark_scene_session_free(session);
    touchmark_scene_free(scene);
  }
  std::uint64_t add(std::uint32_t shape, double x, double y, double z) {
    const double position[3] = {x, y, z};
    std::uint64_t body = 99;
    EXPECT_EQ(touchmark_scene_add(scene, shape, position, nullptr, &body), TOUCHMARK_YES)
        << touchmark_last_error();
    return body;
  }
};

TEST(CScenes, AnswerTheSameBitsAsInCpp) {
  const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  touchmark_mesh* mesh = touchmark_mesh_create(vertices, 4, triangles, 4);
  Asked asked;
  std::uint32_t shape[5] = {};
  EXPECT_EQ(touchmark_scene_add_mesh(asked.scene, mesh, &shape[0]), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_add_plane(asked.scene, 2, 1, &shape[1]), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_add_box(asked.scene, 1, 0.5, 0.25, &shape[2]), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_add_sphere(asked.scene, 0.5, &shape[3]), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_add_capsule(asked.scene, 0.25, 1, &shape[4]), TOUCHMARK_YES);
  touchmark_mesh_free(mesh);
  Bodies expected;
  expected.add_shape(Shape<SphereCluster>::build(
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}));
  // By hand, to tell the primitives apart from what makes them.
  expected.add_shape(Shape<SphereCluster>::build(
      {{{-1, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}, {{0, 1, 2}, {0, 2, 3}}}));
  expected.add_shape(Shape<SphereCluster>::box({1, 0.5, 0.25}));
  expected.add_shape(Shape<SphereCluster>::round({0, 0, 0}, {0, 0, 0}, 0.5));
  expected.add_shape(Shape<SphereCluster>::round({0, 0, -0.5}, {0, 0, 0.5}, 0.25));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-2, 2);
  const auto point = [&] { return Vec3(anywhere(random), anywhere(random), anywhere(random)); };
  std::vector<std::uint64_t> bodies;
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Vec3 position = point();
    const double orientation[4] = {anywhere(random), anywhere(random), anywhere(random), anywhere(random)};
    bodies.push_back(99);
    ASSERT_EQ(touchmark_scene_add(asked.scene, shape[i % 5], position.data(), orientation, &bodies.back()),
              TOUCHMARK_YES);
    expected.add({i % 5}, touchmark::pose_of(position, orientation[0], orientation[1], orientation[2],
                                             orientation[3]));
  }
  Bodies::Session session;
  std::size_t touching = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 center = point(), to = point();
    const bool touches = expected.touches({center, 0.1}, session);
    touching += touches ? 1 : 0;
    EXPECT_EQ(touchmark_scene_touches(asked.session, center.data(), 0.1) == TOUCHMARK_YES, touches);
    const auto nearest = expected.nearest_body({center, 0}, infinity, session);
    touchmark_contact contact;
    std::uint64_t body = 99;
    ASSERT_EQ(touchmark_scene_nearest(asked.session, center.data(), infinity, &contact, &body),
              TOUCHMARK_YES);
    EXPECT_EQ(body, bodies[nearest->body.index]);
    EXPECT_EQ(contact.distance, nearest->contact.distance);
    EXPECT_EQ(contact.triangle, nearest->contact.triangle);
    EXPECT_EQ(Vec3(contact.point[0], contact.point[1], contact.point[2]), nearest->contact.point);
    EXPECT_EQ(Vec3(contact.normal[0], contact.normal[1], contact.normal[2]), nearest->contact.normal);
    const auto hit = expected.first_hit_body({center, to, 0.05}, session);
    touchmark_impact impact;
    ASSERT_EQ(touchmark_scene_first_hit(asked.session, center.data(), to.data(), 0.05, &impact, &body),
              hit ? TOUCHMARK_YES : TOUCHMARK_NO);
    if (!hit) continue;
    EXPECT_EQ(body, bodies[hit->body.index]);
    EXPECT_EQ(impact.fraction, hit->impact.fraction);
    EXPECT_EQ(impact.contact.distance, hit->impact.contact.distance);
  }
  EXPECT_GT(touching, 20u);
  EXPECT_LT(touching, 480u);
}

TEST(CScenes, ABallOnAFloorIsFoundWhereGeometryPutsIt) {
  Asked asked;
  std::uint32_t floor = 9, ball = 9;
  touchmark_scene_add_plane(asked.scene, 4, 4, &floor);
  touchmark_scene_add_sphere(asked.scene, 0.5, &ball);
  const std::uint64_t ground = asked.add(floor, 0, 0, 0), first = asked.add(ball, 0, 0, 0.5);
  EXPECT_EQ(touchmark_scene_size(asked.scene), 2u);
  EXPECT_GT(touchmark_scene_bytes(asked.scene), 0u);
  const double above[3] = {0, 0, 1.25}, beside[3] = {1.5, 0, 0.25};
  touchmark_contact contact;
  std::uint64_t body = 99;
  ASSERT_EQ(touchmark_scene_nearest(asked.session, above, 1, &contact, &body), TOUCHMARK_YES);
  EXPECT_EQ(body, first);
  EXPECT_EQ(contact.distance, 0.25);
  EXPECT_EQ(contact.normal[2], 1);
  ASSERT_EQ(touchmark_scene_nearest(asked.session, beside, 1, &contact, &body), TOUCHMARK_YES);
  EXPECT_EQ(body, ground);
  EXPECT_EQ(contact.distance, 0.25);

  const double away[3] = {9, 9, 9};
  EXPECT_EQ(touchmark_scene_touches(asked.session, above, 0.25), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_move(asked.scene, first, away, nullptr), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_touches(asked.session, above, 0.25), TOUCHMARK_NO);
  EXPECT_EQ(touchmark_scene_remove(asked.scene, first), TOUCHMARK_YES);
  EXPECT_NE(asked.add(ball, 0, 0, 0.5), first);
  EXPECT_EQ(touchmark_scene_touches(asked.session, above, 0.25), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_move(asked.scene, first, away, nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_scene_move: there is no body 1 of generation 0");
}

TEST(CScenes, ASessionKeepsItsSceneAlive) {
  touchmark_scene* scene = touchmark_scene_create();
  std::uint32_t shape = 9;
  std::uint64_t body = 9;
  touchmark_scene_add_box(scene, 2, 2, 2, &shape);
  touchmark_scene_add(scene, shape, origin, nullptr, &body);
  touchmark_scene_session* session = touchmark_scene_session_create(scene);
  touchmark_scene_free(scene);
  EXPECT_EQ(touchmark_scene_touches(session, origin, 1), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_touches(session, origin, std::nextafter(1, 0)), TOUCHMARK_NO);
  touchmark_scene_session_free(session);
}

TEST(CScenes, FailForWhatIsWrongAndNameIt) {
  Asked asked;
  std::uint32_t shape = 9;
  std::uint64_t body = 9;
  const double nowhere[3] = {0, nan, 0}, no_turn[4] = {0, 0, 0, 0};
  EXPECT_EQ(touchmark_scene_add_sphere(nullptr, 1, &shape), TOUCHMARK_ERROR);
  expect_error("touchmark_scene_add_sphere: scene is NULL");
  EXPECT_EQ(touchmark_scene_add_sphere(asked.scene, 1, nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_scene_add_sphere: shape is NULL");
  EXPECT_EQ(touchmark_scene_add_mesh(asked.scene, nullptr, &shape), TOUCHMARK_ERROR);
  expect_error("touchmark_scene_add_mesh: mesh is NULL");
  EXPECT_EQ(touchmark_scene_add_sphere(asked.scene, 0, &shape), TOUCHMARK_ERROR);
  expect_error("touchmark_scene_add_sphere: the radius of a sphere is 0; it must be from 1e-30 to 1e+30");
  EXPECT_EQ(touchmark_scene_add_box(asked.scene, 1, nan, 1, &shape), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_add_plane(asked.scene, 1, -1, &shape), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_add_capsule(asked.scene, 1, infinity, &shape), TOUCHMARK_ERROR);
  EXPECT_EQ(shape, 9u);
  EXPECT_EQ(touchmark_scene_add(asked.scene, 0, origin, nullptr, &body), TOUCHMARK_ERROR);
  expect_error("touchmark_scene_add: there is no shape 0: the scene has 0");
  ASSERT_EQ(touchmark_scene_add_sphere(asked.scene, 1, &shape), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_scene_add(asked.scene, shape, nowhere, nullptr, &body), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_add(asked.scene, shape, origin, no_turn, &body), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_add(asked.scene, shape, nullptr, nullptr, &body), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_add(asked.scene, shape, origin, nullptr, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_move(asked.scene, 7, origin, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_remove(asked.scene, 7), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_remove(nullptr, 7), TOUCHMARK_ERROR);
  EXPECT_EQ(body, 9u);
  EXPECT_EQ(touchmark_scene_size(asked.scene), 0u);
  EXPECT_EQ(touchmark_scene_size(nullptr), 0u);
  EXPECT_EQ(touchmark_scene_bytes(nullptr), 0u);
  EXPECT_EQ(touchmark_scene_session_create(nullptr), nullptr);
  EXPECT_EQ(touchmark_scene_touches(nullptr, origin, 1), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_touches(asked.session, origin, -1), TOUCHMARK_ERROR);
  expect_error("touchmark_scene_touches: radius is -1; it must be 0 or more");
  EXPECT_EQ(touchmark_scene_nearest(asked.session, nullptr, 1, nullptr, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_nearest(asked.session, origin, infinity, nullptr, nullptr), TOUCHMARK_NO);
  EXPECT_EQ(touchmark_scene_first_hit(asked.session, origin, nullptr, 1, nullptr, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_scene_touches(asked.session, nowhere, 1), TOUCHMARK_NO);
}

}  // namespace

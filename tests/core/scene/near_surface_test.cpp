// A scene that stands, asked along ways: what a session lists around its point must change no answer. The
// answers are those of the same bodies over brute force, which lists nothing, bit for bit.
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/random_pose.h"

namespace touchmark {
namespace {

using test::Random, test::random_pose;

/// A closed bumpy ball of about the diameter 1, of 2 * n * n triangles.
TriangleMesh ball(int n, double bumps, double scale) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = std::acos(-1.0) * i / n, b = 2 * std::acos(-1.0) * j / n;
      const double r = 0.5 + bumps * std::sin(7 * a) * std::cos(5 * b);
      vertices.push_back(scale * r * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * n + j % n); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

struct Setting {
  const char* name;
  double scale = 1;            ///< of everything
  Vec3 offset = Vec3::Zero();  ///< of everything
  double crowd = 0.5;          ///< how far bodies are apart
  double rigid_off = 0;        ///< what rotations are off
  bool twins = false;          ///< every body is there twice
};

class NearSurfaces : public testing::TestWithParam<Setting> {
 protected:
  template <class D>
  void add_shapes(Scene<D>& scene) {
    scene.add_shape(Shape<D>::build(ball(4, 0, GetParam().scale)));
    scene.add_shape(Shape<D>::build(ball(12, 0.05, GetParam().scale)));
    if (GetParam().twins) return;
    scene.add_shape(Shape<D>::box(GetParam().scale * Vec3(0.6, 0.5, 0.4)));
    scene.add_shape(Shape<D>::sphere(0.3 * GetParam().scale));
  }
  void SetUp() override {
    add_shapes(listing);
    add_shapes(plain);
    Random random(7);
    for (int i = 0; i < 27; ++i) {
      const Vec3 cell(i % 3, i / 3 % 3, i / 9);
      Pose pose = random_pose(
          random, GetParam().scale * (GetParam().crowd * cell + random.point(0.1)) + GetParam().offset);
      pose.rotation(0, 1) += GetParam().rigid_off;
      const ShapeId shape{static_cast<std::uint32_t>(random.below(GetParam().twins ? 2 : 4))};
      for (int copies = GetParam().twins ? 2 : 1; copies > 0; --copies) {
        ids.push_back(listing.add(shape, pose));
        plain.add(shape, pose);
      }
    }
  }
  void expect_alike(const Vec3& point, double reach) {
    const auto found = listing.nearest_body({point, 0}, reach, session);
    const auto right = plain.nearest_body({point, 0}, reach, plain_session);
    ASSERT_EQ(found.has_value(), right.has_value());
    if (right) {
      EXPECT_EQ(found->body, right->body);
      EXPECT_EQ(found->contact.triangle, right->contact.triangle);
      EXPECT_EQ(found->contact.distance, right->contact.distance);
      EXPECT_EQ(found->contact.point, right->contact.point);
      EXPECT_EQ(found->contact.normal, right->contact.normal);
    }
    EXPECT_EQ(listing.touches({point, reach}, session), right.has_value());
    if (!right) return;
    // At the distance itself, where only exact decisions tell.
    const double distance = right->contact.distance;
    for (const double radius : {std::nextafter(distance, 0), distance, std::nextafter(distance, infinity)})
      EXPECT_EQ(listing.touches({point, radius}, session), plain.touches({point, radius}, plain_session));
  }

  Scene<SphereCluster> listing;
  Scene<BruteForce> plain;
  Scene<SphereCluster>::Session session;
  Scene<BruteForce>::Session plain_session;
  std::vector<BodyId> ids;
};

TEST_P(NearSurfaces, ChangeNoAnswerAlongWaysAndAtChanges) {
  const double scale = GetParam().scale;
  Random random(11);
  for (int way = 0; way < 12 && !HasFailure(); ++way) {
    Vec3 point = GetParam().offset + scale * (GetParam().crowd * Vec3(1, 1, 1) + random.point(0.8));
    const Vec3 step = random.point(way % 3 == 0 ? 0.001 : way % 3 == 1 ? 0.01 : 0.05) * scale;
    const double reach = way % 4 == 3 ? infinity : scale * random.between(0, 0.2);
    for (int tick = 0; tick < 60 && !HasFailure(); ++tick, point += step) {
      SCOPED_TRACE(testing::Message() << "way " << way << ", tick " << tick);
      // The one that is nearest, or any.
      if (tick % 8 == 7) {
        const auto near = plain.nearest_body({point, 0}, infinity, plain_session);
        const BodyId which = tick % 16 == 7 ? near->body : ids[random.below(ids.size())];
        Pose pose = listing.pose(which);
        pose.translation += random.point(0.02) * scale;
        listing.move(which, pose);
        plain.move(which, pose);
      }
      expect_alike(point, reach);
    }
  }
}

TEST_P(NearSurfaces, SeeWhoIsRemovedWhileTouchedAndWhoAppears) {
  const double scale = GetParam().scale;
  Random random(13);
  const ShapeId shape{1};
  for (int way = 0; way < 8 && !HasFailure(); ++way) {
    Vec3 point = GetParam().offset + scale * (GetParam().crowd * Vec3(1, 1, 1) + random.point(0.4));
    const Vec3 step = random.point(0.004) * scale;
    for (int tick = 0; tick < 24 && !HasFailure(); ++tick, point += step) {
      SCOPED_TRACE(testing::Message() << "way " << way << ", tick " << tick);
      expect_alike(point, 0.2 * scale);
      if (tick % 6 != 5) continue;
      const auto near = plain.nearest_body({point, 0}, infinity, plain_session);
      const Pose pose = plain.pose(near->body);
      listing.remove(near->body);
      plain.remove(near->body);
      expect_alike(point, 0.2 * scale);
      EXPECT_EQ(listing.add(shape, pose), plain.add(shape, pose));
      expect_alike(point, 0.2 * scale);
      for (BodyId& id : ids)
        if (id.index == near->body.index) id.generation = near->body.generation + 1;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, NearSurfaces,
                         testing::Values(Setting{.name = "crowd"}, Setting{.name = "apart", .crowd = 0.9},
                                         Setting{.name = "far", .offset = {1e6, -3e5, 7e5}},
                                         Setting{.name = "small", .scale = 1e-9},
                                         Setting{.name = "tiny", .scale = 0x1p-90},
                                         Setting{.name = "large", .scale = 1e9, .offset = {1e12, 0, 0}},
                                         Setting{.name = "off_orthonormal", .rigid_off = 1e-10},
                                         Setting{.name = "twins", .twins = true}),
                         [](const auto& setting) { return setting.param.name; });

// The list is what makes a still heap cheap: along a slow way few triangles are looked at, and no body.
TEST(NearSurface, ASlowWayLooksAtFewBodies) {
  Scene<SphereCluster> scene;
  const ShapeId shape = scene.add_shape(Shape<SphereCluster>::build(ball(12, 0.05, 1)));
  Random random(3);
  for (int i = 0; i < 64; ++i) scene.add(shape, random_pose(random, 0.5 * Vec3(i % 4, i / 4 % 4, i / 16)));
  Scene<SphereCluster>::Session session;
  Vec3 point(0.8, 0.7, 0.75);
  const Vec3 step(1e-4, 2e-4, -1e-4);
  for (int tick = 0; tick < 32; ++tick, point += step) scene.nearest_body({point, 0}, infinity, session);
  const Work before = session.work;
  for (int tick = 0; tick < 64; ++tick, point += step)
    EXPECT_TRUE(scene.nearest_body({point, 0}, infinity, session));
  EXPECT_LE(session.work.bodies - before.bodies, 64);
  EXPECT_LE(session.work.triangles - before.triangles, 64 * 16);
}

}  // namespace
}  // namespace touchmark

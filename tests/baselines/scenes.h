/// What is expected of every rival that takes scenes of bodies: the nearest body and its distance, also after
/// bodies have moved, by brute force over all triangles as one mesh.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/posed.h"
#include "core/brute_force/brute_force.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {

inline TriangleMesh as_one_mesh(const PosedScene& scene) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (const PosedScene::Body& body : scene.bodies) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& vertex : scene.shapes[body.shape]->vertices())
      vertices.push_back(body.pose.rotation * vertex + body.pose.translation);
    for (const auto& corners : scene.shapes[body.shape]->triangles())
      triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
  }
  return {std::move(vertices), std::move(triangles)};
}

/// A turn by any angle; every third one by less than 1e-12, which libraries take for none.
inline Pose some_pose(Random& random, const Vec3& offset, int which) {
  const Vec3 axis = which % 3 == 0 ? Vec3(5e-13 * random.point()) : random.point();
  return pose_of(offset + 2 * random.point(), 1, axis.x(), axis.y(), axis.z());
}

/// Rounds of moves, in which every second body goes elsewhere, and probes near bodies, far and anywhere.
/// `offset` is where the scene is about.
template <class S, class Options>
void expect_nearest_body(const Options& options, const Vec3& offset) {
  Random random(7);
  PosedScene scene{
      {std::make_shared<const TriangleMesh>(bumps(4)), std::make_shared<const TriangleMesh>(square())}, {}};
  for (std::uint32_t i = 0; i < 30; ++i)
    scene.bodies.push_back({i % 2, some_pose(random, offset, static_cast<int>(i))});
  S asked(scene, options);
  typename S::Session session;
  const double rounding = 1e-14 * (8 + offset.norm());
  for (int round = 0; round < 12; ++round) {
    const TriangleMesh mesh = as_one_mesh(scene);
    const BruteForce all = BruteForce::build(mesh);
    BruteForce::Session own;
    Vec3 center = offset;
    for (int i = 0; i < 40; ++i) {
      center = i % 8 == 0 ? Vec3(offset + 3 * random.point()) : Vec3(center + 0.03 * random.point());
      const double reach = i % 10 == 9 ? std::numeric_limits<double>::infinity() : 0.3;
      const auto found = asked.nearest_body({center, 0}, reach, session);
      const auto expected = all.nearest({center, 0}, std::numeric_limits<double>::infinity(), own);
      ASSERT_TRUE(expected);
      if (std::abs(expected->distance - reach) <= rounding) continue;
      ASSERT_EQ(found.has_value(), expected->distance <= reach) << round << ' ' << i;
      if (!found) continue;
      EXPECT_NEAR(found->contact.distance, expected->distance, rounding) << round << ' ' << i;
      const PosedScene::Body& body = scene.bodies[found->body.index];
      EXPECT_NEAR((found->contact.point - center).norm(), found->contact.distance, rounding);
      EXPECT_LT(found->contact.triangle, scene.shapes[body.shape]->size());
    }
    for (std::uint32_t i = static_cast<std::uint32_t>(round) % 2; i < scene.bodies.size(); i += 2) {
      Pose& pose = scene.bodies[i].pose;
      if (i % 4 < 2)
        pose = some_pose(random, offset, static_cast<int>(i) + round);
      else
        pose.translation += 1e-3 * random.point();
      asked.place(i, pose);
    }
    if constexpr (requires { asked.publish(); }) asked.publish();
  }
}

}  // namespace touchmark::baselines

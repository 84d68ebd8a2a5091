// A proxy over a scene whose bodies move between its ticks, against the oracle over all triangles where they
// stand.
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/oracle.h"
#include "bench/support/random.h"
#include "core/haptics/proxy.h"
#include "core/scene/pose.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

using Bodies = Scene<SphereCluster>;
static_assert(GuidesProxy<Bodies>);

/// A square in a plane of constant z, and a wall in one of constant x. Whole numbers, so that a body which is
/// moved by sixteenths stands where the same sums of its corners say.
TriangleMesh plate() { return {{{-2, -2, 0}, {2, -2, 0}, {-2, 2, 0}, {2, 2, 0}}, {{0, 1, 2}, {1, 3, 2}}}; }
TriangleMesh wall() { return {{{0, -2, -2}, {0, 2, -2}, {0, -2, 2}, {0, 2, 2}}, {{0, 1, 2}, {1, 3, 2}}}; }

/// Both as one mesh.
TriangleMesh world(const Vec3& plate_at, const Vec3& wall_at) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (const auto& [mesh, at] : {std::pair(plate(), plate_at), std::pair(wall(), wall_at)}) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& vertex : mesh.vertices()) vertices.emplace_back(vertex + at);
    for (const auto& corners : mesh.triangles())
      triangles.push_back({corners[0] + first, corners[1] + first, corners[2] + first});
  }
  return {std::move(vertices), std::move(triangles)};
}

TEST(ProxyOverAScene, CrossesNoBodyThoughTheyMoveBetweenItsTicks) {
  bench::support::Random random(17);
  for (const double radius : {0.0, 0.25}) {
    Bodies scene;
    const auto add = [&](const TriangleMesh& mesh) {
      return scene.add(scene.add_shape(Shape<SphereCluster>::build(mesh, {})), Pose());
    };
    const BodyId plate_id = add(plate()), wall_id = add(wall());
    Vec3 plate_at = Vec3::Zero(), wall_at(3, 0, 0);
    Bodies::Session session;
    Proxy proxy(scene, {.radius = radius});
    proxy.place({1, 0.5, 1});
    int held = 0;
    for (int tick = 0; tick < 300; ++tick) {
      if (tick % 3 == 0) {
        plate_at.z() += 0.0625 * (static_cast<double>(random.below(5)) - 2);
        wall_at.x() += 0.0625 * (static_cast<double>(random.below(5)) - 2);
        scene.move(plate_id, pose_of(plate_at, 1, 0, 0, 0));
        scene.move(wall_id, pose_of(wall_at, 1, 0, 0, 0));
        proxy.surface_moved();
      }
      const TriangleMesh standing = world(plate_at, wall_at);
      const bench::oracle::Oracle oracle(standing, 1);
      const Vec3 before = proxy.state().position;
      const bool was_free = !oracle.segment_within(before, before, radius);
      const Vec3 goal = Vec3(wall_at.x(), 0, plate_at.z()) + 1.5 * random.direction();
      const ProxyState& state = proxy.step(goal, session);
      if (!was_free) continue;  // a body was moved onto it
      for (std::size_t i = 0; i < state.pieces; ++i)
        EXPECT_FALSE(oracle.segment_within(state.way[i], state.way[i + 1], radius)) << "tick " << tick;
      EXPECT_TRUE(state.position == goal || oracle.segment_within(before, goal, radius)) << "tick " << tick;
      held += state.contacts > 0 ? 1 : 0;
    }
    EXPECT_GT(held, 10) << "the bodies are in its way";
  }
}

}  // namespace
}  // namespace touchmark

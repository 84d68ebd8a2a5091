// Proxies over meshes that go over them between two steps. Both motions are replayed by an oracle of
// rationals.
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/exact/moving_meeting.h"
#include "bench/support/random.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/haptics/proxy.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

using bench::oracle::any_meets;
using bench::support::Random;

/// A sheet of 8 x 8 squares, 2 wide, at places that `at` gives.
template <class At>
TriangleMesh sheet(const At& at) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i <= 8; ++i)
    for (std::uint32_t k = 0; k <= 8; ++k) {
      vertices.push_back(at(i / 4.0 - 1, k / 4.0 - 1));
      if (i == 8 || k == 8) continue;
      const std::uint32_t v = 9 * i + k;
      triangles.push_back({v, v + 9, v + 10});
      triangles.push_back({v, v + 10, v + 1});
    }
  return {std::move(vertices), std::move(triangles)};
}

template <class D>
class PushedProxy : public testing::Test {};
using PushingDetectors = testing::Types<SphereCluster, AabbTree>;
TYPED_TEST_SUITE(PushedProxy, PushingDetectors);

/// Level, tilted, curved and shaken sheets go over a proxy that wants to stay, up and down again.
TYPED_TEST(PushedProxy, IsOnTheSameSideOfASheetThatGoesOverItEachTick) {
  Random random(1);
  std::size_t pushed = 0, kept = 0, ticks = 0;
  for (int course = 0; course < 8; ++course) {
    const double radius = course % 2 == 0 ? 0.1 : 0;
    const auto drawn = [&](double height) {
      const double tilt = course < 2 ? 0 : 0.3 * random.between(-1, 1),
                   bend = course < 4 ? 0 : 0.2 * random.unit();
      const double noise = course < 6 ? 0 : 0.01;
      return sheet([&](double x, double y) {
        return Vec3(x, y, height + tilt * x + bend * (x * x + y * y) + noise * random.unit());
      });
    };
    TriangleMesh mesh = drawn(-1);
    TypeParam detector = TypeParam::build(mesh);
    typename TypeParam::Session session;
    Proxy<TypeParam> proxy(detector, {.radius = radius, .stiffness = 100}, &mesh);
    proxy.place(Vec3::Zero());
    for (int tick = 0; tick < 30; ++tick) {
      const TriangleMesh next = drawn(tick % 2 == 0 ? random.between(0, 1) : random.between(-1, 0));
      const Vec3 from = proxy.state().position;
      proxy.surface_moving(MeshMotion(mesh, next), session);
      const Vec3 to = proxy.state().position;
      ASSERT_FALSE(any_meets(mesh, next, from, to)) << course << ", " << tick;
      pushed += to != from ? 1 : 0;
      mesh = next;
      detector.update(mesh);
      proxy.surface_moved(&mesh);
      const ProxyState& state = proxy.step(Vec3(0.1 * random.unit(), 0.1 * random.unit(), -0.5), session);
      ++ticks;
      kept += state.status != ProxyStatus::stuck ? 1 : 0;
      ASSERT_EQ(state.way[0], from);
      // It stays above the sheet: straight up there is nothing.
      ASSERT_FALSE(detector.first_hit({state.position, state.position + Vec3(0, 0, 9)}, session));
    }
  }
  EXPECT_GT(pushed, ticks / 4);
  EXPECT_GT(kept, ticks * 9 / 10);
}

/// A bowl goes up and leans over meanwhile: each plane that a bare point in it is pushed off leads to the
/// next.
TYPED_TEST(PushedProxy, GoesAheadOfABowlWhosePlanesLeadNowhere) {
  const auto bowl = [](double height, double tilt, double bend) {
    return sheet([=](double x, double y) { return Vec3(x, y, height + tilt * x + bend * (x * x + y * y)); });
  };
  const TriangleMesh before = bowl(-0.23322461500599601, 0.13741389378607002, 0.13550678300915553),
                     after = bowl(0.091299600741754916, -0.27592053104386388, 0.036543558444518932);
  const Vec3 start(-2.8754776337791554e-14, 0.055088544095615248, -0.23135839715801759);
  const TypeParam detector = TypeParam::build(before);
  typename TypeParam::Session session;
  Proxy<TypeParam> proxy(detector, {.radius = 0, .stiffness = 100}, &before);
  proxy.place(start);
  EXPECT_TRUE(proxy.surface_moving(MeshMotion(before, after), session));
  EXPECT_FALSE(any_meets(before, after, start, proxy.state().position));
  EXPECT_LT((proxy.state().position - start).norm(), 1);
}

TYPED_TEST(PushedProxy, EndsItsRadiusOffALevelSheetAndRestsWhereNoneComes) {
  const auto level = [](double height) {
    return sheet([&](double x, double y) { return Vec3(x, y, height); });
  };
  const TriangleMesh before = level(-1), after = level(2);
  const TypeParam detector = TypeParam::build(before);
  typename TypeParam::Session session;
  Proxy<TypeParam> proxy(detector, {.radius = 0.25, .stiffness = 100}, &before);
  proxy.place(Vec3(0.1, 0.2, 0));
  EXPECT_TRUE(proxy.surface_moving(MeshMotion(before, level(-0.5)), session));
  EXPECT_EQ(proxy.state().position, Vec3(0.1, 0.2, 0));
  EXPECT_TRUE(proxy.surface_moving(MeshMotion(before, after), session));
  EXPECT_NEAR(proxy.state().position.z(), 2.25, 0.02);
  EXPECT_GT(proxy.state().position.z(), 2.25);
}

}  // namespace
}  // namespace touchmark

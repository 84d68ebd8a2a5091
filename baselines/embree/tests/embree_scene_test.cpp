#include "baselines/embree/embree_scene.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/baselines/meshes.h"
#include "tests/baselines/scenes.h"

namespace touchmark::baselines {
namespace {

TEST(EmbreeScene, FindsTheNearestBodyWhileBodiesMove) {
  expect_nearest_body<EmbreeScene>(EmbreeDetector::Options{}, Vec3::Zero());
  expect_nearest_body<EmbreeScene>(EmbreeDetector::Options{.quality = EmbreeDetector::Quality::high},
                                   Vec3(0, 1 << 20, 3));
}

// Embree takes a transform that is set, but its boxes are those of before until the scene is committed.
TEST(EmbreeScene, FindsABodyWhereItWasPublished) {
  PosedScene row{{std::make_shared<const TriangleMesh>(square())}, {}};
  for (int i = 0; i < 40; ++i) row.bodies.push_back({0, {Eigen::Matrix3d::Identity(), {3.0 * i, 0, 0}}});
  EmbreeScene scene(row, {});
  EmbreeScene::Session session;
  scene.place(7, {Eigen::Matrix3d::Identity(), {0, 0, 5}});
  EXPECT_FALSE(scene.nearest_body({{0.5, 0.5, 5}, 0}, 0.5, session));
  scene.publish();
  EXPECT_TRUE(scene.nearest_body({{0.5, 0.5, 5}, 0}, 0.5, session));
}

}  // namespace
}  // namespace touchmark::baselines

#include "core/sign/signed_detector.h"

#include <gtest/gtest.h>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

template <class D>
class SignedDetector : public testing::Test {};

using Detectors = testing::Types<BruteForce, AabbTree, GridGroup, SphereCluster>;
TYPED_TEST_SUITE(SignedDetector, Detectors);

TYPED_TEST(SignedDetector, IsBuiltWithoutOptionsAsTheDetectorItselfIs) {
  const auto detector = Signed<TypeParam>::build(tetrahedron());
  typename Signed<TypeParam>::Session session;
  const auto inside = detector.nearest({{0.125, 0.25, 0.25}, 0}, infinity, session);
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->side, Side::inside);
  EXPECT_EQ(inside->distance, 0.125);  // from the face x = 0
  const auto outside = detector.nearest({{-0.5, 0.25, 0.25}, 0}, infinity, session);
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->side, Side::outside);
  EXPECT_EQ(outside->distance, 0.5);
}

}  // namespace
}  // namespace touchmark

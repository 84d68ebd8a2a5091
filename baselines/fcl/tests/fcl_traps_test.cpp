/// Faults of FCL 0.7 as Debian 12 ships it, each as a test that passes while the fault is there. When one
/// fails, FCL has changed: see baselines/fcl/README.md for what may then go.
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include "baselines/fcl/fcl_detector.h"
#include "tests/baselines/meshes.h"

namespace {
std::size_t allocated = 0;  // bytes, by this thread's operator new
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  allocated += size;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
// Those of arrays call these in the standard library, but not in a sanitizer's.
[[gnu::noinline]] void* operator new[](std::size_t size) { return operator new(size); }
[[gnu::noinline]] void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  allocated += size;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete[](void* memory) noexcept { operator delete(memory); }
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept { operator delete(memory); }

namespace touchmark::baselines {
namespace {

using Volume = FclDetector::Volume;
using Method = FclDetector::Method;
using Narrow = FclDetector::Narrow;

TriangleMesh one_triangle() {
  return TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {TriangleMesh::Corners{0, 1, 2}});
}

template <class Box>
std::unique_ptr<fcl::BVHModel<Box>> raw_model(const TriangleMesh& mesh) {
  auto model = std::make_unique<fcl::BVHModel<Box>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& corners : mesh.triangles()) triangles.emplace_back(corners[0], corners[1], corners[2]);
  model->beginModel();
  model->addSubModel(std::vector<Vec3>(mesh.vertices().begin(), mesh.vertices().end()), triangles);
  model->endModel();
  model->computeLocalAABB();
  return model;
}

fcl::Transform3d at(const Vec3& center) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = center;
  return pose;
}

TEST(FclTraps, TheDepthIsThatOfTheLastEdgeHitNotOfTheDeepest) {
  // The edge from (0,0) to (1,0) is 0.1 away, the last edge 0.51.
  const FclDetector own = FclDetector::build(one_triangle());
  FclDetector::Session session;
  EXPECT_NEAR(own.nearest({{0.5, -0.1, 0}, 0}, 1, session)->distance, 0.51, 0.001);
  const FclDetector distance =
      FclDetector::build(one_triangle(), {Volume::kios, Method::distance, Narrow::fcl});
  EXPECT_NEAR(distance.nearest({{0.5, -0.1, 0}, 0}, 1, session)->distance, 0.1, 1e-15);
}

TEST(FclTraps, ATriangleWithoutAreaHitsWhateverMeetsItsBox) {
  const TriangleMesh segment({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {TriangleMesh::Corners{0, 1, 2}});
  const Probe away{{2, 0, 0}, 0.1};  // sqrt(8/3) from the segment
  FclDetector::Session session;
  EXPECT_TRUE(
      FclDetector::build(segment, {Volume::aabb, Method::traverse, Narrow::fcl}).touches(away, session));
  EXPECT_FALSE(
      FclDetector::build(segment, {Volume::aabb, Method::traverse, Narrow::exact}).touches(away, session));
}

TEST(FclTraps, AnEpsilonIsAddedToEveryRadius) {
  const Vec3 center(0.25, 0.25, std::nextafter(0.5, 1));
  FclDetector::Session session;
  const FclDetector plain = FclDetector::build(one_triangle(), {.query = baselines::Asking::plain});
  EXPECT_TRUE(plain.touches({center, 0.5}, session));
}

TEST(FclTraps, CollidingBoxesCopyTheMeshAtEveryQuery) {
  const TriangleMesh mesh = bumps(20);
  const auto bytes_of_a_query = [&](Method method) {
    const FclDetector detector = FclDetector::build(mesh, {Volume::aabb, method, Narrow::fcl, Asking::plain});
    FclDetector::Session session;
    detector.touches({{0, 0, 5}, 0.1}, session);
    const std::size_t before = allocated;
    detector.touches({{0, 0, 5}, 0.1}, session);
    return allocated - before;
  };
  EXPECT_GT(bytes_of_a_query(Method::collide), mesh.vertices().size() * sizeof(Vec3));
  EXPECT_EQ(bytes_of_a_query(Method::traverse), 0u);
}

TEST(FclTraps, OneContactIsAllThatADefaultRequestGives) {
  const auto model = raw_model<fcl::kIOSd>(square());
  const fcl::Sphered ball(0.5);
  fcl::CollisionResultd result;
  fcl::collide(model.get(), fcl::Transform3d::Identity(), &ball, at({0.5, 0.5, 0.1}), {}, result);
  EXPECT_EQ(result.numContacts(), 1u);
}

TEST(FclTraps, PenetrationDepthIsNegative) {
  const auto model = raw_model<fcl::kIOSd>(one_triangle());
  const fcl::Sphered ball(0.5);
  fcl::CollisionResultd result;
  fcl::collide(model.get(), fcl::Transform3d::Identity(), &ball, at({0.25, 0.25, 0.125}),
               fcl::CollisionRequestd(10, true), result);
  ASSERT_EQ(result.numContacts(), 1u);
  EXPECT_NEAR(result.getContact(0).penetration_depth, -0.375, 1e-15);
}

TEST(FclTraps, DistanceToASphereIsMissingForOrientedAndAlignedBoxes) {
  const auto boxes = raw_model<fcl::AABBd>(one_triangle());
  const auto oriented = raw_model<fcl::OBBd>(one_triangle());
  const fcl::Sphered ball(0.5);
  for (const fcl::CollisionGeometryd* model : {static_cast<const fcl::CollisionGeometryd*>(boxes.get()),
                                               static_cast<const fcl::CollisionGeometryd*>(oriented.get())}) {
    testing::internal::CaptureStderr();
    fcl::DistanceResultd result;
    fcl::distance(model, fcl::Transform3d::Identity(), &ball, at({0, 0, 5}), fcl::DistanceRequestd(true),
                  result);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("not supported"), std::string::npos);
    EXPECT_LT(result.b1, 0);
  }
}

TEST(FclTraps, TheDefaultContinuousCollisionMissesAThinPlate) {
  const auto model = raw_model<fcl::OBBRSSd>(square());
  const fcl::Sphered ball(0.01);
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(model.get(), fcl::Transform3d::Identity(), fcl::Transform3d::Identity(), &ball,
                         at({0.3, 0.3, 1}), at({0.3, 0.3, -1.1}), fcl::ContinuousCollisionRequestd(), result);
  EXPECT_FALSE(result.is_collide);
}

TEST(FclTraps, ConservativeAdvancementMissesAsWell) {
  const auto model = raw_model<fcl::OBBRSSd>(bumps(12));
  const fcl::Sphered ball(0.02);
  const fcl::ContinuousCollisionRequestd request(1000, 1e-8, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                                 fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
  Random random(4);
  int found = 0;
  for (int trial = 0; trial < 20; ++trial) {  // straight through the surface, which lies within |z| <= 0.2
    const double x = 0.9 * random.between(-1, 1), y = 0.9 * random.between(-1, 1);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(model.get(), fcl::Transform3d::Identity(), fcl::Transform3d::Identity(), &ball,
                           at({x, y, 1}), at({x, y, -1}), request, result);
    found += result.is_collide;
  }
  EXPECT_LE(found, 5);
}

// A corner 1e6 from the middle goes by 5e-7 out of the box.
TEST(FclTraps, ARotationBelowAMillionthOfAMillionthLeavesTheBoxUnturned) {
  const TriangleMesh mesh({{0, 0, 0}, {1e6, 0, 0}, {0, 1e6, 0}}, {{0, 1, 2}});
  fcl::CollisionObjectd object(std::shared_ptr<fcl::CollisionGeometryd>(raw_model<fcl::AABBd>(mesh)));
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear()(2, 0) = 5e-13;
  pose.linear()(0, 2) = -5e-13;
  object.setTransform(pose);
  object.computeAABB();
  EXPECT_FALSE(object.getAABB().contain(pose * Vec3(1e6, 0, 0)));
}

}  // namespace
}  // namespace touchmark::baselines

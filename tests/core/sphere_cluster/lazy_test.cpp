// Distances that the first queries sample: the bits of what was built whole, whoever came first.
#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/lazy_making.h"

namespace touchmark {
namespace {

const SphereCluster::Options lazy{.construction = SphereCluster::Construction::lazy};

class LazyDistances : public test::LazyMaking<SphereCluster> {};

TEST_F(LazyDistances, AnswerWithTheSameBitsInAnyOrder) {
  for (const auto& order : orders()) {
    const SphereCluster detector = SphereCluster::build(mesh_, lazy);
    for (int pass = 0; pass < 3; ++pass) EXPECT_EQ(wrong_answers(detector, order), 0);
  }
}

TEST_F(LazyDistances, AnswerManyThreadsAtOnce) { expect_right_answers_in_threads(lazy); }

TEST_F(LazyDistances, AreSampledWithBoundedWorkInAQuery) {
  const SphereCluster detector = SphereCluster::build(mesh_, lazy);
  SphereCluster::Session session, session_of_whole;
  // The samples about one place are searched without a limit; none of them may see much of the mesh.
  const std::uint64_t max_in_samples = mesh_.size() / 4;
  ASSERT_LE(max_in_samples, 1024u);
  // Each part of the hierarchy is built once, at a look at each of its triangles.
  std::uint64_t max_to_build = mesh_.size();
  for (int pass = 0; pass < 2; ++pass) {
    for (const test::Question& question : all_) {
      const std::uint64_t before = session.work.total(), before_of_whole = session_of_whole.work.total();
      detector.nearest({question.center, 0}, question.reach, session);
      whole_.nearest({question.center, 0}, question.reach, session_of_whole);
      const std::uint64_t usual = session_of_whole.work.total() - before_of_whole + max_in_samples,
                          taken = session.work.total() - before;
      EXPECT_LE(taken, usual + max_to_build);
      if (taken > usual) max_to_build -= std::min(max_to_build, taken - usual);
    }
    max_to_build = 0;
  }
}

TEST_F(LazyDistances, LeaveMostOfTheHierarchyToTheQueries) {
  // So large that it has many parts, of which a query about one place needs few.
  const TriangleMesh mesh = test::bumpy_sphere(80, 0.05, 1);
  ASSERT_GT(mesh.size(), 16u * 512);
  const SphereCluster lazily = SphereCluster::build(mesh, lazy), whole = SphereCluster::build(mesh);
  SphereCluster::Session first, second, session_of_whole;
  const Probe probe{mesh.corner(mesh.size() / 2, 0), 0.01};
  const auto contact = lazily.nearest(probe, 0.05, first);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->distance, whole.nearest(probe, 0.05, session_of_whole)->distance);
  EXPECT_GT(first.work.triangles, 400u);
  EXPECT_LT(first.work.triangles, mesh.size() / 4);
  lazily.nearest(probe, 0.05, second);
  EXPECT_LT(second.work.triangles, 400u);
}

TEST_F(LazyDistances, BuildTheRestWhereEveryTriangleIsLookedAt) {
  const SphereCluster detector = SphereCluster::build(mesh_, lazy);
  SphereCluster::Session session, session_of_whole;
  const double far = 0x1p24;
  const auto contact = detector.nearest({Vec3(far, far, far), 0}, 2 * far, session),
             expected = whole_.nearest({Vec3(far, far, far), 0}, 2 * far, session_of_whole);
  ASSERT_TRUE(contact && expected);
  EXPECT_EQ(contact->triangle, expected->triangle);
  EXPECT_EQ(contact->distance, expected->distance);
}

TEST_F(LazyDistances, ACopyGoesOnByItself) {
  const SphereCluster detector = SphereCluster::build(mesh_, lazy);
  SphereCluster::Session session;
  for (std::size_t i = 0; i < all_.size() / 2; ++i)
    detector.nearest({all_[i].center, 0}, all_[i].reach, session);
  const SphereCluster copy = detector;
  EXPECT_EQ(wrong_answers(copy, order_), 0);
  EXPECT_EQ(wrong_answers(detector, order_), 0);
}

TEST_F(LazyDistances, AreSampledOnceAndThenServe) {
  const SphereCluster detector = SphereCluster::build(mesh_, lazy);
  const auto work_of_a_pass = [&](const SphereCluster& of) {
    std::uint64_t work = 0;
    for (const test::Question& question : all_) {
      SphereCluster::Session session;
      of.touches({question.center, 0.02}, session);
      work += session.work.total();
    }
    return work;
  };
  const std::uint64_t first = work_of_a_pass(detector);
  work_of_a_pass(detector);
  const std::uint64_t third = work_of_a_pass(detector), whole = work_of_a_pass(whole_);
  EXPECT_GT(first, whole);
  EXPECT_LT(third, first);
  // Of the eight samples about a place, those of cubes that nothing was asked in stay untaken.
  EXPECT_LE(static_cast<double>(third), 1.25 * static_cast<double>(whole));
}

TEST_F(LazyDistances, AreSampledAnewWhereTheMeshHasMoved) {
  SphereCluster detector = SphereCluster::build(mesh_, lazy);
  wrong_answers(detector, order_);
  detector.update(mesh_.transformed(0.98, Vec3(0, 0, 0)));
  EXPECT_GT(wrong_answers(detector, order_), 100);
  detector.update(mesh_);
  for (int pass = 0; pass < 3; ++pass) EXPECT_EQ(wrong_answers(detector, order_), 0);
}

TEST_F(LazyDistances, TakeNoMemoryInQueries) {
  const SphereCluster detector = SphereCluster::build(mesh_, lazy);
  const std::size_t bytes = detector.bytes();
  wrong_answers(detector, order_);
  EXPECT_EQ(detector.bytes(), bytes);
  EXPECT_LT(bytes, whole_.bytes() + 56 * mesh_.size());
}

}  // namespace
}  // namespace touchmark

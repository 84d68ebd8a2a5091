// Distances that the first queries sample: the bits of what was built whole, whoever came first.
#include <cstdint>
#include <stdexcept>

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
  const std::uint64_t most_in_samples = mesh_.size() / 4;
  ASSERT_LE(most_in_samples, 1024u);
  for (const test::Question& question : all_) {
    const std::uint64_t before = session.work.total(), before_of_whole = session_of_whole.work.total();
    detector.nearest({question.center, 0}, question.reach, session);
    whole_.nearest({question.center, 0}, question.reach, session_of_whole);
    EXPECT_LE(session.work.total() - before,
              session_of_whole.work.total() - before_of_whole + most_in_samples);
  }
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

TEST_F(LazyDistances, TakeAnEighthOfAByteMoreForEachSample) {
  const SphereCluster detector = SphereCluster::build(mesh_, lazy);
  const std::size_t bytes = detector.bytes();
  wrong_answers(detector, order_);
  EXPECT_EQ(detector.bytes(), bytes);
  EXPECT_GT(bytes, whole_.bytes());
  EXPECT_LT(bytes, whole_.bytes() + mesh_.size());
}

TEST(LazyScan, IsRefused) {
  SphereCluster::Options scan = lazy, fast = lazy;
  scan.lookup = SphereCluster::Lookup::scan;
  fast.precise = false;
  for (const auto& options : {scan, fast})
    EXPECT_THROW(SphereCluster::build(test::bumpy_sphere(3, 0.05, 1), options), std::invalid_argument);
}

}  // namespace
}  // namespace touchmark

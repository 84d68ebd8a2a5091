// Groups and cells that the first queries make: the bits of what was built whole, whoever came first.
#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/grid_group/grid_group.h"
#include "tests/core/lazy_making.h"

namespace touchmark {
namespace {

const GridGroup::Options lazy_groups{.construction = GridGroup::Construction::lazy};

class LazyGroups : public test::LazyMaking<GridGroup> {};

TEST_F(LazyGroups, AnswerWithTheSameBitsInAnyOrder) {
  for (const auto& order : orders()) {
    const GridGroup detector = GridGroup::build(mesh_, lazy_groups);
    EXPECT_EQ(detector.groups(), 0U);
    for (int pass = 0; pass < 3; ++pass) EXPECT_EQ(wrong_answers(detector, order), 0);
    EXPECT_GT(detector.groups(), 100U);
  }
}

TEST_F(LazyGroups, AnswerManyThreadsAtOnce) { expect_right_answers_in_threads(lazy_groups); }

TEST_F(LazyGroups, AreMadeWithBoundedWorkInAQuery) {
  const GridGroup detector = GridGroup::build(mesh_, lazy_groups);
  GridGroup::Session session, session_of_whole;
  std::uint64_t most = 0;
  for (const test::Question& question : all_) {
    const std::uint64_t before = session.work.total(), before_of_whole = session_of_whole.work.total();
    const std::size_t groups = detector.groups();
    detector.nearest({question.center, 0}, question.reach, session);
    EXPECT_LE(detector.groups(), groups + 1);
    whole_.nearest({question.center, 0}, question.reach, session_of_whole);
    const std::uint64_t work = session.work.total() - before,
                        of_whole = session_of_whole.work.total() - before_of_whole;
    most = std::max(most, work - std::min(work, of_whole));
  }
  EXPECT_LE(most, GridGroup::max_lazy_work);
}

// But for cells of another size: what their parents know decides how fine they are.
TEST_F(LazyGroups, TakeTheWorkOfThoseBuiltWholeOnceMade) {
  const GridGroup detector = GridGroup::build(mesh_, lazy_groups);
  for (int pass = 0; pass < 4; ++pass) wrong_answers(detector, order_);
  GridGroup::Session session, session_of_whole;
  for (const test::Question& question : all_) {
    test::ask(detector, question, session);
    test::ask(whole_, question, session_of_whole);
  }
  // Lazy ones do without sampled distances, which spare the whole ones an eighth.
  EXPECT_LE(static_cast<double>(session.work.total()),
            1.15 * static_cast<double>(session_of_whole.work.total()));
}

TEST_F(LazyGroups, TakeNoMoreMemoryThanAtFirst) {
  const GridGroup detector = GridGroup::build(mesh_, lazy_groups);
  const std::size_t bytes = detector.bytes();
  wrong_answers(detector, order_);
  EXPECT_EQ(detector.bytes(), bytes);
  EXPECT_LE(bytes, 400 * mesh_.size());
  const GridGroup copy = detector;
  EXPECT_EQ(copy.groups(), detector.groups());
  EXPECT_LE(copy.bytes(), bytes);
}

TEST_F(LazyGroups, DoWithoutWhereTheMemoryIsTaken) {
  GridGroup::Options little = lazy_groups;
  little.bytes_per_triangle = 230;
  const GridGroup detector = GridGroup::build(mesh_, little);
  for (int pass = 0; pass < 2; ++pass) EXPECT_EQ(wrong_answers(detector, order_), 0);
  EXPECT_LE(detector.bytes(), 230 * mesh_.size());
}

}  // namespace
}  // namespace touchmark

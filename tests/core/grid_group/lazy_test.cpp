// Groups and cells that the first queries make: the bits of what was built whole, whoever came first.
#include <algorithm>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/answer.h"
#include "bench/random.h"
#include "core/grid_group/grid_group.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using bench::Answer;
using bench::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
const GridGroup::Options lazy{.making = GridGroup::Making::lazy};

TriangleMesh scene() { return test::bumpy_sphere(30, 0.05, 1); }

struct Question {
  Vec3 center;
  double reach;
};

/// Walks along the surface, and leaps to anywhere.
std::vector<Question> questions() {
  Random random(17);
  std::vector<Question> all;
  for (int walk = 0; walk < 40; ++walk) {
    Vec3 center = (1 + 0.1 * random.unit()) * random.direction();
    for (int step = 0; step < 20; ++step) {
      center += 0.01 * random.direction();
      all.push_back({center, step % 5 == 0 ? infinity : 0.05});
    }
    all.push_back({2 * random.unit() * random.direction(), infinity});
  }
  return all;
}

/// All that there is to ask, at a place.
std::vector<Answer> ask(const GridGroup& detector, const Question& question, GridGroup::Session& session) {
  const Probe probe{question.center, 0.02};
  const auto contact = detector.nearest(probe, question.reach, session);
  Answer touch;
  touch.found = detector.touches(probe, session) ? 1 : 0;
  const auto impact = detector.first_hit({question.center, 0.5 * question.center, probe.radius}, session);
  return {contact ? Answer::of(*contact) : Answer{}, touch,
          impact ? Answer::of(impact->contact, impact->fraction) : Answer{}};
}

bool same_bits(const std::vector<Answer>& a, const std::vector<Answer>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Answer)) == 0;
}

/// Asks one after the other; how many answers differ from the expected ones.
int wrong_answers(const GridGroup& detector, const std::vector<Question>& all,
                  const std::vector<std::vector<Answer>>& expected, const std::vector<std::size_t>& order) {
  GridGroup::Session session;
  int wrong = 0;
  for (const std::size_t i : order) wrong += same_bits(ask(detector, all[i], session), expected[i]) ? 0 : 1;
  return wrong;
}

class LazyGroups : public testing::Test {
 protected:
  LazyGroups() {
    GridGroup::Session session;
    for (const Question& question : all_) {
      order_.push_back(order_.size());
      expected_.push_back(ask(whole_, question, session));
    }
  }
  std::vector<std::size_t> shuffled(unsigned seed) const {
    Random random(seed);
    std::vector<std::size_t> order = order_;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
  }

  const TriangleMesh mesh_ = scene();
  const GridGroup whole_ = GridGroup::build(mesh_);
  const std::vector<Question> all_ = questions();
  std::vector<std::size_t> order_;
  std::vector<std::vector<Answer>> expected_;
};

TEST_F(LazyGroups, AnswerWithTheSameBitsInAnyOrder) {
  for (const auto& order : {order_, std::vector<std::size_t>(order_.rbegin(), order_.rend()), shuffled(1)}) {
    const GridGroup detector = GridGroup::build(mesh_, lazy);
    EXPECT_EQ(detector.groups(), 0U);
    for (int pass = 0; pass < 3; ++pass) EXPECT_EQ(wrong_answers(detector, all_, expected_, order), 0);
    EXPECT_GT(detector.groups(), 100U);
  }
}

TEST_F(LazyGroups, AnswerManyThreadsAtOnce) {
  const GridGroup detector = GridGroup::build(mesh_, lazy);
  std::vector<int> wrong(4, -1);
  int wrong_of_copies = 0;
  {
    std::vector<std::jthread> threads;
    for (unsigned t = 0; t < wrong.size(); ++t)
      threads.emplace_back([&, t] { wrong[t] = wrong_answers(detector, all_, expected_, shuffled(t / 2)); });
    for (int copies = 0; copies < 3; ++copies)
      wrong_of_copies += wrong_answers(GridGroup(detector), all_, expected_, order_);
  }
  EXPECT_EQ(wrong, std::vector<int>(wrong.size(), 0));
  EXPECT_EQ(wrong_of_copies, 0);
}

TEST_F(LazyGroups, AreMadeWithBoundedWorkInAQuery) {
  const GridGroup detector = GridGroup::build(mesh_, lazy);
  GridGroup::Session session, session_of_whole;
  std::uint64_t most = 0;
  for (const Question& question : all_) {
    const std::uint64_t before = session.work.total(), before_of_whole = session_of_whole.work.total();
    const std::size_t groups = detector.groups();
    detector.nearest({question.center, 0}, question.reach, session);
    EXPECT_LE(detector.groups(), groups + 1);
    whole_.nearest({question.center, 0}, question.reach, session_of_whole);
    const std::uint64_t work = session.work.total() - before,
                        of_whole = session_of_whole.work.total() - before_of_whole;
    most = std::max(most, work - std::min(work, of_whole));
  }
  EXPECT_LE(most, grid::DirectGrid::most_growth_in_a_query);
}

// But for cells of another size: what their parents know decides how fine they are.
TEST_F(LazyGroups, TakeTheWorkOfThoseBuiltWholeOnceMade) {
  const GridGroup detector = GridGroup::build(mesh_, lazy);
  for (int pass = 0; pass < 4; ++pass) wrong_answers(detector, all_, expected_, order_);
  GridGroup::Session session, session_of_whole;
  for (const Question& question : all_) {
    ask(detector, question, session);
    ask(whole_, question, session_of_whole);
  }
  EXPECT_LE(static_cast<double>(session.work.total()),
            1.03 * static_cast<double>(session_of_whole.work.total()));
}

TEST_F(LazyGroups, TakeNoMoreMemoryThanAtFirst) {
  const GridGroup detector = GridGroup::build(mesh_, lazy);
  const std::size_t bytes = detector.bytes();
  wrong_answers(detector, all_, expected_, order_);
  EXPECT_EQ(detector.bytes(), bytes);
  EXPECT_LE(bytes, 400 * mesh_.size());
  const GridGroup copy = detector;
  EXPECT_EQ(copy.groups(), detector.groups());
  EXPECT_LE(copy.bytes(), bytes);
}

TEST_F(LazyGroups, DoWithoutWhereTheMemoryIsTaken) {
  GridGroup::Options little = lazy;
  little.bytes_per_triangle = 230;
  const GridGroup detector = GridGroup::build(mesh_, little);
  for (int pass = 0; pass < 2; ++pass) EXPECT_EQ(wrong_answers(detector, all_, expected_, order_), 0);
  EXPECT_LE(detector.bytes(), 230 * mesh_.size());
}

TEST(LazyScan, IsRefused) {
  GridGroup::Options options = lazy;
  options.lookup = GridGroup::Lookup::scan;
  EXPECT_THROW(GridGroup::build(scene(), options), std::invalid_argument);
}

}  // namespace
}  // namespace touchmark

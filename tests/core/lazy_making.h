// What a detector that makes parts of itself later is asked: the bits of one that was built whole, whoever
// came first.
#pragma once

#include <cstddef>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "bench/workload/answer.h"
#include "core/probe.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark::test {

struct Question {
  Vec3 center;
  double reach;
};

/// Walks along a unit sphere, and leaps to anywhere.
inline std::vector<Question> questions() {
  bench::support::Random random(17);
  std::vector<Question> all;
  for (int walk = 0; walk < 40; ++walk) {
    Vec3 center = random.direction();
    center *= 1 + 0.1 * random.unit();
    for (int step = 0; step < 20; ++step) {
      center += 0.01 * random.direction();
      all.push_back({center, step % 5 == 0 ? std::numeric_limits<double>::infinity() : 0.05});
    }
    for (const double reach : {std::numeric_limits<double>::infinity(), 0.05}) {
      const Vec3 direction = random.direction();
      all.push_back({2 * random.unit() * direction, reach});
    }
  }
  return all;
}

/// All that there is to ask, at a place.
template <class D>
std::vector<bench::workload::Answer> ask(const D& detector, const Question& question,
                                         typename D::Session& session) {
  using bench::workload::Answer;
  const Probe probe{question.center, 0.02};
  const auto contact = detector.nearest(probe, question.reach, session);
  Answer touch;
  touch.found = detector.touches(probe, session) ? 1 : 0;
  const auto impact = detector.first_hit({question.center, 0.5 * question.center, probe.radius}, session);
  return {contact ? Answer::of(*contact) : Answer{}, touch,
          impact ? Answer::of(impact->contact, impact->fraction) : Answer{}};
}

template <class D>
class LazyMaking : public testing::Test {
 protected:
  LazyMaking() {
    typename D::Session session;
    for (const Question& question : all_) {
      order_.push_back(order_.size());
      expected_.push_back(ask(whole_, question, session));
    }
  }
  std::vector<std::size_t> shuffled(unsigned seed) const {
    bench::support::Random random(seed);
    std::vector<std::size_t> order = order_;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
  }
  std::vector<std::vector<std::size_t>> orders() const {
    return {order_, {order_.rbegin(), order_.rend()}, shuffled(1)};
  }
  /// Asks one after the other; how many answers differ from those of the whole one.
  int wrong_answers(const D& detector, const std::vector<std::size_t>& order) const {
    typename D::Session session;
    int wrong = 0;
    for (const std::size_t i : order) {
      const std::vector<bench::workload::Answer> answers = ask(detector, all_[i], session);
      const std::size_t bytes = answers.size() * sizeof(bench::workload::Answer);
      wrong += std::memcmp(answers.data(), expected_[i].data(), bytes) == 0 ? 0 : 1;
    }
    return wrong;
  }
  /// Also of copies that are taken meanwhile.
  void expect_right_answers_in_threads(const typename D::Options& lazy) const {
    const D detector = D::build(mesh_, lazy);
    std::vector<int> wrong(4, -1);
    int wrong_of_copies = 0;
    {
      std::vector<std::jthread> threads;
      for (unsigned t = 0; t < wrong.size(); ++t)
        threads.emplace_back([&, t] { wrong[t] = wrong_answers(detector, shuffled(t / 2)); });
      for (int copies = 0; copies < 3; ++copies) wrong_of_copies += wrong_answers(D(detector), order_);
    }
    EXPECT_EQ(wrong, std::vector<int>(wrong.size(), 0));
    EXPECT_EQ(wrong_of_copies, 0);
  }

  const TriangleMesh mesh_ = bumpy_sphere(30, 0.05, 1);
  const D whole_ = D::build(mesh_);
  const std::vector<Question> all_ = questions();
  std::vector<std::size_t> order_;
  std::vector<std::vector<bench::workload::Answer>> expected_;
};

}  // namespace touchmark::test

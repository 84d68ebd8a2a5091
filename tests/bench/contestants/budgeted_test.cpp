/// What a budget leaves open must not depend on the pass.
#include "bench/contestants/budgeted.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/contestant_of.h"
#include "bench/meshes/meshes.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::contestants {
namespace {

TEST(Budgeted, AnswersEachPassAsTheFirst) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:4", false);
  std::vector<workload::Step> steps;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.05 * i;
    steps.push_back({{{0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.3}, 1}, 1});
  }
  const workload::QueryTrace trace{workload::Query::nearest, steps};
  int open = 0;
  for (const std::uint64_t budget : {16, 32, 64, 100, 150, 200}) {
    ContestantOf<Budgeted<SphereCluster>> contestant(Budgeted<SphereCluster>::build(mesh, {{}, budget}));
    std::vector<workload::Answer> answers(steps.size());
    std::vector<std::uint64_t> work(steps.size()), ticks(steps.size());
    contestant.answer(trace, {0, steps.size()}, answers, work);
    workload::Checksum first, again, clocked;
    for (const workload::Answer& answer : answers) {
      first.add(answer);
      open += answer.unfinished;
    }
    contestant.replay(trace, {0, steps.size()}, again);
    contestant.replay_clocked(trace, {0, steps.size()}, clocked, ticks, {});
    EXPECT_EQ(again.value(), first.value()) << budget;
    EXPECT_EQ(clocked.value(), first.value()) << budget;
  }
  EXPECT_GT(open, 0);
}

}  // namespace
}  // namespace touchmark::bench::contestants

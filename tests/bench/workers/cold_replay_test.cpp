/// Which steps are asked with emptied caches, and how much is walked over to empty them.
#include "bench/workers/timing/cold_replay.h"

#include <cstddef>
#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark::bench::workers {
namespace {

constexpr std::size_t mb = 1U << 20U;

/// The steps in the order in which they are asked.
std::vector<std::size_t> asked(ColdReplay& replay) {
  std::vector<std::size_t> steps;
  while (const auto step = replay.next()) {
    steps.push_back(*step);
    replay.took(100 + steps.size(), {}, {});
  }
  return steps;
}

TEST(Eviction, WalksOverTwiceTheCacheOrWhatIsThere) {
  EXPECT_EQ(eviction_sizes(2 * mb, 32 * mb, 1000 * mb).second_level, 4 * mb);
  EXPECT_EQ(eviction_sizes(2 * mb, 32 * mb, 1000 * mb).all, 64 * mb);
  EXPECT_EQ(eviction_sizes(2 * mb, 32 * mb, 10 * mb).all, 10 * mb) << "no more than that";
  EXPECT_EQ(eviction_sizes(2 * mb, 0, 1000 * mb).all, 64 * mb) << "the system does not say";
  EXPECT_EQ(eviction_sizes(2 * mb, mb, 1000 * mb).all, 4 * mb) << "a last level smaller than the second";
}

TEST(Eviction, TouchesEveryLine) {
  const std::vector<std::byte> memory(mb, std::byte{1});
  EvictionBuffer buffer(memory);
  EXPECT_EQ(buffer.walk(), mb / 64) << "each line holds a 1 where it is read";
}

std::vector<std::size_t> count_up(std::size_t begin, std::size_t end) {
  std::vector<std::size_t> steps(end - begin);
  std::iota(steps.begin(), steps.end(), begin);
  return steps;
}

TEST(ColdReplay, AnswersTheStepsBeforeItsRunFirst) {
  const std::vector<workload::StepRange> ranges{{0, 1000}};
  std::vector<TickRecord> records(5);
  ColdReplay replay(ranges, 0, nullptr, records);
  // 1000 times the fraction of half the golden ratio: the run begins at 809.
  EXPECT_EQ(asked(replay), count_up(809 - ColdReplay::lead_up, 814));
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].step, 809 + i);
    EXPECT_EQ(records[i].query_ticks, 100 + ColdReplay::lead_up + i + 1) << "what is before is not clocked";
  }
}

TEST(ColdReplay, SpreadsItsRunsOverTheRangesAndOverRequests) {
  const std::vector<workload::StepRange> ranges{{100, 600}, {3000, 3500}};
  std::set<std::size_t> sampled;
  for (std::size_t first = 0; first < 20; first += 5) {
    std::vector<TickRecord> records(5);
    ColdReplay replay(ranges, first, nullptr, records);
    asked(replay);
    for (const TickRecord& record : records) {
      const std::size_t step = record.step;
      EXPECT_TRUE((step >= 100 && step < 600) || (step >= 3000 && step < 3500)) << step;
      EXPECT_TRUE(sampled.insert(step).second) << step << " is asked twice";
    }
  }
  EXPECT_EQ(std::distance(sampled.begin(), sampled.lower_bound(3000)), 10);
}

TEST(ColdReplay, ARunStaysInItsRange) {
  const std::vector<workload::StepRange> ranges{{40, 46}};
  for (std::size_t first = 0; first < 20; first += 5) {
    std::vector<TickRecord> records(5);
    ColdReplay replay(ranges, first, nullptr, records);
    asked(replay);
    EXPECT_GE(records.front().step, 40U);
    EXPECT_EQ(records.back().step, records.front().step + 4);
    EXPECT_LT(records.back().step, 46U);
  }
}

TEST(ColdReplay, ARangeOfOneStepIsAskedAgainAndHasNoneBefore) {
  const std::vector<workload::StepRange> ranges{{0, 1}};
  std::vector<TickRecord> records(2);
  ColdReplay replay(ranges, 0, nullptr, records);
  EXPECT_EQ(asked(replay), (std::vector<std::size_t>{0, 0}));
}

}  // namespace
}  // namespace touchmark::bench::workers

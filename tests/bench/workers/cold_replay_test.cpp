/// Which steps are asked with emptied caches, and how much is walked over to empty them.
#include "bench/workers/cold_replay.h"

#include <cstddef>
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

request::Cold request_for(std::size_t samples, std::size_t first, std::size_t in_all) {
  request::Cold request;
  request.samples = samples;
  request.first_sample = first;
  request.samples_in_all = in_all;
  return request;
}

TEST(Eviction, WalksOverTwiceTheCacheOrWhatIsThere) {
  EXPECT_EQ(eviction_sizes(2 * mb, 32 * mb, 1000 * mb).second_level, 4 * mb);
  EXPECT_EQ(eviction_sizes(2 * mb, 32 * mb, 1000 * mb).all, 64 * mb);
  EXPECT_EQ(eviction_sizes(2 * mb, 32 * mb, 10 * mb).all, 10 * mb) << "no more than that";
  EXPECT_EQ(eviction_sizes(2 * mb, 0, 1000 * mb).all, 64 * mb) << "the system does not say";
  EXPECT_EQ(eviction_sizes(2 * mb, mb, 1000 * mb).all, 4 * mb) << "a last level smaller than the second";
}

TEST(Eviction, TouchesEveryLine) {
  EvictionBuffer buffer(mb);
  EXPECT_EQ(buffer.bytes(), mb);
  EXPECT_EQ(buffer.walk(), mb / 64) << "each line holds a 1 where it is read";
}

TEST(ColdReplay, AnswersTheStepBeforeEachSampleFirst) {
  const std::vector<workload::StepRange> ranges{{0, 10}};
  std::vector<TickRecord> records(5);
  ColdReplay replay(ranges, request_for(5, 0, 5), nullptr, records);
  EXPECT_EQ(asked(replay), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].step, 2 * i + 1);
    EXPECT_EQ(records[i].query_ticks, 100 + 2 * (i + 1)) << "the step before is not clocked";
  }
}

TEST(ColdReplay, SpreadsItsSamplesOverTheRangesAndOverRequests) {
  const std::vector<workload::StepRange> ranges{{100, 150}, {300, 350}};
  std::set<std::size_t> sampled;
  for (std::size_t first = 0; first < 20; first += 5) {
    std::vector<TickRecord> records(5);
    ColdReplay replay(ranges, request_for(5, first, 20), nullptr, records);
    asked(replay);
    for (const TickRecord& record : records) {
      const std::size_t step = record.step;
      EXPECT_TRUE((step >= 100 && step < 150) || (step >= 300 && step < 350)) << step;
      EXPECT_TRUE(sampled.insert(step).second) << step << " is asked twice";
    }
  }
  EXPECT_EQ(std::distance(sampled.begin(), sampled.lower_bound(300)), 10);
}

TEST(ColdReplay, TheFirstStepHasNoneBefore) {
  const std::vector<workload::StepRange> ranges{{0, 1}};
  std::vector<TickRecord> records(2);
  ColdReplay replay(ranges, request_for(2, 0, 2), nullptr, records);
  EXPECT_EQ(asked(replay), (std::vector<std::size_t>{0, 0}));
}

}  // namespace
}  // namespace touchmark::bench::workers

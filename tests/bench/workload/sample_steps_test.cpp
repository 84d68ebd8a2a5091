#include "bench/workload/sample_steps.h"

#include <gtest/gtest.h>

namespace touchmark::bench::workload {
namespace {

TEST(Windows, AreTheWholeWayWhereThereIsTimeForIt) {
  for (const std::size_t wanted : {100U, 101U, 1000000U}) {
    const std::vector<StepRange> ranges = sample_steps(100, wanted);
    ASSERT_EQ(ranges.size(), 1U);
    EXPECT_EQ(ranges[0].begin, 0U);
    EXPECT_EQ(ranges[0].end, 100U);
  }
}

TEST(Windows, AreSplitIntoEqualPartsAndJoinedAgain) {
  for (const std::size_t parts : {1U, 2U, 3U, 7U, 100U, 1000U}) {
    const std::vector<StepRange> some = split({5, 105}, parts);
    ASSERT_EQ(some.size(), std::min<std::size_t>(parts, 100));
    for (const StepRange& range : some) EXPECT_LE(range.size(), 100 / some.size() + 1);
    const std::vector<StepRange> whole = joined(some);
    ASSERT_EQ(whole.size(), 1U);
    EXPECT_EQ(whole[0].begin, 5U);
    EXPECT_EQ(whole[0].end, 105U);
  }
  EXPECT_EQ(joined({{0, 2}, {3, 4}, {4, 6}}).size(), 2U);
}

TEST(Windows, AreDisjointAscendingAndInsideWhateverTheCounts) {
  for (std::size_t total = 1; total < 200; ++total) {
    for (std::size_t wanted = 0; wanted < total; ++wanted) {
      std::size_t end = 0;
      const std::vector<StepRange> ranges = sample_steps(total, wanted);
      for (const StepRange& range : ranges) {
        ASSERT_GE(range.begin, end);
        ASSERT_GT(range.end, range.begin);
        ASSERT_LE(range.end, total);
        end = range.end;
      }
      ASSERT_GE(steps_in(ranges), 1U);
      ASSERT_LE(steps_in(ranges), std::max<std::size_t>(wanted, 1));
    }
  }
}

TEST(Windows, AreSpreadOverTheWholeWayAndAlmostAsManyStepsAsWanted) {
  const std::vector<StepRange> ranges = sample_steps(20000, 1000);
  EXPECT_GE(steps_in(ranges), 900U);
  EXPECT_EQ(ranges.front().begin, 0U);
  EXPECT_GT(ranges.back().end, 18000U);
  EXPECT_GE(ranges.front().size(), 16U);  // neighbours, so that a session can profit
}

TEST(Windows, KnowThePlaceOfEachOfTheirSteps) {
  const std::vector<StepRange> ranges{{3, 5}, {9, 12}};
  std::vector<std::size_t> places;
  for (const std::size_t step : {3u, 4u, 9u, 10u, 11u}) places.push_back(place_in(ranges, step));
  EXPECT_EQ(places, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace touchmark::bench::workload

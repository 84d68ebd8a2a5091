#include "bench/workload/sample_plan.h"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "bench/workload/sample_steps.h"

namespace touchmark::bench::workload {
namespace {

/// A motion that repeats itself every 8 blocks: 1 in contact, 2 near, 5 free. Equally spaced ranges alias on
/// it.
std::vector<Phase> repeating(std::size_t blocks) {
  std::vector<Phase> phases;
  for (std::size_t i = 0; i < blocks; ++i)
    phases.push_back(i % 8 == 0 ? Phase::contact : i % 8 < 3 ? Phase::near : Phase::free);
  return phases;
}

constexpr std::size_t total = 20000;
SamplePlan plan() { return {total, repeating(SamplePlan::blocks_in(total)), 1}; }

std::array<double, phase_count> shares(const SamplePlan& plan, const std::vector<StepRange>& ranges) {
  std::array<double, phase_count> shares{};
  for (const StepRange& range : ranges)
    shares[static_cast<std::size_t>(plan.phase_of(range))] += static_cast<double>(range.size());
  for (double& share : shares) share /= static_cast<double>(steps_in(ranges));
  return shares;
}

TEST(SamplePlan, IsTheWholeWayWhereThereIsTimeForIt) {
  for (const std::size_t wanted : {total, total + 1, 10 * total}) {
    const std::vector<StepRange> ranges = plan().ranges(wanted);
    ASSERT_EQ(ranges.size(), 1U);
    EXPECT_EQ(ranges[0].begin, 0U);
    EXPECT_EQ(ranges[0].end, total);
  }
}

TEST(SamplePlan, HasDisjointAscendingWindowsInsideOneBlockEachWhateverTheCounts) {
  for (std::size_t steps = 1; steps < 400; steps += 7) {
    const SamplePlan some(steps, repeating(SamplePlan::blocks_in(steps)), 3);
    for (std::size_t wanted = 1; wanted < steps; ++wanted) {
      std::size_t end = 0;
      const std::vector<StepRange> ranges = some.ranges(wanted);
      for (const StepRange& range : ranges) {
        ASSERT_GE(range.begin, end);
        ASSERT_GT(range.end, range.begin);
        ASSERT_LE(range.end, steps);
        ASSERT_EQ(range.begin / SamplePlan::block_steps, (range.end - 1) / SamplePlan::block_steps);
        end = range.end;
      }
      ASSERT_LE(steps_in(ranges), std::max<std::size_t>(wanted, 6)) << "two blocks of three phases at least";
    }
  }
}

TEST(SamplePlan, HasEachPhaseInItsShareAlsoWhereTheMotionRepeatsItself) {
  for (const std::size_t wanted : {1024U, 2048U, 4096U, 8192U}) {
    const std::array<double, phase_count> found = shares(plan(), plan().ranges(wanted));
    EXPECT_GE(steps_in(plan().ranges(wanted)), wanted * 9 / 10);
    EXPECT_NEAR(found[0], 1.0 / 8, 2.5 * SamplePlan::block_steps / wanted);
    EXPECT_NEAR(found[1], 2.0 / 8, 2.5 * SamplePlan::block_steps / wanted);
  }
}

TEST(SamplePlan, HasTwoBlocksOfEachPhaseHoweverFewStepsAreWanted) {
  for (const std::size_t wanted : {1U, 2U, 8U, 16U, 100U}) {
    std::array<int, phase_count> blocks{};
    for (const StepRange& range : plan().ranges(wanted))
      ++blocks[static_cast<std::size_t>(plan().phase_of(range))];
    for (const int count : blocks) EXPECT_GE(count, 2) << wanted;
  }
}

TEST(SamplePlan, NestsSoThatASlowerContestantsStepsAreAmongAFasterOnes) {
  for (std::size_t wanted = 8; wanted < 16384; wanted *= 2) {
    std::set<std::size_t> larger;
    for (const StepRange& range : plan().ranges(2 * wanted))
      for (std::size_t i = range.begin; i < range.end; ++i) larger.insert(i);
    for (const StepRange& range : plan().ranges(wanted))
      for (std::size_t i = range.begin; i < range.end; ++i) ASSERT_TRUE(larger.contains(i)) << wanted;
  }
}

TEST(SamplePlan, TellsPhasesByTheNearestOfTheTellingSteps) {
  const std::vector<Step> steps(70, Step{Probe{Vec3::Zero(), 1}, 1});
  ASSERT_EQ(telling_steps(70), (std::vector<std::size_t>{0, 15, 31, 32, 47, 63, 64, 66, 69}));
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> distances{9, 1, 9, 9, 2.9, infinity, 3.1, infinity, infinity};
  EXPECT_EQ(phases_of(steps, distances, 100), (std::vector<Phase>{Phase::contact, Phase::near, Phase::free}));
}

}  // namespace
}  // namespace touchmark::bench::workload

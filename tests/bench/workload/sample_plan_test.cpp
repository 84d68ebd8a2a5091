#include "bench/workload/sample_plan.h"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "bench/workload/sample_steps.h"

namespace touchmark::bench {
namespace {

/// A motion that repeats itself every 8 blocks: 1 in contact, 2 near, 5 free. Equally spaced windows alias on
/// it.
std::vector<Phase> repeating(std::size_t blocks) {
  std::vector<Phase> phases;
  for (std::size_t i = 0; i < blocks; ++i)
    phases.push_back(i % 8 == 0 ? Phase::contact : i % 8 < 3 ? Phase::near : Phase::free);
  return phases;
}

constexpr std::size_t total = 20000;
SamplePlan plan() { return {total, repeating(SamplePlan::blocks_in(total)), 1}; }

std::array<double, phase_count> shares(const SamplePlan& plan, const std::vector<Window>& windows) {
  std::array<double, phase_count> shares{};
  for (const Window& window : windows)
    shares[static_cast<std::size_t>(plan.phase_of(window))] += static_cast<double>(window.size());
  for (double& share : shares) share /= static_cast<double>(steps_in(windows));
  return shares;
}

TEST(SamplePlan, IsTheWholeWayWhereThereIsTimeForIt) {
  for (const std::size_t wanted : {total, total + 1, 10 * total}) {
    const std::vector<Window> windows = plan().windows(wanted);
    ASSERT_EQ(windows.size(), 1U);
    EXPECT_EQ(windows[0].begin, 0U);
    EXPECT_EQ(windows[0].end, total);
  }
}

TEST(SamplePlan, HasDisjointAscendingWindowsInsideOneBlockEachWhateverTheCounts) {
  for (std::size_t steps = 1; steps < 400; steps += 7) {
    const SamplePlan some(steps, repeating(SamplePlan::blocks_in(steps)), 3);
    for (std::size_t wanted = 1; wanted < steps; ++wanted) {
      std::size_t end = 0;
      const std::vector<Window> windows = some.windows(wanted);
      for (const Window& window : windows) {
        ASSERT_GE(window.begin, end);
        ASSERT_GT(window.end, window.begin);
        ASSERT_LE(window.end, steps);
        ASSERT_EQ(window.begin / SamplePlan::block_steps, (window.end - 1) / SamplePlan::block_steps);
        end = window.end;
      }
      ASSERT_LE(steps_in(windows), std::max<std::size_t>(wanted, 6)) << "two blocks of three phases at least";
    }
  }
}

TEST(SamplePlan, HasEachPhaseInItsShareAlsoWhereTheMotionRepeatsItself) {
  for (const std::size_t wanted : {1024U, 2048U, 4096U, 8192U}) {
    const std::array<double, phase_count> found = shares(plan(), plan().windows(wanted));
    EXPECT_GE(steps_in(plan().windows(wanted)), wanted * 9 / 10);
    EXPECT_NEAR(found[0], 1.0 / 8, 2.5 * SamplePlan::block_steps / wanted);
    EXPECT_NEAR(found[1], 2.0 / 8, 2.5 * SamplePlan::block_steps / wanted);
  }
}

TEST(SamplePlan, HasTwoBlocksOfEachPhaseHoweverFewStepsAreWanted) {
  for (const std::size_t wanted : {1U, 2U, 8U, 16U, 100U}) {
    std::array<int, phase_count> blocks{};
    for (const Window& window : plan().windows(wanted))
      ++blocks[static_cast<std::size_t>(plan().phase_of(window))];
    for (const int count : blocks) EXPECT_GE(count, 2) << wanted;
  }
}

TEST(SamplePlan, NestsSoThatASlowerContestantsStepsAreAmongAFasterOnes) {
  for (std::size_t wanted = 8; wanted < 16384; wanted *= 2) {
    std::set<std::size_t> larger;
    for (const Window& window : plan().windows(2 * wanted))
      for (std::size_t i = window.begin; i < window.end; ++i) larger.insert(i);
    for (const Window& window : plan().windows(wanted))
      for (std::size_t i = window.begin; i < window.end; ++i) ASSERT_TRUE(larger.contains(i)) << wanted;
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
}  // namespace touchmark::bench

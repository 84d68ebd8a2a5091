#include "bench/measurement/latency.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark::bench::measurement {
namespace {

TEST(Latency, PercentilesAreTheLeastValuesThatSoManyAreNotAbove) {
  std::vector<double> ns(1000);
  std::iota(ns.rbegin(), ns.rend(), 1.0);  // 1000, 999, ..., 1
  const LatencySummary summary = summarize_latency(ns, {{0, 1000}});
  EXPECT_EQ(summary.p50, 500);
  EXPECT_EQ(summary.p90, 900);
  EXPECT_EQ(summary.p99, 990);
  EXPECT_EQ(summary.p999, 999);
  EXPECT_EQ(summary.max, 1000);
}

TEST(Latency, OfOneStepIsThatStep) {
  const std::vector<double> ns{7};
  const LatencySummary summary = summarize_latency(ns, {{0, 1}});
  EXPECT_EQ(summary.p50, 7);
  EXPECT_EQ(summary.p999, 7);
}

TEST(Latency, AStepThatTakesThePeriodItselfIsInTime) {
  const std::vector<double> ns{1e6, 1e6 + 1, 250e3, 250e3 + 1, 100e3, 100e3 + 1};
  const LatencySummary summary = summarize_latency(ns, {{0, 6}});
  EXPECT_EQ(summary.deadlines[0].misses, 1U);
  EXPECT_EQ(summary.deadlines[1].misses, 3U);
  EXPECT_EQ(summary.deadlines[2].misses, 5U);
}

TEST(Latency, ARunOfMissesEndsWhereTheWindowDoes) {
  const std::vector<double> ns{2e6, 1, 2e6, 2e6, 2e6, 2e6, 2e6, 1};
  EXPECT_EQ(summarize_latency(ns, {{0, 8}}).deadlines[0].max_run, 5U);
  EXPECT_EQ(summarize_latency(ns, {{0, 5}, {90, 93}}).deadlines[0].max_run, 3U);
  EXPECT_EQ(summarize_latency(ns, {{0, 5}, {90, 93}}).deadlines[0].misses, 6U);
}

TEST(Latency, AnInterruptionInOnePassOfThreeDoesNotCount) {
  EXPECT_EQ(median_per_step({{5, 6}, {4e6, 7}, {4, 9e6}}), (std::vector<double>{5, 7}));
  EXPECT_EQ(median_per_step({{5, 6}}), (std::vector<double>{5, 6}));
}

}  // namespace
}  // namespace touchmark::bench::measurement

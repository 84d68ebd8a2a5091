/// The paced loop, its histogram and its verdict, by clocks that tests set.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/servo/load.h"
#include "bench/experiments/servo/real_time_host.h"
#include "bench/experiments/servo/servo_row.h"
#include "bench/experiments/servo/servo_run.h"
#include "bench/experiments/servo/tick_tally.h"
#include "bench/experiments/servo/verdict.h"
#include "bench/measurement/histogram.h"
#include "bench/meshes/meshes.h"
#include "bench/workers/timing/real_time.h"
#include "bench/workload/paced_workload.h"
#include "tests/bench/experiments/servo/simulated_clock.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::experiments::servo {
namespace {

constexpr std::int64_t ms = 1'000'000;

std::vector<std::int64_t> latencies(const std::vector<workers::TickRecord>& records) {
  std::vector<std::int64_t> all;
  for (const workers::TickRecord& record : records) all.push_back(record.latency_ns);
  return all;
}

std::vector<int> steps(const std::vector<workers::TickRecord>& records) {
  std::vector<int> all;
  for (const workers::TickRecord& record : records)
    all.push_back(record.asked != 0 ? static_cast<int>(record.step) : -1);
  return all;
}

TEST(PacedReplay, GoesAlongTheTrajectoryToAndFro) {
  std::vector<std::size_t> seen;
  for (std::uint64_t tick = 0; tick < 9; ++tick) seen.push_back(workers::step_of_tick(tick, 4));
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3, 2, 1, 0, 1, 2}));
  EXPECT_EQ(workers::step_of_tick(7, 1), 0u);
}

TEST(PacedReplay, AsksOnceATickAtItsTime) {
  SimulatedClock clock;
  EXPECT_EQ(latencies(paced({}, 100, 4, clock)), (std::vector<std::int64_t>(4, 1'000)));
  EXPECT_EQ(clock.now_ns(), 5'000 + 4 * ms + 1'000) << "the first tick is a period after the start";
  EXPECT_EQ(clock.sleeps, 4);
}

TEST(PacedReplay, CountsFromTheScheduledStartWhenItWakesUpLate) {
  SimulatedClock clock;
  clock.late_by[1] = 300'000;
  EXPECT_EQ(latencies(paced({}, 100, 3, clock)), (std::vector<std::int64_t>{1'000, 301'000, 1'000}));
}

// A ball at equal distance from two triangles: some rivals name the one that they were asked about before.
TEST(PacedReplay, ComparesATieOfWhoNamesAnyTriangleByItsContactAlone) {
  workload::Answer one{1}, other{1};
  one.triangle = 3;
  other.triangle = 4;
  const workload::Answer none{};
  EXPECT_NE(workers::tick_checksum(one, certified), workers::tick_checksum(other, certified));
  EXPECT_EQ(workers::tick_checksum(one, uncertified), workers::tick_checksum(other, uncertified));
  EXPECT_NE(workers::tick_checksum(one, uncertified), workers::tick_checksum(none, uncertified));
}

TEST(PacedReplay, AStallHidesNoneOfTheTicksThatItTook) {
  SimulatedClock clock;
  // The second query takes 3.2 periods: it is late, two ticks are lost, and one begins late within its
  // period.
  const auto records = paced({}, 100, 6, clock, {{1, 3'200'000}});
  EXPECT_EQ(steps(records), (std::vector<int>{0, 1, -1, -1, 4, 5})) << "the hand has moved on meanwhile";
  EXPECT_EQ(latencies(records),
            (std::vector<std::int64_t>{1'000, 3'200'000, 2'201'000, 1'201'000, 201'000, 1'000}));
}

TEST(PacedReplay, LosesWhatIsLeftWhenTheStallOutlastsTheRun) {
  SimulatedClock clock;
  const auto records = paced({}, 100, 4, clock, {{1, 20 * ms}});
  EXPECT_EQ(steps(records), (std::vector<int>{0, 1, -1, -1}));
}

TEST(PacedReplay, IsEndedWhenItFindsNoTimeToSleep) {
  workers::Pace pace;
  pace.overrun_ticks = 10;
  SimulatedClock slow, fast;
  bool ended = false;
  const auto records = paced(pace, 100, 1000, slow, {}, 1'100'000, &ended);
  EXPECT_TRUE(ended);
  EXPECT_GT(records.size(), 10u);
  EXPECT_LT(records.size(), 15u);
  // A single stall of any length is none.
  EXPECT_EQ(paced(pace, 100, 1000, fast, {{3, 60 * ms}}, 800'000, &ended).size(), 1000u);
  EXPECT_FALSE(ended);
}

TEST(PacedReplay, KeepsTheRateWithoutDrift) {
  SimulatedClock clock;
  workers::Pace pace;
  pace.rate_hz = 3000;  // whose period is no whole number of nanoseconds
  paced(pace, 10, 3'000'000, clock, {}, 10);
  EXPECT_NEAR(static_cast<double>(clock.now_ns()), 5'000 + 1000e9 + 10, 1);
}

TEST(TickTally, CountsMissesLostTicksAndTheLongestRun) {
  SimulatedClock clock;
  TickTally tally(1000, 1);
  tally.add(paced({}, 100, 8, clock, {{1, 3'200'000}}));
  EXPECT_EQ(tally.ticks(), 8u);
  EXPECT_EQ(tally.missed(), 3u);
  EXPECT_EQ(tally.lost(), 2u);
  EXPECT_EQ(tally.max_run(), 3u);
  EXPECT_EQ(tally.latency().max_ns(), 3'200'000);
  EXPECT_EQ(tally.query().count(), 6u) << "a lost tick has no query";
  ASSERT_EQ(tally.worst().size(), 6u);
  EXPECT_EQ(tally.worst()[0].step, 1u);
  EXPECT_EQ(tally.worst()[1].step, 4u);
}

TEST(TickTally, ARunEndsWithItsStretch) {
  const workers::TickRecord late{1, 0, 2 * ms, 1, 0, {}};
  TickTally tally(1000, 1);
  for (int i = 0; i < 3; ++i) tally.add(std::vector<workers::TickRecord>(4, late));
  EXPECT_EQ(tally.missed(), 12u);
  EXPECT_EQ(tally.max_run(), 4u);
}

TEST(TickTally, ATickThatTakesJustThePeriodIsInTime) {
  TickTally tally(1000, 1);
  tally.add(std::vector<workers::TickRecord>{{1, 0, ms, 1, 0, {}}, {1, 0, ms + 1, 1, 0, {}}});
  EXPECT_EQ(tally.missed(), 1u);
}

TEST(TickTally, KeepsTheTenWorst) {
  std::vector<workers::TickRecord> records;
  for (std::uint32_t i = 0; i < 100; ++i) records.push_back({1, i, (i * 37) % 100, 1, 0, {}});
  TickTally tally(1000, 1);
  tally.add(records);
  ASSERT_EQ(tally.worst().size(), TickTally::worst_count);
  for (std::size_t i = 0; i < TickTally::worst_count; ++i)
    EXPECT_EQ(tally.worst()[i].latency_ns, 99 - static_cast<std::int64_t>(i));
}

TEST(TickTally, FindsWhatAUnitOfWorkCosts) {
  std::vector<workers::TickRecord> records;
  for (std::uint64_t work = 0; work < 200; ++work) {
    Work looked_at;
    looked_at.triangles = work;
    records.push_back({1, 0, 1, 300 + 20 * work, 0, looked_at});
  }
  TickTally tally(1000, 0.5);  // two ticks of the clock a nanosecond
  EXPECT_FALSE(tally.ns_for_work(1));
  tally.add(records);
  EXPECT_NEAR(tally.ns_for_work(1000).value(), 150 + 10 * 1000, 1e-6);
}

TEST(TickTally, SaysNothingWhereMoreWorkDoesNotTakeLonger) {
  std::vector<workers::TickRecord> records;
  for (std::uint64_t work = 0; work < 200; ++work) {
    Work looked_at;
    looked_at.triangles = work;
    records.push_back({1, 0, 1, 9000 - 20 * work, 0, looked_at});
  }
  TickTally tally(1000, 1);
  tally.add(records);
  EXPECT_FALSE(tally.ns_for_work(1000));
}

TEST(Histogram, KeepsTheMaximumAndPercentilesWithinAThirtySecond) {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> times(8, 2);
  std::vector<std::int64_t> all;
  measurement::LatencyHistogram histogram;
  for (int i = 0; i < 20'000; ++i) {
    all.push_back(static_cast<std::int64_t>(times(random)));
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(histogram.max_ns(), all.back());
  EXPECT_EQ(histogram.percentile(1), all.back());
  for (const double fraction : {0.001, 0.5, 0.9, 0.99, 0.999, 0.9999}) {
    const auto exact = static_cast<double>(
        all[static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(all.size()))) - 1]);
    const auto found = static_cast<double>(histogram.percentile(fraction));
    EXPECT_GE(found, exact);
    EXPECT_LE(found, exact * 33 / 32 + 1);
  }
}

TEST(Histogram, BucketsAscendAndHoldEveryTickOnce) {
  measurement::LatencyHistogram histogram;
  constexpr std::int64_t longest = std::numeric_limits<std::int64_t>::max();
  for (int power = 0; power < 63; ++power)
    for (const std::int64_t around : {-1, 0, 1}) histogram.add((std::int64_t{1} << power) + around);
  histogram.add(longest);
  histogram.add(-5);
  std::uint64_t ticks = 0;
  std::int64_t before = -1;
  for (const measurement::LatencyHistogram::Bucket& bucket : histogram.buckets()) {
    EXPECT_GT(bucket.up_to_ns, before);
    before = bucket.up_to_ns;
    ticks += bucket.ticks;
  }
  EXPECT_EQ(before, longest);
  EXPECT_EQ(ticks, 63u * 3 + 2);
  EXPECT_EQ(ticks, histogram.count());
}

/// P(X <= k) by adding up binomial coefficients, for small n.
double at_most(unsigned k, unsigned n, double share) {
  double sum = 0, choose = 1;
  for (unsigned i = 0; i <= k; choose = choose * (n - i) / (i + 1), ++i)
    sum += choose * std::pow(share, i) * std::pow(1 - share, n - i);
  return sum;
}

TEST(Verdict, TheBoundIsTheShareThatWouldShowSoFewMissesOnceInTwentyRuns) {
  for (const unsigned n : {1U, 2U, 10U, 50U})
    for (unsigned k = 0; k < n; ++k)
      EXPECT_NEAR(at_most(k, n, max_miss_rate(k, n)), 0.05, 1e-9) << k << " of " << n;
  EXPECT_EQ(max_miss_rate(7, 7), 1);
  EXPECT_EQ(max_miss_rate(0, 0), 1);
}

TEST(Verdict, WithoutAMissItIsTheRuleOfThree) {
  EXPECT_NEAR(max_miss_rate(0, 3'600'000), 8.3e-7, 0.05e-7);
  EXPECT_NEAR(max_miss_rate(0, 3'600'000) * 3'600'000, -std::log(0.05), 1e-4);
  // With many misses it comes to the share itself and 1.645 deviations.
  EXPECT_NEAR(max_miss_rate(10'000, 1'000'000), 0.01 + 1.645 * std::sqrt(0.01 * 0.99 / 1e6), 3e-6);
}

TEST(Verdict, ComparesTurnsByTheSignTest) {
  for (unsigned n = 1; n <= 20; ++n)
    for (unsigned worse = 0; worse <= n; ++worse) {
      const double expected = worse == 0 ? 1 : 1 - at_most(worse - 1, n, 0.5);
      EXPECT_NEAR(chance_of_as_many({0, 0, 0, 0, worse, n - worse}), expected, 1e-9) << worse << " of " << n;
    }
  EXPECT_EQ(chance_of_as_many({}), 1);
  EXPECT_LT(chance_of_as_many({0, 0, 0, 0, 20'000, 3}), 1e-300);
  EXPECT_NEAR(chance_of_as_many({0, 0, 0, 0, 3, 20'000}), 1, 1e-9);
}

TEST(Verdict, HoldsWithoutAMissWhereTheMachineDidNotMissEither) {
  EXPECT_EQ(verdict_on({3000, 0, 3000, 0}), Verdict::holds);
  EXPECT_EQ(verdict_on({3000, 1, 3000, 0}), Verdict::does_not_hold);
}

TEST(Verdict, IsInconclusiveWhereTheMachineItselfMissed) {
  EXPECT_EQ(verdict_on({3000, 0, 3000, 1}), Verdict::inconclusive);
  EXPECT_EQ(verdict_on({3000, 300, 3000, 1, 3, 1}), Verdict::inconclusive) << "three stalls, one";
  EXPECT_EQ(verdict_on({3000, 3000, 3000, 1, 30, 0}), Verdict::does_not_hold) << "that is not the machine's";
  EXPECT_EQ(verdict_on({0, 0, 0, 0}), Verdict::inconclusive);
  EXPECT_EQ(verdict_on({3000, 0, 0, 0}), Verdict::inconclusive) << "nothing is known of the machine";
}

TEST(Verdict, TheWorstIsThatOfAll) {
  EXPECT_EQ(verdict_on_all(std::vector{Verdict::holds, Verdict::holds}), Verdict::holds);
  EXPECT_EQ(verdict_on_all(std::vector{Verdict::holds, Verdict::inconclusive}), Verdict::inconclusive);
  EXPECT_EQ(verdict_on_all(std::vector{Verdict::does_not_hold, Verdict::inconclusive}),
            Verdict::does_not_hold);
  EXPECT_EQ(verdict_on_all(std::vector<Verdict>{}), Verdict::inconclusive);
}

TEST(Verdict, OneThatFailedOrIsWrongDoesNotHold) {
  SimulatedClock clock;
  ServoRow row;
  row.loop = row.idle = LoopResult{TickTally(1000, 1)};
  row.loop->tally.add(paced({}, 10, 10, clock));
  row.idle->tally.add(paced({}, 10, 10, clock));
  EXPECT_EQ(row.verdict(), Verdict::holds);
  row.accuracy = Accuracy{};
  row.counts = oracle::ErrorCounts{};
  row.counts->judged = 10;
  EXPECT_EQ(row.verdict(), Verdict::holds);
  row.counts->missed = 1;
  EXPECT_EQ(row.verdict(), Verdict::does_not_hold);
  row.counts->missed = 0;
  row.status = "timeout";
  EXPECT_EQ(row.verdict(), Verdict::does_not_hold);
}

TEST(Verdict, AnOverrunIsTheDetectorsUnlessTheIdleLoopOverranAsWell) {
  const std::vector<workers::TickRecord> late(50, {1, 0, 2 * ms, 1, 0, {}});
  ServoRow row;
  row.status = "overrun";
  EXPECT_EQ(row.verdict(), Verdict::does_not_hold) << "ended by the kernel";
  row.loop = row.idle = LoopResult{TickTally(1000, 1)};
  row.loop->tally.add(late);
  row.loop->overrun = true;
  EXPECT_EQ(row.verdict(), Verdict::does_not_hold);
  row.idle->tally.add(late);
  EXPECT_EQ(row.verdict(), Verdict::does_not_hold) << "late, but it slept";
  row.idle->overrun = true;
  EXPECT_EQ(row.verdict(), Verdict::inconclusive);
}

TEST(ServoTrace, GoesByTimeAtAnyRate) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:2");
  workload::Selection selection;
  selection.radius = {0.5, true};
  const auto at = [&](double rate, std::uint64_t ticks) {
    return workload::workload_by_time("icosphere:2", mesh, selection, "slide", {rate, ticks}).traces.front();
  };
  const auto usual = at(1000, 11), fast = at(4000, 41), slow = at(500, 6);
  ASSERT_EQ(fast.size(), 41u);
  ASSERT_EQ(slow.size(), 6u);
  for (std::size_t i = 0; i < usual.size(); ++i)
    EXPECT_EQ(fast[4 * i].probe.center, usual[i].probe.center) << i;
  for (std::size_t i = 0; i < slow.size(); ++i)
    EXPECT_EQ(slow[i].probe.center, usual[2 * i].probe.center) << i;
  EXPECT_LT((fast[2].probe.center - 0.5 * (usual[0].probe.center + usual[1].probe.center)).norm(), 1e-15);
  EXPECT_TRUE(workload::is_resampled_shape("slide", 4000));
  EXPECT_FALSE(workload::is_resampled_shape("slide", 1000));
  EXPECT_FALSE(workload::is_resampled_shape("hand.csv", 4000));
}

TEST(RealTime, MemoryIsNotLockedPastALimit) {
  constexpr std::uint64_t mb = 1U << 20U;
  EXPECT_EQ(workers::refusal_to_lock({100 * mb, 90 * mb, {}, {}}), "");
  EXPECT_EQ(workers::refusal_to_lock({100 * mb, 90 * mb, 100 * mb, 1000 * mb}), "");
  EXPECT_NE(workers::refusal_to_lock({100 * mb, 90 * mb, 8 * mb, 1000 * mb}).find("ulimit -l"),
            std::string::npos);
  EXPECT_NE(workers::refusal_to_lock({100 * mb, 20 * mb, {}, 100 * mb}).find("100 MB are available"),
            std::string::npos);
  EXPECT_EQ(workers::refusal_to_lock({100 * mb, 60 * mb, {}, 100 * mb}), "")
      << "40 MB more are less than half";
}

TEST(RealTime, WarnsOfWhatTheMachineIsSetTo) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& path, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(folder.file(path)).parent_path());
    folder.file(path, text + "\n");
  };
  EXPECT_EQ(warnings_about(read_real_time_host(3, folder.path())).size(), 2u) << "isolation and kernel alone";
  const std::string cpu = "sys/devices/system/cpu/cpu3/";
  write(cpu + "cpufreq/scaling_governor", "powersave");
  write(cpu + "cpuidle/state0/name", "POLL");
  write(cpu + "cpuidle/state0/latency", "0");
  write(cpu + "cpuidle/state1/name", "C6");
  write(cpu + "cpuidle/state1/latency", "133");
  write(cpu + "topology/thread_siblings_list", "3,7");
  write("sys/devices/system/cpu/isolated", "1,4-6");
  write("sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never");
  const RealTimeHost bad = read_real_time_host(3, folder.path());
  EXPECT_EQ(bad.deepest_idle_state, "C6");
  EXPECT_EQ(bad.smt, true);
  EXPECT_EQ(bad.core_is_isolated, false);
  EXPECT_EQ(warnings_about(bad).size(), 6u);
  write("proc/self/cgroup", "0::/");
  write("sys/fs/cgroup/cpu.max", "50000 100000");
  const std::vector<std::string> with_quota = warnings_about(read_real_time_host(3, folder.path()));
  EXPECT_EQ(with_quota.size(), 7u);
  EXPECT_EQ(std::ranges::count_if(with_quota,
                                  [](const std::string& line) {
                                    return line.find("CPU quota is in force: 50 of each 100 ms") != line.npos;
                                  }),
            1);
  write("sys/fs/cgroup/cpu.max", "max 100000");
  write(cpu + "cpufreq/scaling_governor", "performance");
  write(cpu + "cpuidle/state1/disable", "1");
  write(cpu + "topology/thread_siblings_list", "3");
  write("sys/devices/system/cpu/isolated", "1-3");
  write("sys/kernel/mm/transparent_hugepage/enabled", "always [madvise] never");
  write("sys/kernel/realtime", "1");
  EXPECT_EQ(warnings_about(read_real_time_host(3, folder.path())), std::vector<std::string>{});
}

TEST(Load, WorksUntilItIsEnded) {
  EXPECT_FALSE(load_named("disk"));
  for (const Load load : {Load::memory, Load::cpu}) {
    EXPECT_EQ(load_named(name_of(load)), load);
    const LoadGenerators generators(load, {0}, 1U << 20U);
    while (generators.rounds() < 2) std::this_thread::yield();
  }
  const LoadGenerators none(Load::none, {0}, 1U << 20U);
  EXPECT_EQ(none.rounds(), 0u);
  EXPECT_GE(bytes_to_walk_over(1), bytes_to_walk_over(4));
}

}  // namespace
}  // namespace touchmark::bench::experiments::servo

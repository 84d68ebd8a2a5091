#include "bench/measurement/piece_times.h"

#include <gtest/gtest.h>

#include "bench/support/random.h"

namespace touchmark::bench::measurement {
namespace {

/// Two pieces of 10 steps that take 100 and 300 ns, in rounds of two samples each, of which a share is
/// interrupted.
UndisturbedTime with_interruptions(double share, std::uint64_t seed) {
  PieceTimes times({{10, 0}, {10, 0}}, {{1, 0}});
  support::Random random(seed);
  for (int round = 0; round < 15; ++round) {
    std::vector<double> ns;
    for (const double undisturbed : {100.0, 300.0, 100.0, 300.0}) {
      const double noise = 1 + 0.02 * random.unit();
      ns.push_back(undisturbed * noise * (random.unit() < share ? 1.5 + 40 * random.unit() : 1));
    }
    times.add_round(ns);
  }
  return times.estimate(1);
}

TEST(PieceTimes, AreNotMovedByWhatInterruptsHalfOfTheSamples) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (const double share : {0.0, 0.25, 0.5}) {
      const UndisturbedTime time = with_interruptions(share, seed);
      EXPECT_NEAR(time.ns, 20, 0.5) << share << ' ' << seed;
      EXPECT_LE(time.low, time.ns);
      EXPECT_GE(time.high, time.ns);
    }
  }
}

TEST(PieceTimes, AreWeightedByTheSharesOfTheStrata) {
  // Of contact, 1 % of the way, half of the sample: 1000 ns a query there, 10 elsewhere.
  PieceTimes times({{32, 0}, {32, 0}, {32, 1}, {32, 1}}, {{0.01, 0.9}, {0.99, 0.99}});
  for (int round = 0; round < 5; ++round) times.add_round({32000, 32000, 320, 320});
  const UndisturbedTime time = times.estimate(1);
  EXPECT_NEAR(time.ns, 0.01 * 1000 + 0.99 * 10, 1e-9);
  EXPECT_NEAR(time.low, time.ns, 1e-9) << "pieces of a stratum that are alike leave no doubt";
  EXPECT_NEAR(time.high, time.ns, 1e-9);
}

TEST(PieceTimes, HaveAnIntervalThatSaysWhatASampleCannot) {
  const std::vector<Piece> pieces{{1, 0}, {1, 0}, {1, 0}, {1, 0}};
  PieceTimes sample(pieces, {{1, 0.9}}), all(pieces, {{1, 0}});
  for (int round = 0; round < 5; ++round) {
    sample.add_round({10, 20, 400, 30});
    all.add_round({10, 20, 400, 30});
  }
  EXPECT_NEAR(all.estimate(1).high, all.estimate(1).low, 1e-9);
  EXPECT_LT(sample.estimate(1).low, 60);
  EXPECT_GT(sample.estimate(1).high, 180);
}

}  // namespace
}  // namespace touchmark::bench::measurement

/// The gate's statistics, its verdict and its baseline file, on made-up numbers.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/regression/gate/baseline.h"
#include "bench/regression/gate/bootstrap.h"
#include "bench/regression/gate/judge.h"
#include "bench/support/random.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::regression::gate {
namespace {

/// Log-ratios about `center`, nearly normal with standard deviation `spread`.
std::vector<double> rounds(std::size_t count, double center, double spread, support::Random& random) {
  std::vector<double> values(count);
  for (double& value : values) {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += random.unit();
    value = center + spread * (sum - 6);
  }
  return values;
}

TEST(MedianRatio, IsCertainOfWhatIsAlwaysTheSame) {
  const std::vector<double> same(9, std::log(2.0));
  const RatioInterval interval = median_ratio(same, 1);
  EXPECT_DOUBLE_EQ(interval.ratio, 2);
  EXPECT_DOUBLE_EQ(interval.low, 2);
  EXPECT_DOUBLE_EQ(interval.high, 2);
}

TEST(MedianRatio, IsNotMovedByAFewRoundsThatWereInterrupted) {
  std::vector<double> values(31, 0.0);
  for (std::size_t i = 0; i < 5; ++i) values[i] = 3;
  EXPECT_DOUBLE_EQ(median_ratio(values, 1).ratio, 1);
  EXPECT_DOUBLE_EQ(median_ratio(values, 1).high, 1);
}

TEST(MedianRatio, HoldsTheTrueRatioNineteenTimesInTwenty) {
  support::Random random(5);
  int held = 0;
  constexpr int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    const RatioInterval interval = median_ratio(rounds(31, std::log(1.3), 0.05, random), 1);
    EXPECT_LE(interval.low, interval.ratio);
    EXPECT_GE(interval.high, interval.ratio);
    if (interval.low <= 1.3 && 1.3 <= interval.high) ++held;
  }
  EXPECT_GT(held, trials * 91 / 100);
  EXPECT_LT(held, trials * 99 / 100) << "wider than it says";
}

TEST(MedianRatio, IsTheSameForTheSameSeed) {
  support::Random random(6);
  const std::vector<double> values = rounds(31, 0, 0.1, random);
  EXPECT_EQ(median_ratio(values, 7).low, median_ratio(values, 7).low);
}

constexpr RatioInterval equal{1, 0.99, 1.01};
constexpr RatioInterval noisy{1, 0.9, 1.02};
constexpr RatioInterval slow{1.2, 1.1, 1.3};

Judgement judged(std::vector<Batch> batches) {
  std::size_t next = 0;
  Judgement judgement = judge(1, 0.07, [&] { return batches.at(next++); });
  EXPECT_EQ(static_cast<std::size_t>(judgement.batches), next);
  return judgement;
}

TEST(Judge, PassesOnOneGoodBatch) {
  EXPECT_EQ(judged({{equal, equal}}).verdict, Verdict::pass);
  EXPECT_EQ(judged({{{1.034, 0.9, 1.2}, equal}}).verdict, Verdict::pass);
  EXPECT_EQ(judged({{{0.8, 0.7, 0.9}, equal}}).verdict, Verdict::faster);
}

TEST(Judge, AsksAgainWhereTheRatioIsNearerToTheLimit) {
  const Batch in_doubt{{1.3, 1.069, 1.5}, equal};  // the lower end decides, but it is not enough
  EXPECT_EQ(judged({in_doubt, {equal, equal}}).verdict, Verdict::pass);
  EXPECT_EQ(judged({in_doubt, in_doubt}).verdict, Verdict::pass);
  EXPECT_EQ(judged({in_doubt, {slow, equal}, {slow, equal}}).verdict, Verdict::slower);
  EXPECT_EQ(judged({{slow, equal}, in_doubt, {slow, noisy}, in_doubt}).verdict, Verdict::pass);
  EXPECT_EQ(judged({{slow, equal}, in_doubt, {slow, noisy}, {slow, noisy}}).verdict, Verdict::inconclusive);
}

TEST(Judge, CallsSlowerOnlyWhatASecondBatchAgreesOn) {
  EXPECT_EQ(judged({{slow, equal}, {slow, equal}}).verdict, Verdict::slower);
  EXPECT_EQ(judged({{slow, equal}, {equal, equal}}).verdict, Verdict::pass);
}

TEST(Judge, DoesNotCountBatchesWhoseControlIsOff) {
  EXPECT_EQ(judged({{slow, noisy}, {slow, equal}, {slow, noisy}, {slow, equal}}).verdict, Verdict::slower);
  EXPECT_EQ(judged({{slow, noisy}, {slow, noisy}, {slow, noisy}, {slow, equal}}).verdict,
            Verdict::inconclusive);
  EXPECT_EQ(judged({{equal, noisy}, {equal, noisy}, {equal, noisy}, {equal, noisy}}).verdict,
            Verdict::inconclusive);
  EXPECT_EQ(judged({{equal, {1.1, 1.08, 1.12}}, {equal, equal}}).verdict, Verdict::pass);
}

TEST(Judge, ComparesWithTheBaseline) {
  EXPECT_EQ(judge(1.15, 0.07, [] { return Batch{slow, equal}; }).verdict, Verdict::pass);
  EXPECT_EQ(judge(1.0, 0.2, [] { return Batch{slow, equal}; }).verdict, Verdict::pass);
}

BaselineRow example() {
  return {{"a, b.stl", "slide", "nearest", "grid-group:lookup=scan,shape=cube", "aabb-tree"},
          0x0123456789abcdef,
          7,
          500,
          {1.25, 1.2, 1.3},
          measurement::WorkResult{25.5348, 199, {}},
          0xfeb9b2fc58af4d3c,
          "0.1.0",
          "abc",
          "A processor, fast"};
}

TEST(Baseline, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  Baseline written;
  BaselineRow other = example();
  other.key.trajectory = "jump";
  other.work.reset();
  other.checksum.reset();
  written.put(example());
  written.put(other);
  const Baseline read = Baseline::read(folder.file("b.csv", written.csv()));
  EXPECT_EQ(read.csv(), written.csv());
  const BaselineRow* const row = read.find(example().key);
  ASSERT_NE(row, nullptr);
  EXPECT_EQ(row->mesh_hash, example().mesh_hash);
  EXPECT_EQ(row->steps, 500U);
  EXPECT_EQ(row->ratio.low, 1.2);
  EXPECT_EQ(row->work->mean, 25.5348);
  EXPECT_EQ(row->checksum, example().checksum);
  EXPECT_FALSE(read.find(other.key)->work.has_value());
  GateKey unknown = example().key;
  unknown.reference = "embree";
  EXPECT_EQ(read.find(unknown), nullptr);
}

TEST(Baseline, ReplacesTheRowWithTheSameKey) {
  Baseline baseline;
  baseline.put(example());
  BaselineRow newer = example();
  newer.ratio.ratio = 2;
  baseline.put(newer);
  EXPECT_EQ(baseline.find(example().key)->ratio.ratio, 2);
  const std::string csv = baseline.csv();
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
}

TEST(Baseline, MayLackWhatIsComparedOnlyIfItIsThere) {
  const TemporaryFolder folder;
  const Baseline read = Baseline::read(folder.file("b.csv",
                                                   "ratio,mesh,trajectory,query,detector,reference,mesh_"
                                                   "fnv1a,course_fnv1a,steps\n1.5,m,t,nearest,d,r,a,b,9\n"));
  const BaselineRow* const row = read.find({"m", "t", "nearest", "d", "r"});
  ASSERT_NE(row, nullptr);
  EXPECT_EQ(row->ratio.ratio, 1.5);
  EXPECT_EQ(row->trace_hash, 0xbU);
  EXPECT_FALSE(row->checksum.has_value());
}

TEST(Baseline, NamesLineAndValueOfWhatItCannotUse) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& from, const std::string& to) {
    Baseline baseline;
    baseline.put(example());
    std::string csv = baseline.csv();
    csv.replace(csv.rfind(from), from.size(), to);
    try {
      Baseline::read(folder.file("b.csv", csv));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  EXPECT_NE(complaint("1.25", "-1").find("b.csv:2: ratio \"-1\""), std::string::npos)
      << complaint("1.25", "-1");
  EXPECT_NE(complaint(",500,", ",0,").find("steps \"0\""), std::string::npos);
  EXPECT_NE(complaint("0123456789abcdef", "xyz").find("mesh_fnv1a \"xyz\""), std::string::npos);
  EXPECT_NE(complaint(",abc,", ",abc,x,").find("fields"), std::string::npos);
  EXPECT_NE(complaint("trajectory", "path").find("no column trajectory"), std::string::npos);
}

}  // namespace
}  // namespace touchmark::bench::regression::gate

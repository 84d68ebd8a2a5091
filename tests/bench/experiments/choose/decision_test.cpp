/// Which of several measured candidates is recommended, and why the others are not: from made-up numbers.
#include "bench/experiments/choose/decision.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/choose/candidate.h"

namespace touchmark::bench::experiments::choose {
namespace {

using Places = std::vector<std::size_t>;

// A tenth of a millisecond: 100,000 ns.
const Limits limits{1000, 0.1, 50e6};

/// Takes at most so long, warm and with emptied caches; 10 MB, built in 100 ms, all answers right.
Candidate candidate(const std::string& name, double warm_ns, double cold_ns) {
  Candidate made;
  made.detector = name;
  made.claims_exactness = true;
  made.judged = 1000;
  made.times = QueryTimes{warm_ns, 2 * warm_ns, cold_ns / 2, cold_ns, 2 * cold_ns, 100, "slide"};
  made.build_ms = 100;
  made.bytes = 10'000'000;
  return made;
}

TEST(Choose, TheOneThatTakesLeastTimeIsFirst) {
  const std::vector<Candidate> candidates{candidate("slow", 1000, 50'000), candidate("fast", 2000, 4000),
                                          candidate("middle", 500, 9000)};
  EXPECT_EQ(ranking(candidates, limits), (Places{1, 2, 0})) << "by the larger of both times";
  EXPECT_DOUBLE_EQ(margin_usual(*candidates[1].times, limits), 25);
  EXPECT_DOUBLE_EQ(margin_worst(*candidates[1].times, limits), 12.5);
}

TEST(Choose, OfTimesThatAreNotToldApartTheOneOfLessMemoryIsFirst) {
  std::vector<Candidate> candidates{candidate("fast", 1000, 4000), candidate("small", 1000, 4500),
                                    candidate("smaller, too slow", 1000, 4700)};
  candidates[1].bytes = 5'000'000;
  candidates[2].bytes = 1'000'000;
  EXPECT_EQ(ranking(candidates, limits), (Places{1, 0, 2})) << "4500 is within 15 % of 4000, 4700 is not";
}

TEST(Choose, OfTiesTheOneThatIsBuiltSoonerIsFirstAndElseTheOneMeasuredFirst) {
  std::vector<Candidate> candidates{candidate("a", 1000, 4000), candidate("b", 1000, 4000),
                                    candidate("c", 1000, 4000)};
  EXPECT_EQ(ranking(candidates, limits), (Places{0, 1, 2}));
  candidates[2].build_ms = 99;
  EXPECT_EQ(ranking(candidates, limits), (Places{2, 0, 1}));
}

TEST(Choose, WhoIsWithinTheShareWarmAndNotColdDoesNotHold) {
  const std::vector<Candidate> candidates{candidate("warm only", 1000, 100'001),
                                          candidate("at the limit", 1000, 100'000),
                                          candidate("slow", 100'001, 200'000)};
  EXPECT_EQ(ranking(candidates, limits), (Places{1}));
  EXPECT_EQ(why_not(candidates[0], limits), "over the share at p99 with caches emptied");
  EXPECT_EQ(why_not(candidates[1], limits), "");
  EXPECT_EQ(why_not(candidates[2], limits), "over the share at p99.9");
}

TEST(Choose, AWrongContestantIsNeverRecommended) {
  std::vector<Candidate> candidates{candidate("wrong", 1, 1), candidate("right", 1000, 4000)};
  candidates[0].wrong = 3;
  EXPECT_EQ(ranking(candidates, limits), (Places{1}));
  EXPECT_EQ(why_not(candidates[0], limits), "wrong answers: 3");
  candidates[0].wrong = 0;
  candidates[0].claims_exactness = false;
  EXPECT_EQ(why_not(candidates[0], limits), "claims no exactness");
  candidates[0].claims_exactness = true;
  candidates[0].judged = 0;
  EXPECT_EQ(why_not(candidates[0], limits), "neither judged nor timed");
}

TEST(Choose, MoreMemoryThanAllowedDoesNotHold) {
  std::vector<Candidate> candidates{candidate("large", 1, 1), candidate("unknown", 1, 1)};
  candidates[0].bytes = 50'000'001;
  candidates[1].bytes.reset();
  EXPECT_TRUE(ranking(candidates, limits).empty());
  EXPECT_EQ(why_not(candidates[0], limits), "over the memory");
  EXPECT_EQ(why_not(candidates[1], limits), "over the memory") << "nobody knows";
  Limits any = limits;
  any.max_bytes.reset();
  EXPECT_EQ(ranking(candidates, any), (Places{0, 1}));
}

TEST(Choose, NoneHoldsWhereNoneCameSoFar) {
  std::vector<Candidate> candidates{candidate("crashed", 1, 1), candidate("not timed", 1, 1)};
  candidates[0].status = "crashed: SIGSEGV";
  candidates[1].times.reset();
  EXPECT_TRUE(ranking(candidates, limits).empty());
  EXPECT_EQ(why_not(candidates[0], limits), "crashed: SIGSEGV");
  EXPECT_TRUE(ranking({}, limits).empty());
}

measurement::ResultRow row_on(const std::string& motion, double warm_ns, double cold_ns,
                              std::size_t cold_samples) {
  measurement::ResultRow row;
  row.detector = "some";
  row.trajectory = motion;
  row.steps = 500;
  row.accuracy = Accuracy{};
  row.counts = oracle::ErrorCounts{};
  row.latency = measurement::LatencySummary{};
  row.latency->p999 = row.latency->max = warm_ns;
  row.cold = measurement::ColdSummary{cold_samples, cold_ns / 2, cold_ns, cold_ns, 3 * cold_ns};
  row.bytes = 100;
  row.heap_bytes = 120;
  row.build_ms = 7;
  return row;
}

TEST(Choose, ACandidateCountsByItsWorstMotion) {
  const std::vector<Candidate> candidates =
      candidates_of({{row_on("slide", 10, 200, 100)}, {row_on("hover", 30, 100, 150)}});
  ASSERT_EQ(candidates.size(), 1u);
  const QueryTimes& times = *candidates[0].times;
  EXPECT_EQ(times.warm_p999, 30);
  EXPECT_EQ(times.cold_p99, 200);
  EXPECT_EQ(times.cold_max, 600);
  EXPECT_EQ(times.cold_samples, 100u);
  EXPECT_EQ(times.motion, "slide");
  EXPECT_EQ(candidates[0].bytes, 120u) << "the more of both";
  EXPECT_EQ(candidates[0].judged, 1000u);
  EXPECT_TRUE(candidates[0].claims_exactness);
}

TEST(Choose, ACandidateIsTheSameOneHoweverManyAMotionHas) {
  measurement::ResultRow other = row_on("slide", 10, 200, 100);
  other.detector = "other";
  const std::vector<Candidate> candidates =
      candidates_of({{row_on("slide", 10, 200, 100)}, {other, row_on("hover", 30, 100, 150)}});
  ASSERT_EQ(candidates.size(), 2u);
  EXPECT_EQ(candidates[0].judged, 1000u);
  EXPECT_EQ(candidates[1].detector, "other");
  EXPECT_EQ(candidates[1].judged, 500u);
}

TEST(Choose, OfFewSamplesTheLargestStandsForTheirPercentile) {
  EXPECT_EQ(candidates_of({{row_on("slide", 10, 200, 99)}})[0].times->cold_p99, 600);
}

TEST(Choose, AnErrorOrAFailureOnOneMotionIsTheCandidates) {
  measurement::ResultRow wrong = row_on("hover", 30, 100, 150), failed = wrong;
  wrong.counts->wrong_triangle = 2;
  failed.status = "timeout";
  EXPECT_EQ(candidates_of({{row_on("slide", 10, 200, 100)}, {wrong}})[0].wrong, 2u);
  EXPECT_EQ(candidates_of({{failed}, {row_on("slide", 10, 200, 100)}})[0].status, "timeout");
}

}  // namespace
}  // namespace touchmark::bench::experiments::choose

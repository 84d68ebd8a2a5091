#include "bench/results/report_table.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark::bench::results {
namespace {

measurement::ResultRow timed(const std::string& detector, double ns, double p999, std::size_t steps = 2000) {
  measurement::ResultRow row;
  row.detector = detector;
  row.mesh = "cube";
  row.trajectory = "slide";
  row.steps = steps;
  row.accuracy = Accuracy{Guarantee::exact, 0, 0};
  row.counts.emplace();
  row.throughput.emplace();
  row.throughput->undisturbed = {ns, 0.9 * ns, 1.1 * ns};
  row.throughput->ns_per_query = 1e6;  // interrupted: nothing may come from here
  row.latency.emplace();
  row.latency->p999 = p999;
  return row;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Verdict, NamesTheFastestUndisturbedAndWhoCannotBeToldFromIt) {
  const std::vector<measurement::ResultRow> rows{timed("tardy", 131, 700), timed("fast", 100, 800),
                                                 timed("close", 114, 500)};
  const std::string text =
      verdict(rows, measurement::steadiness_of(rows, measurement::Control{"fast", 1.1, 1, 1.2}));
  EXPECT_TRUE(text.starts_with("fastest exact: fast, 100 ns a query [90, 110]")) << text;
  EXPECT_TRUE(has(text, "not told from it: close, 114 ns")) << text;
  EXPECT_FALSE(has(text, "tardy")) << text;
  EXPECT_TRUE(has(text, "least 99.9 % of exact ones: close, 500 ns")) << text;
}

TEST(Verdict, IsInconclusiveWhereTheControlDoesNotTie) {
  const std::vector<measurement::ResultRow> rows{timed("fast", 100, 800)};
  for (const double ratio : {1.2, 0.8}) {
    const std::string text =
        verdict(rows, measurement::steadiness_of(rows, measurement::Control{"fast", ratio, ratio, ratio}));
    EXPECT_TRUE(text.starts_with("inconclusive")) << text;
    EXPECT_TRUE(has(text, "no tie")) << text;
  }
  EXPECT_FALSE(verdict(rows, measurement::steadiness_of(rows, measurement::Control{"fast", 1.1, 1, 2}))
                   .starts_with("inconclusive"));
}

TEST(TimingTable, TellsTheP999BesideTheMeanButNotOfFewSteps) {
  const std::string enough = timing_table({timed("fast", 100, 765), timed("other", 200, 1530)}).text();
  EXPECT_TRUE(has(enough, "90..110")) << enough;
  EXPECT_TRUE(has(enough, "765")) << enough;
  EXPECT_TRUE(has(enough, "1530")) << enough;
  EXPECT_FALSE(has(timing_table({timed("fast", 100, 765, 999)}).text(), "765"));
}

}  // namespace
}  // namespace touchmark::bench::results

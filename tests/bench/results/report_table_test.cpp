#include "bench/results/report_table.h"

#include <sstream>
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

TEST(ComparisonText, HasTheFastestFirstIn120Columns) {
  std::vector<measurement::ResultRow> rows{timed("slow:" + std::string(120, 'x') + ",last=1", 200, 1530),
                                           timed("fast", 100, 765)};
  rows[0].counts->false_contacts = 388;
  rows[0].counts->rounding = 156;
  rows[1].cold.emplace();
  rows[1].cold->p50 = 4321;
  const std::string text = comparison_text(rows);
  std::vector<std::string> lines;
  for (std::istringstream in(text); in;) std::getline(in, lines.emplace_back());
  ASSERT_GE(lines.size(), 4u) << text;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(lines[i].size(), 120u) << lines[i];
  EXPECT_TRUE(lines[1].starts_with("fast ")) << text;
  EXPECT_TRUE(has(lines[1], "4321")) << text;
  EXPECT_TRUE(has(lines[2], "..")) << text;
  EXPECT_TRUE(has(lines[2], ",last=1 ")) << text;
  EXPECT_TRUE(has(lines[2], " 388 ")) << text;
  EXPECT_TRUE(has(lines[3], "last=1: 388 false, 156 rounding")) << text;
}

TEST(ComparisonText, NamesWhatWasNotTimedWithItsWholeStatus) {
  measurement::ResultRow refused;
  refused.detector = "rival";
  refused.status = "refused: it takes no mesh of so many triangles as this one";
  const std::string text = comparison_text({refused, timed("fast", 100, 765)});
  EXPECT_LT(text.find("fast"), text.find("rival")) << text;
  EXPECT_TRUE(has(text, "rival: refused: it takes no mesh of so many triangles as this one\n")) << text;
}

TEST(OverallVerdict, NamesTheFastestThatWasNeverWrongOverAllTrajectories) {
  std::vector<measurement::ResultRow> rows{timed("fast", 100, 765), timed("wrong", 10, 765),
                                           timed("slow", 300, 765), timed("fast", 400, 765),
                                           timed("wrong", 10, 765), timed("slow", 300, 765)};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].trajectory = i < 3 ? "slide" : "jump";
    rows[i].counts->judged = 1000;
    rows[i].latency->max = i < 3 ? 2000 : 50'000;
  }
  rows[4].counts->missed = 1;
  EXPECT_EQ(overall_verdict(rows),
            "fast is the fastest that was never wrong in 2000 checked steps: 200 ns a query. Its slowest "
            "warm step took 50 us, which holds 1, 4 and 10 kHz, the last with a margin of 2.\n");
  rows[0].cold.emplace();
  rows[0].cold->max = 300'000;
  EXPECT_TRUE(has(overall_verdict(rows),
                  "With all caches emptied its slowest query took 300 us, which holds 1 kHz,"));
  EXPECT_EQ(overall_verdict({rows[4]}), "No contestant finished all trajectories without a wrong answer.\n");
}

}  // namespace
}  // namespace touchmark::bench::results

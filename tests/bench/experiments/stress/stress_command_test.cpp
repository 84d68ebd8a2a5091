/// `touchmark stress` as a user runs it, on honest contestants and on those that lie, crash and hang.
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/stress/stress_csv.h"
#include "tests/bench/cli/csv_table.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

Outcome hostile_stress(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {TOUCHMARK_HOSTILE_PROGRAM, "stress"});
  return run_program_at(arguments);
}

std::size_t stress_column(const std::string& column) {
  return index_of(column, results::names_of(experiments::stress::stress_columns()));
}

TEST(Stress, ExactContestantsAreCleanAndItsFilesSaySo) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_touchmark({"stress", "--detector", "aabb-tree", "--detector", "brute-force", "--family", "ties",
                     "--family", "empty-mesh", "--probes", "90", "--seed", "3", "--out", folder.file("out")});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "") << "no progress where stderr is no terminal";
  EXPECT_NE(outcome.out.find("aabb-tree"), std::string::npos);
  EXPECT_NE(outcome.out.find("as claimed"), std::string::npos);

  const auto rows = table_in(folder.file("out/stress.csv"));
  ASSERT_EQ(rows.size(), 1U + 2 * 2 * 2) << "contestants, families, queries";
  EXPECT_EQ(rows[0], results::names_of(experiments::stress::stress_columns()));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), rows[0].size());
    const bool empty = rows[i][stress_column("family")] == "empty-mesh";
    EXPECT_EQ(rows[i][stress_column("detector")], i <= 4 ? "aabb-tree" : "brute-force");
    EXPECT_EQ(rows[i][stress_column("status")], empty ? "refused" : "ok");
    EXPECT_EQ(rows[i][stress_column("refusals")], empty ? "1" : "0");
    EXPECT_EQ(rows[i][stress_column("meshes")], empty ? "1" : "3");
    EXPECT_EQ(rows[i][stress_column("missed")], "0");
    EXPECT_GT(std::stoi("0" + rows[i][stress_column("probes")]), empty ? -1 : 80);
  }
  EXPECT_EQ(run_touchmark({"validate", folder.file("out")}).status, 0)
      << run_touchmark({"validate", folder.file("out")}).out;
}

TEST(Stress, SaysTheSameAgain) {
  const TemporaryFolder folder;
  std::vector<std::vector<std::vector<std::string>>> tables;
  for (const char* name : {"one", "two"}) {
    run_touchmark({"stress", "--detector", "aabb-tree", "--family", "thresholds", "--probes", "60", "--out",
                   folder.file(name)});
    tables.push_back(table_in(folder.file(name) + "/stress.csv"));
    for (std::vector<std::string>& row : tables.back())
      row[stress_column("run_id")] = row[stress_column("ns_per_query")] = "";
  }
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_EQ(tables[0].size(), 3U);
}

TEST(Stress, ALieIsCaughtWithStatusOne) {
  const TemporaryFolder folder;
  const Outcome outcome = hostile_stress({"--detector", "lies", "--detector", "honest", "--family",
                                          "thresholds", "--probes", "60", "--out", folder.path()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("BROKEN lies: thresholds"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("BROKEN honest"), std::string::npos) << outcome.out;
  for (const auto& row : table_in(folder.file("stress.csv"))) {
    if (row[stress_column("detector")] != "lies" || row[stress_column("query")] != "nearest") continue;
    EXPECT_GT(std::stoi(row[stress_column("beyond_bound")]), 0);
    EXPECT_EQ(row[stress_column("status")], "inexact");
  }
}

TEST(Stress, ACrashAndAHangOfAnExactContestantAreStatusOneAndCounted) {
  const TemporaryFolder folder;
  const Outcome outcome =
      hostile_stress({"--detector", "aborts", "--detector", "hangs", "--detector", "refuses", "--family",
                      "tangent", "--probes", "30", "--timeout", "1", "--out", folder.path()});
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
  for (const auto& row : table_in(folder.file("stress.csv"))) {
    if (row[stress_column("query")] != "nearest") continue;
    const std::string detector = row[stress_column("detector")];
    EXPECT_EQ(row[stress_column("crashes")], detector == "aborts" ? "1" : "0");
    EXPECT_EQ(row[stress_column("timeouts")], detector == "hangs" ? "1" : "0");
    EXPECT_EQ(row[stress_column("refusals")], detector == "refuses" ? "1" : "0");
  }
  EXPECT_EQ(run_touchmark({"validate", folder.path()}).status, 0);
}

TEST(Stress, ValidateSeesAFileThatContradictsItself) {
  const TemporaryFolder folder;
  run_touchmark(
      {"stress", "--detector", "aabb-tree", "--family", "tangent", "--probes", "30", "--out", folder.path()});
  const std::string right = content_of(folder.file("stress.csv"));
  for (const auto& [from, to, told] : std::vector<std::array<std::string, 3>>{
           {",ok,", ",wrong,", "status \"wrong\" is not so by its own counts"},
           {",exact,1,1,", ",exact,7,1,", "adversarial \"7\" is not 0 or 1"},
           {",touches,", ",touch,", "query \"touch\" is not one of"},
           {",ok,", ",fine,", "status \"fine\" is not one of"},
           {"schema,", "scheme,", "is not schema"}}) {
    std::string damaged = right;
    ASSERT_NE(damaged.find(from), std::string::npos) << from;
    folder.file("stress.csv", damaged.replace(damaged.find(from), from.size(), to));
    const Outcome outcome = run_touchmark({"validate", folder.path()});
    EXPECT_EQ(outcome.status, 1) << to;
    EXPECT_NE(outcome.out.find(told), std::string::npos) << outcome.out;
  }
}

TEST(Stress, RefusingIsNoBrokenClaim) {
  const Outcome alone = hostile_stress({"--detector", "refuses", "--family", "tangent", "--probes", "30"});
  EXPECT_EQ(alone.status, 4) << "nothing was judged";
  EXPECT_NE(alone.out.find("nothing judged"), std::string::npos) << alone.out;
  EXPECT_EQ(hostile_stress(
                {"--detector", "refuses", "--detector", "honest", "--family", "tangent", "--probes", "30"})
                .status,
            0);
}

TEST(Stress, RefusesBadOptionsInOneLine) {
  expect_bad_input({"stress", "--family", "neadles"}, {"neadles", "needles"});
  expect_bad_input({"stress", "--probes", "none"}, {"--probes", "none"});
  expect_bad_input({"stress", "--probes", "0"}, {"--probes", "0"});
  expect_bad_input({"stress", "--seed", "-1"}, {"--seed", "-1"});
  expect_bad_input({"stress", "--detector", "grid-grop"}, {"grid-grop", "grid-group"});
}

TEST(Stress, HelpHasAnExampleAndTheFamilies) {
  const Outcome outcome = run_touchmark({"stress", "--help"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* text : {"Example: touchmark stress", "needles", "cell-borders", "Exit status 1"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace touchmark::bench::cli

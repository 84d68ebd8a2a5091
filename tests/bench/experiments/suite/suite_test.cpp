/// The suite's plan, its score on made-up rows, and the check of suite.csv.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/suite/suite_check.h"
#include "bench/experiments/suite/suite_csv.h"
#include "bench/experiments/suite/suite_plan.h"
#include "bench/experiments/suite/suite_report.h"
#include "bench/experiments/suite/suite_score.h"
#include "bench/meshes/meshes.h"
#include "bench/trajectories/trajectories.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::experiments::suite {
namespace {

using workload::Query;

TEST(SuitePlan, HasFourSpeedsThreeQueriesAndFourReachesAndNothingThatMakesNoSense) {
  const std::vector<SuiteCell> cells = every_cell();
  // Thirteen motions; nearest within four reaches, the others within three.
  EXPECT_EQ(cells.size(), 13U * (4 + 3 + 3));
  std::set<std::string> speeds;
  for (const SuiteCell& cell : cells) {
    EXPECT_TRUE(trajectories::is_generated(cell.trajectory)) << cell.trajectory;
    if (cell.trajectory.starts_with("slide")) speeds.insert(cell.trajectory);
    if (cell.query != Query::nearest) {
      EXPECT_NE(cell.reach, "inf");
    }
    EXPECT_EQ(cell.radius(), cell.reach == "inf" ? "0.5%" : cell.reach);
  }
  EXPECT_EQ(speeds.size(), 4U);
  EXPECT_TRUE(speeds.contains("slide:speed=0.01%"));
  EXPECT_TRUE(speeds.contains("slide:speed=5%"));
}

TEST(SuitePlan, HasThirtyScenesOfDifferentKindsThatNeedNoFile) {
  const std::vector<std::string> meshes = suite_meshes(6000);
  std::set<std::string> kinds;
  for (const std::string& mesh : meshes) {
    if (mesh.find('/') != std::string::npos || mesh == "bunny" || mesh.starts_with("dragon")) continue;
    kinds.insert(mesh.substr(0, mesh.find(':')));
    const TriangleMesh loaded = meshes::load_mesh(mesh);
    EXPECT_GT(loaded.size(), 300U) << mesh;
    EXPECT_LT(loaded.size(), 25'000U) << mesh;
    EXPECT_GT(loaded.diagonal(), 0) << mesh;
  }
  EXPECT_GE(kinds.size(), 30U);
}

std::map<std::string, std::size_t> counted(const SuitePlan& plan, std::string (*property)(const SuiteCell&)) {
  std::map<std::string, std::size_t> counts;
  for (const SuiteMesh& planned : plan.meshes)
    for (const SuiteCell& cell : planned.cells) ++counts[property(cell)];
  return counts;
}

TEST(SuitePlan, AsksEachMotionAndEachQueryWithinEachReachAboutEquallyOften) {
  const std::vector<std::string> meshes(30, "cube");
  const SuitePlan plan = make_plan(meshes, 3, 1);
  EXPECT_EQ(plan.cells(), 90U);
  const auto expect_even = [&](std::string (*property)(const SuiteCell&), std::size_t values) {
    const auto counts = counted(plan, property);
    EXPECT_EQ(counts.size(), values);
    for (const auto& [value, count] : counts) {
      EXPECT_GT(count, 90 / values / 2) << value;
      EXPECT_LT(count, 2 * 90 / values) << value;
    }
  };
  expect_even([](const SuiteCell& cell) { return cell.trajectory; }, 13);
  expect_even([](const SuiteCell& cell) { return std::to_string(static_cast<int>(cell.query)) + cell.reach; },
              10);
}

TEST(SuitePlan, FewerCellsAreTheBeginningOfMoreAndTheLastIsAlsoCold) {
  const std::vector<std::string> meshes{"cube", "wedge", "caps"};
  const SuitePlan few = make_plan(meshes, 4, 7), more = make_plan(meshes, 1000, 7),
                  other = make_plan(meshes, 4, 8);
  bool differs = false;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    ASSERT_EQ(few.meshes[i].cells.size(), 4U);
    EXPECT_EQ(more.meshes[i].cells.size(), every_cell().size());
    std::set<std::string> seen;
    for (const SuiteCell& cell : more.meshes[i].cells)
      seen.insert(cell.trajectory + std::to_string(static_cast<int>(cell.query)) + cell.reach);
    EXPECT_EQ(seen.size(), every_cell().size());
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(few.meshes[i].cells[k].trajectory, more.meshes[i].cells[k].trajectory);
      EXPECT_EQ(few.meshes[i].cells[k].reach, more.meshes[i].cells[k].reach);
      EXPECT_EQ(few.meshes[i].cells[k].cold, k == 3);
      differs = differs || few.meshes[i].cells[k].trajectory != other.meshes[i].cells[k].trajectory;
    }
  }
  EXPECT_TRUE(differs);
}

/// Right, exact if asked for, with a mean and, unless that is 0, a 99.9 %.
measurement::ResultRow row(const std::string& detector, double mean, double p999,
                           Guarantee guarantee = Guarantee::exact) {
  measurement::ResultRow row;
  row.detector = detector;
  row.steps = p999 > 0 ? 5000 : 500;
  row.accuracy = Accuracy{};
  row.accuracy->guarantee = guarantee;
  row.counts = oracle::ErrorCounts{};
  row.throughput = measurement::ThroughputResult{};
  row.throughput->undisturbed.ns = mean;
  row.latency = measurement::LatencySummary{};
  row.latency->p999 = p999;
  row.build_ms = mean / 10;
  row.bytes = 1000;
  return row;
}

const std::vector<std::string> ours{"hare", "hedgehog"};
bool is_ours(const std::string& detector) { return detector == "hare" || detector == "hedgehog"; }

MeasuredCell measured(std::vector<measurement::ResultRow> rows, const std::string& mesh = "cube") {
  return {mesh, 12, {"slide:speed=0.1%", Query::nearest, "0.5%"}, std::move(rows)};
}

const SuiteRow& of(const std::vector<SuiteRow>& rows, const std::string& name) {
  return *std::find_if(rows.begin(), rows.end(), [&](const SuiteRow& one) { return one.ours == name; });
}

TEST(SuiteScore, IsTheFastestRivalsTimeOverOurs) {
  const std::vector<SuiteRow> rows =
      score(measured({row("hare", 100, 400), row("hedgehog", 50, 1000), row("tree", 200, 600),
                      row("bush", 150, 900), row("float", 40, 300, Guarantee::approximate)}),
            ours, is_ours);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(of(rows, "hare").mean.exact->contestant, "bush");
  EXPECT_DOUBLE_EQ(of(rows, "hare").mean.exact->ratio, 1.5);
  EXPECT_DOUBLE_EQ(of(rows, "hare").mean.any->ratio, 0.4);
  EXPECT_EQ(of(rows, "hare").tail.exact->contestant, "tree");
  EXPECT_DOUBLE_EQ(of(rows, "hare").tail.exact->ratio, 1.5);
  EXPECT_DOUBLE_EQ(of(rows, "hare").tail.any->ratio, 0.75);
  // The best is chosen by its mean, and its tail is that of the same form.
  EXPECT_EQ(of(rows, "best").form, "hedgehog");
  EXPECT_DOUBLE_EQ(of(rows, "best").mean.exact->ratio, 3);
  EXPECT_DOUBLE_EQ(of(rows, "best").tail.exact->ratio, 0.6);
  EXPECT_DOUBLE_EQ(*of(rows, "best").mean.exact->build_ms, 15);
}

TEST(SuiteScore, WhoErredOrFailedIsNoExactRivalAndNoneOfOurs) {
  measurement::ResultRow wrong = row("tree", 10, 20), crashed = row("bush", 10, 20),
                         ours_wrong = row("hare", 1, 2);
  wrong.counts->missed = 1;
  ours_wrong.counts->missed = 1;
  crashed.status = "timeout";
  const std::vector<SuiteRow> rows =
      score(measured({ours_wrong, row("hedgehog", 50, 100), wrong, crashed}), ours, is_ours);
  EXPECT_EQ(of(rows, "hare").status, "no answer");
  EXPECT_FALSE(of(rows, "hare").mean.ns);
  EXPECT_EQ(of(rows, "best").form, "hedgehog");
  EXPECT_FALSE(of(rows, "best").mean.exact);
  EXPECT_EQ(of(rows, "best").mean.any->contestant, "tree");
}

TEST(SuiteScore, ATailIsMissingBelowAThousandSteps) {
  const std::vector<SuiteRow> rows =
      score(measured({row("hare", 100, 0), row("tree", 200, 600)}), ours, is_ours);
  EXPECT_TRUE(of(rows, "best").mean.exact);
  EXPECT_FALSE(of(rows, "best").tail.ns);
  EXPECT_FALSE(of(rows, "best").tail.any);
}

TEST(SuiteScore, AColdCellIsComparedByItsMedian) {
  measurement::ResultRow one = row("hare", 100, 400), other = row("tree", 300, 900);
  one.cold = measurement::ColdSummary{120, 1000, 2000, 3000, 4000};
  other.cold = measurement::ColdSummary{120, 900, 3000, 3000, 4000};
  MeasuredCell cell = measured({one, other});
  cell.cell.cold = true;
  const std::vector<SuiteRow> rows = score(cell, {"hare"}, is_ours);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_FALSE(rows[0].cell.cold);
  EXPECT_DOUBLE_EQ(rows[0].mean.exact->ratio, 3);
  EXPECT_TRUE(rows[2].cell.cold);
  EXPECT_DOUBLE_EQ(rows[2].mean.exact->ratio, 0.9);
  EXPECT_DOUBLE_EQ(rows[2].tail.exact->ratio, 1.5);
}

std::vector<SuiteRow> three_cells_and_one_not_measured() {
  std::vector<SuiteRow> rows;
  const auto add = [&](const MeasuredCell& cell) {
    for (SuiteRow& one : score(cell, ours, is_ours)) rows.push_back(std::move(one));
  };
  add(measured({row("hare", 100, 100), row("hedgehog", 100, 100), row("tree", 400, 400)},
               "a"));  // a tie of ours
  add(measured({row("hare", 100, 100), row("tree", 50, 200)}, "b"));
  add(measured({row("hare", 100, 100), row("tree", 100, 100)}, "c"));  // a tie with the rival is no loss
  add(measured({}, "d"));
  return rows;
}

TEST(SuiteSummary, IsGeometricMeanMedianWorstAndItsCell) {
  const std::vector<SuiteRow> rows = three_cells_and_one_not_measured();
  const std::optional<Summary> summary = summary_of(rows, best_of_ours, exact_mean);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->cells, 3U);
  EXPECT_EQ(summary->lost, 1U);
  EXPECT_NEAR(summary->geometric_mean, std::cbrt(4 * 0.5 * 1), 1e-12);
  EXPECT_DOUBLE_EQ(summary->median, 1);
  EXPECT_DOUBLE_EQ(summary->worst, 0.5);
  EXPECT_EQ(summary->worst_row->mesh, "b");
  EXPECT_EQ(summary_of(rows, "hedgehog", exact_mean)->cells, 1U);
  EXPECT_FALSE(summary_of(rows, "nobody", exact_mean));
  const std::string table = summary_table(rows), losses = list_of_losses(rows, 10);
  EXPECT_NE(table.find("1 planned cells were not measured"), std::string::npos) << table;
  EXPECT_NE(losses.find("1 cells in which"), std::string::npos) << losses;
  EXPECT_NE(losses.find("b: slide:speed=0.1%, nearest within 0.5%, warm"), std::string::npos) << losses;
}

class SuiteCsv : public testing::Test {
 protected:
  results::validation::Faults faults_of(const std::string& text) const {
    const std::string path = folder_.file("suite.csv");
    std::ofstream(path) << text;
    results::validation::Faults faults;
    const results::validation::CsvTable table = results::validation::read_csv_table(path, faults);
    const nlohmann::json run{{"run_id", "now"}};
    check_suite(table, &run, faults);
    return faults;
  }
  std::string text_ = suite_csv("now", 1, three_cells_and_one_not_measured());

 private:
  TemporaryFolder folder_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST_F(SuiteCsv, WhatIsWrittenIsFine) {
  const results::validation::Faults faults = faults_of(text_);
  EXPECT_TRUE(faults.empty()) << line_of(faults.front());
  EXPECT_NE(text_.find(",not measured,"), std::string::npos);
}

TEST_F(SuiteCsv, EveryKindOfFaultIsFound) {
  const std::pair<const char*, const char*> mistakes[] = {
      {",now,", ",then,"},                                 // another run
      {",400,4,", ",400,5,"},                              // a ratio that is not that of its times
      {",warm,", ",tepid,"},                               // no such caches
      {"b,12,slide:speed=0.1%", "a,12,slide:speed=0.1%"},  // a cell twice
      {",ok,hare,5000,100,", ",ok,,5000,100,"},            // a time of nobody
      {",best,ok,hare,5000,100,tree,50,0.5,", ",best,ok,hare,5000,200,tree,100,0.5,"},  // not the best
      {",not measured,,", ",not measured,hare,"},  // who was not measured
  };
  for (const auto& [from, to] : mistakes) {
    EXPECT_FALSE(faults_of(replaced(text_, from, to)).empty()) << to;
  }
}

}  // namespace
}  // namespace touchmark::bench::experiments::suite

/// The suite's plan, its score on made-up rows, and the check of suite.csv.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
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

TEST(SuitePlan, HasNineMotionsOfHandsAndSevenOfStressAndNothingThatMakesNoSense) {
  const std::vector<SuiteCell> cells = every_cell();
  std::set<std::string> of_hands, of_stress;
  // Nearest within four reaches, the others within three.
  EXPECT_EQ(cells.size(), (9U + 7U) * (4 + 3 + 3));
  for (const SuiteCell& cell : cells) {
    EXPECT_TRUE(trajectories::is_generated(cell.trajectory)) << cell.trajectory;
    (cell.stress ? of_stress : of_hands).insert(cell.trajectory);
    EXPECT_FALSE(cell.l2 || cell.cold);
    if (cell.query != Query::nearest) {
      EXPECT_NE(cell.reach, "inf");
    }
    EXPECT_EQ(cell.radius(), cell.reach == "inf" ? "0.5%" : cell.reach);
  }
  EXPECT_EQ(of_hands,
            (std::set<std::string>{"hand", "hand:free", "hand:tap", "slide:speed=0.01%", "slide:speed=0.2%",
                                   "approach:speed=0.01%", "approach:speed=0.2%", "hover:speed=0.01%",
                                   "hover:speed=0.2%"}));
  EXPECT_EQ(of_stress,
            (std::set<std::string>{"jump", "slide:speed=0.7%", "slide:speed=5%", "approach:speed=0.7%",
                                   "approach:speed=5%", "hover:speed=0.7%", "hover:speed=5%"}));
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
  const std::vector<std::string> meshes(36, "cube");
  SuitePlan plan = make_plan(meshes, 6, 1);
  EXPECT_EQ(plan.cells(), 216U);
  std::size_t stress = 0;
  for (SuiteMesh& planned : plan.meshes)
    stress += std::erase_if(planned.cells, [](const SuiteCell& cell) { return cell.stress; });
  EXPECT_EQ(stress, 36U);
  const auto expect_even = [&](std::string (*property)(const SuiteCell&), std::size_t values) {
    const auto counts = counted(plan, property);
    EXPECT_EQ(counts.size(), values);
    for (const auto& [value, count] : counts) {
      EXPECT_GT(count, 180 / values / 2) << value;
      EXPECT_LT(count, 2 * 180 / values) << value;
    }
  };
  expect_even([](const SuiteCell& cell) { return cell.trajectory; }, 9);
  expect_even([](const SuiteCell& cell) { return std::to_string(static_cast<int>(cell.query)) + cell.reach; },
              10);
}

TEST(SuitePlan, FewerCellsAreTheBeginningOfMoreAndCachesAreEmptiedForHands) {
  const std::vector<std::string> meshes{"cube", "wedge", "caps"};
  const SuitePlan few = make_plan(meshes, 7, 7), more = make_plan(meshes, 1000, 7),
                  other = make_plan(meshes, 7, 8);
  bool differs = false;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    ASSERT_EQ(few.meshes[i].cells.size(), 7U);
    EXPECT_EQ(more.meshes[i].cells.size(), every_cell().size());
    std::set<std::string> seen;
    for (const SuiteCell& cell : more.meshes[i].cells)
      seen.insert(cell.trajectory + std::to_string(static_cast<int>(cell.query)) + cell.reach);
    EXPECT_EQ(seen.size(), every_cell().size());
    for (std::size_t k = 0; k < 7; ++k) {
      EXPECT_EQ(few.meshes[i].cells[k].trajectory, more.meshes[i].cells[k].trajectory);
      EXPECT_EQ(few.meshes[i].cells[k].reach, more.meshes[i].cells[k].reach);
      EXPECT_EQ(few.meshes[i].cells[k].stress, k == 5);
      EXPECT_EQ(few.meshes[i].cells[k].l2, k != 5);
      EXPECT_EQ(few.meshes[i].cells[k].cold, k == 0);
      differs = differs || few.meshes[i].cells[k].trajectory != other.meshes[i].cells[k].trajectory;
    }
  }
  EXPECT_TRUE(differs);
}

/// Right, exact if asked for, with a mean and, unless that is 0, a 99.9 %, both known to 2 %.
measurement::ResultRow row(const std::string& detector, double mean, double p999,
                           Guarantee guarantee = Guarantee::exact) {
  measurement::ResultRow row;
  row.detector = detector;
  row.steps = p999 > 0 ? 5000 : 500;
  row.accuracy = Accuracy{};
  row.accuracy->guarantee = guarantee;
  row.counts = oracle::ErrorCounts{};
  row.throughput = measurement::ThroughputResult{};
  row.throughput->undisturbed = {mean, 0.98 * mean, 1.02 * mean};
  row.latency = measurement::LatencySummary{};
  row.latency->p999 = p999;
  row.latency->p999_bounds = {0.98 * p999, 1.02 * p999};
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

MeasuredCell cold_cell() {
  measurement::ResultRow one = row("hare", 100, 400), other = row("tree", 300, 900);
  one.cold = measurement::ColdSummary{120, 3000, 5000, 6000, 7000, {2900, 3100}, {4500, 6000}};
  other.cold = measurement::ColdSummary{120, 2800, 9000, 9500, 9900, {2750, 3050}, {8000, 9500}};
  one.cold_l2 = measurement::ColdSummary{1200, 600, 2000, 3000, 4000, {590, 610}, {1900, 2100}};
  other.cold_l2 = measurement::ColdSummary{1200, 900, 3000, 3000, 4000, {880, 920}, {2900, 3100}};
  one.cold_floor_ns = 900;
  other.cold_floor_ns = 1100;
  one.cold_floor_l2_ns = other.cold_floor_l2_ns = 400;
  MeasuredCell cell = measured({one, other});
  cell.cell.l2 = cell.cell.cold = true;
  return cell;
}

TEST(SuiteScore, AColdCellIsComparedByItsMedianAboveTheFloor) {
  const std::vector<SuiteRow> rows = score(cold_cell(), {"hare"}, is_ours);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0].caches, Caches::warm);
  EXPECT_DOUBLE_EQ(rows[0].mean.exact->ratio, 3);
  EXPECT_EQ(rows[0].floor_ns, 0);
  EXPECT_EQ(rows[2].caches, Caches::l2);
  EXPECT_EQ(rows[2].floor_ns, 400);
  EXPECT_DOUBLE_EQ(rows[2].mean.exact->ratio, 500.0 / 200);
  EXPECT_EQ(rows[4].caches, Caches::cold);
  EXPECT_EQ(rows[4].floor_ns, 1000);
  EXPECT_DOUBLE_EQ(rows[4].mean.exact->ratio, 1800.0 / 2000);
  EXPECT_DOUBLE_EQ(rows[4].tail.exact->ratio, 8000.0 / 4000);
  EXPECT_DOUBLE_EQ(rows[4].tail.exact->ratio_bounds.low, 7000.0 / 5000);
  EXPECT_DOUBLE_EQ(rows[4].tail.exact->ratio_bounds.high, 8500.0 / 3500);
}

TEST(SuiteScore, WhatIsTooShortOrOfTheStressDoesNotCount) {
  std::vector<SuiteRow> rows = score(cold_cell(), {"hare"}, is_ours);
  EXPECT_TRUE(rows[0].mean.exact->counts);
  EXPECT_TRUE(rows[0].tail.exact->counts);
  EXPECT_FALSE(rows[2].mean.exact->counts);  // 200 ns above the floor
  EXPECT_TRUE(rows[4].mean.exact->counts);
  const auto counts = [](const MeasuredCell& cell) {
    const Standing& mean = score(cell, {"hare"}, is_ours)[0].mean;
    const Standing& tail = score(cell, {"hare"}, is_ours)[0].tail;
    return std::pair(mean.exact->counts, tail.exact->counts);
  };
  EXPECT_EQ(counts(measured({row("hare", 19, 300), row("tree", 19.9, 399)})), std::pair(false, false));
  EXPECT_EQ(counts(measured({row("hare", 19.9, 399), row("tree", 19, 300)})), std::pair(false, false));
  EXPECT_EQ(counts(measured({row("hare", 19, 300), row("tree", 20, 400)})), std::pair(true, true));
  MeasuredCell stress = measured({row("hare", 100, 300), row("tree", 200, 900)});
  stress.cell.stress = true;
  EXPECT_EQ(counts(stress), std::pair(false, false));
}

std::vector<SuiteRow> three_cells_and_one_not_measured() {
  std::vector<SuiteRow> rows;
  const auto add = [&](const MeasuredCell& cell) {
    for (SuiteRow& one : score(cell, ours, is_ours)) rows.push_back(std::move(one));
  };
  add(measured({row("hare", 100, 100), row("hedgehog", 100, 100), row("tree", 400, 400)},
               "a"));  // a tie of ours
  add(measured({row("hare", 100, 100), row("tree", 50, 200)}, "b"));
  add(measured({row("hare", 100, 100), row("tree", 99, 100)}, "c"));  // too near to be told from a tie
  add(measured({}, "d"));
  return rows;
}

TEST(SuiteSummary, IsGeometricMeanMedianWorstAndItsCell) {
  const std::vector<SuiteRow> rows = three_cells_and_one_not_measured();
  const auto of_ours = [&](const std::string& name) {
    std::vector<const SuiteRow*> found;
    for (const SuiteRow& one : rows)
      if (one.ours == name) found.push_back(&one);
    return found;
  };
  const std::optional<Summary> summary = summary_of(of_ours(best_of_ours), exact_mean);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->cells, 3U);
  EXPECT_EQ(summary->behind, 1U);
  EXPECT_EQ(summary->undecided, 1U);
  EXPECT_NEAR(summary->geometric_mean, std::cbrt(4 * 0.5 * 0.99), 1e-12);
  EXPECT_DOUBLE_EQ(summary->median, 0.99);
  EXPECT_DOUBLE_EQ(summary->worst, 0.5);
  EXPECT_EQ(summary->worst_row->mesh, "b");
  EXPECT_EQ(summary_of(of_ours("hedgehog"), exact_mean)->cells, 1U);
  EXPECT_FALSE(summary_of({}, exact_mean));
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

TEST_F(SuiteCsv, AFileOfVersion02IsFine) {
  std::istringstream lines(text_);
  std::string old;
  constexpr int columns_then = 33;
  for (std::string line; std::getline(lines, line);) {
    std::size_t end = 0;
    for (int i = 0; i < columns_then; ++i) end = line.find(',', end) + 1;
    old += line.substr(0, end - 1) + '\n';
  }
  EXPECT_TRUE(old.substr(0, old.find('\n')).ends_with(",seed")) << old;
  EXPECT_TRUE(faults_of(old).empty());
}

TEST_F(SuiteCsv, EveryKindOfFaultIsFound) {
  const std::pair<const char*, const char*> mistakes[] = {
      {",now,", ",then,"},                                 // another run
      {",400,4,", ",400,5,"},                              // a ratio that is not that of its times
      {",warm,", ",tepid,"},                               // no such caches
      {"b,12,slide:speed=0.1%", "a,12,slide:speed=0.1%"},  // a cell twice
      {",ok,hare,5000,100,", ",ok,,5000,100,"},            // a time of nobody
      {",best,ok,hare,5000,100,tree,50,0.5,", ",best,ok,hare,5000,200,tree,100,0.5,"},  // not the best
      {",hand,0,", ",stress,0,"},                  // a cell of the stress that counts
      {",hand,0,", ",foot,0,"},                    // no such section
      {",hand,0,", ",hand,50,"},                   // ratios that are not those above the floor
      {",not measured,,", ",not measured,hare,"},  // who was not measured
  };
  for (const auto& [from, to] : mistakes) {
    EXPECT_FALSE(faults_of(replaced(text_, from, to)).empty()) << to;
  }
}

}  // namespace
}  // namespace touchmark::bench::experiments::suite

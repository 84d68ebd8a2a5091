/// Whatever a contestant does to its own process is a row with a status, and the others are measured.
#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/measurement/comparison.h"
#include "bench/meshes/meshes.h"
#include "tests/bench/workers/hostile_roster.h"

namespace touchmark::bench::workers {
namespace {

constexpr std::size_t steps = 40;

workload::Workload small_workload() {
  workload::Selection selection;
  selection.radius = {1, true};
  return workload::make_workload("icosphere:1", meshes::load_mesh("icosphere:1"), selection, {"slide", "tap"},
                                 steps);
}

/// The rows of each trajectory in turn.
std::vector<measurement::ResultRow> rows_of(const std::vector<std::string>& contestants, bool timed = false) {
  const workload::Workload workload = small_workload();
  std::vector<contestants::ContestantSpec> specs;
  for (const std::string& name : contestants) specs.push_back(hostile_roster().parse(name));
  WorkerOptions workers;
  workers.build_timeout = workers.request_timeout = std::chrono::seconds(5);
  measurement::Effort effort;
  effort.repetitions = timed ? 2 : 0;
  effort.repetition_ns = 2e6;
  measurement::Comparison comparison(hostile_roster(), workload, specs, workers, effort, 1);
  std::vector<measurement::ResultRow> rows;
  for (std::size_t trace = 0; trace < workload.traces.size(); ++trace) {
    const std::vector<measurement::ResultRow> some = comparison.run(trace, workload::Query::nearest);
    rows.insert(rows.end(), some.begin(), some.end());
  }
  return rows;
}

std::string status_of(const std::string& contestant) {
  const std::vector<measurement::ResultRow> rows = rows_of({contestant, "honest"});
  EXPECT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[1].status, "ok") << "the contestant after it must not suffer";
  EXPECT_EQ(rows[3].status, "ok");
  EXPECT_EQ(rows[2].status, rows[0].status) << "the second trajectory must be tried as well";
  EXPECT_FALSE(rows[0].throughput);
  return rows[0].status;
}

TEST(WorkerSurvival, AnAbortIsAStatus) { EXPECT_EQ(status_of("aborts"), "crashed:SIGABRT"); }

TEST(WorkerSurvival, AnAbortDuringTheBuildIsAStatus) {
  EXPECT_EQ(status_of("aborts-at-build"), "crashed:SIGABRT");
}

TEST(WorkerSurvival, ADivisionByZeroIsAStatus) { EXPECT_EQ(status_of("divides-by-zero"), "crashed:SIGFPE"); }

TEST(WorkerSurvival, AnExceptionOutOfAQueryIsAStatus) { EXPECT_EQ(status_of("throws"), "crashed:SIGABRT"); }

TEST(WorkerSurvival, AnExitIsAStatus) { EXPECT_EQ(status_of("exits"), "crashed:exit 7"); }

TEST(WorkerSurvival, ARefusalSaysWhy) { EXPECT_EQ(status_of("refuses"), "refused: no mesh is good enough"); }

TEST(WorkerSurvival, AQueryThatIsNotDeclaredIsUnsupported) {
  EXPECT_EQ(status_of("touches-only"), "unsupported");
}

TEST(WorkerSurvival, AHangIsEndedAfterTheTimeGiven) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(status_of("hangs"), "timeout");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(WorkerSurvival, AHangDuringTheBuildIsWaitedForOnlyOnce) {
  EXPECT_EQ(status_of("hangs-at-build"), "timeout");
}

TEST(WorkerSurvival, ALieIsCountedAndBreaksTheClaim) {
  const std::vector<measurement::ResultRow> rows = rows_of({"lies"});
  ASSERT_TRUE(rows[0].counts);
  EXPECT_GT(rows[0].counts->beyond_bound, 0U);
  EXPECT_TRUE(rows[0].violates_guarantee());
}

TEST(WorkerSurvival, AnswersThatDifferWhenTimedAreAMismatchAndNoResult) {
  const std::vector<measurement::ResultRow> rows = rows_of({"fickle", "honest"}, true);
  EXPECT_EQ(rows[0].status, "checksum mismatch");
  EXPECT_FALSE(rows[0].throughput);
  EXPECT_FALSE(rows[0].violates_guarantee()) << "it was right when it was verified, or this tests nothing";
  EXPECT_EQ(rows[1].status, "ok");
}

TEST(WorkerSurvival, AnswersMayDependOnThoseBeforeWithinTheirWord) {
  const std::vector<measurement::ResultRow> rows = rows_of({"settles", "drifts", "lies-later"}, true);
  EXPECT_EQ(rows[0].status, "ok") << "all passes but the first are the same";
  EXPECT_TRUE(rows[0].throughput);
  EXPECT_EQ(rows[1].status, "checksum mismatch") << "no pass was verified whose answers it gave";
  EXPECT_EQ(rows[2].status, "checksum mismatch") << "its second pass breaks its word";
}

TEST(WorkerSurvival, AnHonestContestantIsMeasuredInEveryColumn) {
  const std::vector<measurement::ResultRow> rows = rows_of({"honest"}, true);
  ASSERT_EQ(rows.size(), 2U);
  for (const measurement::ResultRow& row : rows) {
    EXPECT_EQ(row.status, "ok");
    EXPECT_EQ(row.steps, steps);
    ASSERT_TRUE(row.counts && row.throughput && row.latency && row.work && row.build_ms && row.bytes);
    EXPECT_EQ(row.counts->judged, steps);
    EXPECT_FALSE(row.violates_guarantee());
    EXPECT_EQ(row.throughput->repetitions, 2U);
    EXPECT_GT(row.throughput->ns_per_query_min, 0);
    EXPECT_LE(row.throughput->ns_per_query_min, row.throughput->ns_per_query);
    EXPECT_GT(row.throughput->ns_per_query_first_pass, 0);
    EXPECT_GT(row.latency->p50, 0);
    EXPECT_LE(row.latency->p50, row.latency->max);
    EXPECT_EQ(row.work->mean, 80) << "every triangle of the icosphere, every step";
    EXPECT_EQ(row.work->max, 80U);
    EXPECT_GE(*row.first_answer_ms, *row.build_ms);
  }
}

}  // namespace
}  // namespace touchmark::bench::workers

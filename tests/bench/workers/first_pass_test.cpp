// What the first pass is a pass of: a detector that no query has made anything of.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/measurement/comparison.h"
#include "bench/measurement/measurement.h"
#include "bench/meshes/meshes.h"
#include "tests/bench/workers/hostile_roster.h"

namespace touchmark::bench::workers {
namespace {

/// Two motions, of which each comes by much of the mesh, and the first again.
workload::Workload workload() {
  workload::Selection selection;
  selection.radius = {1, true};
  return workload::make_workload("torus:20x10", meshes::load_mesh("torus:20x10"), selection,
                                 {"slide", "jump", "slide"}, 400);
}

class FirstPass : public testing::Test {
 protected:
  ContestantProcess process(const std::string& name) {
    return {arena_, hostile_roster().parse(name), "touchmark-hostile-worker"};
  }
  Task task(std::size_t trace) const {
    return {trace, workload::Query::nearest, workload_.traces[trace].size()};
  }

  const workload::Workload workload_ = workload();
  const SharedArena arena_{workload_, {}};
  const measurement::Effort effort_{1, 0, 1e9, 1e6};
  const workload::SamplePlan plan_{
      400, std::vector<workload::Phase>(workload::SamplePlan::blocks_in(400), workload::Phase::free), 1};
};

TEST_F(FirstPass, CostsMoreOnceUnmade) {
  ContestantProcess later = process("makes-later");
  const Timed fresh = later.ask(request::FirstPass{task(0)});
  EXPECT_LT(later.ask(request::FirstPass{task(0)}).work.total(), fresh.work.total())
      << "or nothing was left to be made";
  later.rebuild_if_lazy();
  const Timed again = later.ask(request::FirstPass{task(0)});
  EXPECT_EQ(again.work.total(), fresh.work.total());
  EXPECT_EQ(again.checksum, fresh.checksum);
}

TEST_F(FirstPass, OfACaseComesAfterNoOtherQuery) {
  const oracle::Oracle oracle(workload_.mesh);
  ground_truth::GroundTruths truths(oracle, workload_.traces[0]);
  ContestantProcess later = process("makes-later");
  measurement::Measurement slide(workload_, arena_, effort_, later, 0, workload::Query::nearest, plan_);
  slide.calibrate();
  slide.verify(truths);
  slide.repetition();
  later.ask(request::Answer{task(1)});
  const std::uint64_t once_made = later.ask(request::Answer{task(1)}).work.total();
  slide.first_pass();
  EXPECT_GT(later.ask(request::Answer{task(1)}).work.total(), once_made)
      << "what another motion had made was still there";
  EXPECT_EQ(slide.row().status, "ok");
}

TEST_F(FirstPass, IsWhatTheWorkOfARowCounts) {
  ContestantProcess later = process("makes-later");
  const Work fresh = later.ask(request::FirstPass{task(0)}).work;
  measurement::Effort verify_only = effort_;
  verify_only.repetitions = 0;
  measurement::Comparison comparison(hostile_roster(), workload_, {hostile_roster().parse("makes-later")}, {},
                                     verify_only, 1);
  std::vector<measurement::ResultRow> rows;
  comparison.run_all({workload::Query::nearest}, rows);
  ASSERT_EQ(rows.size(), 3U);
  for (const std::size_t trace : {0U, 2U}) {
    ASSERT_TRUE(rows[trace].work);
    EXPECT_EQ(rows[trace].work->total.total(), fresh.total()) << "the course that came before shows";
  }
}

TEST_F(FirstPass, BuildsNothingAnewThatMakesAllAtOnce) {
  // It counts its builds in a file, where a short build's repetitions count too.
  const std::string counter = testing::TempDir() + "touchmark-builds-" + std::to_string(getpid());
  setenv("TOUCHMARK_TEST_COUNTER", counter.c_str(), 1);
  const oracle::Oracle oracle(workload_.mesh);
  ground_truth::GroundTruths truths(oracle, workload_.traces[0]);
  ContestantProcess moody = process("moody");
  measurement::Measurement slide(workload_, arena_, effort_, moody, 0, workload::Query::nearest, plan_);
  slide.calibrate();
  const std::uintmax_t builds = std::filesystem::file_size(counter);
  EXPECT_GT(builds, 0U);
  slide.verify(truths);
  slide.first_pass();
  EXPECT_EQ(std::filesystem::file_size(counter), builds);
  unsetenv("TOUCHMARK_TEST_COUNTER");
  std::filesystem::remove(counter);
}

}  // namespace
}  // namespace touchmark::bench::workers

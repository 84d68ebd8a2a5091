/// `touchmark plan`, `run` and `merge` from the outside.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::vector<std::string> ids_in(const Json& manifest) {
  std::vector<std::string> ids;
  for (const Json& planned : manifest.at("scenes")) {
    for (const Json& job : planned.at("jobs")) ids.push_back(job.at("id"));
  }
  return ids;
}

class Sweep : public testing::Test {
 protected:
  /// Two meshes, two trajectories and two detectors: eight jobs in four scenes.
  Json plan(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{"plan",
                                     "--mesh",
                                     "cube",
                                     "--mesh",
                                     "icosphere:1",
                                     "--trajectory",
                                     "slide",
                                     "--trajectory",
                                     "jump",
                                     "--detector",
                                     "aabb-tree",
                                     "--detector",
                                     "grid-group:lookup=scan",
                                     "--steps",
                                     "40"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run_touchmark(command);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    folder_.file("sweep.json", outcome.out);
    return Json::parse(outcome.out);
  }
  Outcome run(const std::string& shard, const std::string& out) const {
    return run_touchmark(
        {"run", "--manifest", folder_.file("sweep.json"), "--shard", shard, "--out", folder_.file(out)});
  }
  Outcome merge(const std::vector<std::string>& folders, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{"merge", "--out", folder_.file("merged.csv")};
    for (const std::string& name : folders) command.push_back(folder_.file(name));
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  /// A copy of a folder of jobs, as another machine would have left it.
  void pretend_other_machine(const std::string& from, const std::string& to) const {
    fs::create_directory(folder_.file(to));
    for (const auto& entry : fs::directory_iterator(folder_.file(from))) {
      Json job = Json::parse(content_of(entry.path()));
      job["machine"] = "00000000000000ff";
      job["run"]["cpu"] = "Another processor";
      job["row"]["run_id"] = "20200101T000000Z-0000";
      folder_.file(to + "/" + entry.path().filename().string(), job.dump());
    }
  }
  std::string merged() const { return folder_.file("merged.csv"); }

  TemporaryFolder folder_;
};

TEST_F(Sweep, PlansTheSameIdsAgainAndOthersForWhateverDiffers) {
  const std::vector<std::string> ids = ids_in(plan());
  EXPECT_EQ(ids.size(), 8U);
  std::set<std::string> all(ids.begin(), ids.end());
  EXPECT_EQ(all.size(), 8U);
  EXPECT_EQ(ids_in(plan()), ids);
  std::size_t expected = all.size();
  for (const std::vector<std::string>& difference : {std::vector<std::string>{"--radius", "2%"},
                                                     {"--reach", "inf"},
                                                     {"--seed", "2"},
                                                     {"--query", "touches"},
                                                     {"--effort", "quick"},
                                                     {"--effort", "accuracy"},
                                                     {"--normalize"}}) {
    const std::vector<std::string> others = ids_in(plan(difference));
    all.insert(others.begin(), others.end());
    expected += 8;
    EXPECT_EQ(all.size(), expected) << difference.front();
  }
}

TEST_F(Sweep, CrossesAllParameters) {
  const Json manifest =
      plan({"--radius", "1%", "--radius", "2%", "--seed", "1", "--seed", "2", "--query", "all"});
  EXPECT_EQ(manifest["scenes"].size(), 2U * 2 * 2 * 2 * 3);
  EXPECT_EQ(ids_in(manifest).size(), 96U);
  EXPECT_EQ(ids_in(plan({"--mesh", "cube"})).size(), 8U) << "a mesh named twice is planned once";
}

TEST_F(Sweep, RunsEachJobOnceOverItsShardsAndAllRivalsOfASceneTogether) {
  const Json manifest = plan({"--effort", "quick"});
  ASSERT_EQ(run("1/2", "a").status, 0);
  const Outcome second = run("2/2", "b");
  ASSERT_EQ(second.status, 0) << second.err;
  for (const char* shard : {"a", "b"}) {
    std::map<std::string, std::set<std::string>> runs_of_mesh;
    for (const auto& entry : fs::directory_iterator(folder_.file(shard))) {
      const Json job = Json::parse(content_of(entry.path()));
      EXPECT_EQ(entry.path().stem(), job["id"].get<std::string>());
      EXPECT_EQ(job["row"]["run_id"], job["run"]["run_id"]);
      const Json& row = job["row"];
      runs_of_mesh[row["mesh"].get<std::string>() + row["trajectory"].get<std::string>()].insert(
          row["run_id"].get<std::string>() + row["detector"].get<std::string>());
    }
    EXPECT_EQ(runs_of_mesh.size(), 2U);
    for (const auto& [planned, rivals] : runs_of_mesh) EXPECT_EQ(rivals.size(), 2U) << planned;
  }
  const Outcome done = merge({"a", "b"}, {"--manifest", folder_.file("sweep.json")});
  ASSERT_EQ(done.status, 0) << done.err;
  const std::vector<Row> rows = rows_of(merged());
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(rows[0].at("mesh"), "cube");
  EXPECT_EQ(rows[1].at("options"), "lookup=scan");
  EXPECT_EQ(rows[7].at("trajectory"), "jump");
  for (const Row& row : rows) EXPECT_NE(row.at("ns_per_query"), "");
  EXPECT_EQ(run_touchmark({"validate", merged()}).status, 0);
}

TEST_F(Sweep, SkipsFinishedJobsAndRedoesBrokenOnes) {
  const std::vector<std::string> ids = ids_in(plan({"--effort", "accuracy"}));
  ASSERT_EQ(run("1/1", "jobs").status, 0);
  const auto file = [&](const std::string& id) { return folder_.file("jobs/" + id + ".json"); };
  const auto before = fs::last_write_time(file(ids[0]));
  fs::remove(file(ids[1]));
  folder_.file("jobs/" + ids[2] + ".json", content_of(file(ids[2])).substr(0, 500));
  folder_.file("jobs/" + ids[3] + ".json", content_of(file(ids[4])));
  const Outcome again = run("1/1", "jobs");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("3 jobs done, 5 were finished before"), std::string::npos) << again.err;
  EXPECT_EQ(fs::last_write_time(file(ids[0])), before);
  for (const std::string& id : ids) EXPECT_EQ(Json::parse(content_of(file(id)))["id"], id);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.file("jobs")), fs::directory_iterator()), 8);
}

TEST_F(Sweep, DoesNotMixTimesOfDifferentMachines) {
  plan({"--effort", "quick"});
  ASSERT_EQ(run("1/2", "here").status, 0);
  ASSERT_EQ(run("2/2", "there-really").status, 0);
  pretend_other_machine("there-really", "there");
  const Outcome refused = merge({"here", "there"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("times of 2 machines"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("Another processor"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(merged()));

  EXPECT_EQ(merge({"here", "there"}, {"--machine", "00000000000000ff"}).status, 0);
  EXPECT_EQ(rows_of(merged()).size(), 4U);

  ASSERT_EQ(merge({"here", "there"}, {"--accuracy-only"}).status, 0);
  const std::vector<Row> rows = rows_of(merged());
  EXPECT_EQ(rows.size(), 8U);
  for (const Row& row : rows) {
    for (const char* time : {"ns_per_query", "ns_p99", "build_ms", "heap_bytes", "cpu_ns_per_query"}) {
      EXPECT_EQ(row.at(time), "") << time;
    }
    for (const char* kept : {"missed", "max_distance_error", "work_max", "answers_checksum"}) {
      EXPECT_NE(row.at(kept), "") << kept;
    }
  }
  EXPECT_EQ(run_touchmark({"validate", merged()}).status, 0);
}

TEST_F(Sweep, MergesAccuracyOfMachinesFreely) {
  plan({"--effort", "accuracy"});
  ASSERT_EQ(run("1/2", "here").status, 0);
  ASSERT_EQ(run("2/2", "there-really").status, 0);
  pretend_other_machine("there-really", "there");
  EXPECT_EQ(merge({"here", "there"}).status, 0);
  EXPECT_EQ(rows_of(merged()).size(), 8U);
}

TEST_F(Sweep, MergesACopyOnceAndTwoTimingsOfAJobNever) {
  plan({"--effort", "quick"});
  ASSERT_EQ(run("1/4", "a").status, 0);
  fs::copy(folder_.file("a"), folder_.file("b"));
  EXPECT_EQ(merge({"a", "b"}).status, 0);
  EXPECT_EQ(rows_of(merged()).size(), 2U);
  ASSERT_EQ(run("1/4", "c").status, 0);
  const Outcome refused = merge({"a", "c"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("timed twice"), std::string::npos) << refused.err;
}

TEST_F(Sweep, SaysWhatIsMissing) {
  plan({"--effort", "accuracy"});
  ASSERT_EQ(run("1/2", "half").status, 0);
  const Outcome refused = merge({"half"}, {"--manifest", folder_.file("sweep.json")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("4 of the manifest's 8 jobs are missing"), std::string::npos) << refused.err;
}

TEST_F(Sweep, RunsNothingThatIsNotWhatWasPlanned) {
  const Json manifest = plan({"--effort", "accuracy"});
  const auto complaint = [&](const std::string& pointer, const Json& value) {
    Json changed = manifest;
    changed[Json::json_pointer(pointer)] = value;
    folder_.file("sweep.json", changed.dump());
    const Outcome outcome = run("1/1", "jobs");
    EXPECT_EQ(outcome.status, 2) << pointer;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(complaint("/version", "9.9").find("9.9"), std::string::npos);
  EXPECT_NE(complaint("/scenes/0/steps", 0).find("/scenes/0/steps \"0\""), std::string::npos);
  EXPECT_NE(complaint("/scenes/0/jobs/0/detector", "nobody").find("nobody"), std::string::npos);
  EXPECT_NE(complaint("/scenes/0/jobs/0/detector", "brute-force").find("does not have the id"),
            std::string::npos);
  EXPECT_NE(complaint("/scenes/0/mesh", "icosphere:2").find("not the one that was planned"),
            std::string::npos);
  EXPECT_NE(complaint("/scenes/0/radius", "3%").find("not the one that was planned"), std::string::npos);
}

TEST_F(Sweep, NamesWhatIsWrongOnTheCommandLine) {
  plan();
  const std::string manifest = folder_.file("sweep.json"), jobs = folder_.file("jobs");
  for (const char* shard : {"0/2", "3/2", "1", "x/2", "1/", "-1/2"}) {
    expect_bad_input({"run", "--manifest", manifest, "--out", jobs, "--shard", shard}, {"--shard", shard});
  }
  expect_bad_input({"run", "--manifest", folder_.file("absent.json"), "--out", jobs}, {"absent.json"});
  expect_bad_input({"run", "--manifest", folder_.file("text.json", "no json"), "--out", jobs},
                   {"text.json:1"});
  expect_bad_input({"plan", "--mesh", "cube", "--query", "near"}, {"--query", "near"});
  expect_bad_input({"plan", "--mesh", "cube", "--effort", "some"}, {"effort", "some"});
  expect_bad_input({"plan", "--mesh", "no-such-mesh"}, {"no-such-mesh"});
  expect_bad_input({"merge", folder_.file("nowhere"), "--out", merged()}, {"nowhere"});
  expect_bad_input({"merge", folder_.path(), "--out", merged()}, {"no finished job"});
}

}  // namespace
}  // namespace touchmark::bench::cli

/// `touchmark servo` as a user runs it. No time is demanded of this machine: only what must hold at any
/// speed.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

class Servo : public testing::Test {
 protected:
  Outcome servo(const Fields& more) const {
    Fields command{"servo", "--mesh", "icosphere:3", "--out", folder_.file("out")};
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  std::vector<Row> read(const std::string& name) const { return rows_of(folder_.file("out/" + name)); }
  void expect_valid() const {
    const Outcome outcome = run_touchmark({"validate", folder_.file("out")});
    EXPECT_EQ(outcome.status, 0) << outcome.out;
  }
  TemporaryFolder folder_;
};

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  return text.substr(text.rfind('\n', end) + 1, end - text.rfind('\n', end));
}

TEST_F(Servo, ASecondEndsWithItsVerdictAsLastLineAndStatus) {
  const Outcome outcome =
      servo({"--seconds", "1", "--detector", "sphere-cluster", "--detector", "grid-group", "--load", "none"});
  const std::map<std::string, int> statuses{{"holds", 0}, {"does not hold", 1}, {"inconclusive", 4}};
  const std::string verdict = last_line(outcome.out);
  ASSERT_TRUE(statuses.contains(verdict)) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.status, statuses.at(verdict));
  const auto rows = read("servo.csv");
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("status"), "ok");
    EXPECT_EQ(row.at("ticks"), "1000");
    EXPECT_EQ(row.at("idle_ticks"), "1000");
    EXPECT_EQ(row.at("missed"), "0") << "answers";
    EXPECT_NE(row.at("query_ns_max"), "");
  }
  EXPECT_NE(outcome.out.find("1000 ticks at 1000 Hz"), std::string::npos) << outcome.out;
  expect_valid();
}

TEST_F(Servo, FollowsAHandWhereNoMotionIsNamed) {
  for (const Fields& asked : {Fields{"--mesh", "icosphere:2"},
                              {"--mesh", "icosphere:2", "--proxy"},
                              {"--scene", "heap:3"},
                              {"--scene", "heap:3", "--proxy"}}) {
    Fields command{"servo", "--seconds", "0.1", "--out", folder_.file("out")};
    command.insert(command.end(), asked.begin(), asked.end());
    run_touchmark(command);
    EXPECT_EQ(read("servo.csv").at(0).at("trajectory"), "hand");
    expect_valid();
  }
}

/// Keeps this process, and the programs that it starts, on one of its cores.
class OneCore {
 public:
  OneCore() {
    EXPECT_EQ(sched_getaffinity(0, sizeof before_, &before_), 0);
    unsigned core = 0;
    while (!CPU_ISSET(core, &before_)) ++core;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(core, &one);
    EXPECT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  }
  ~OneCore() { sched_setaffinity(0, sizeof before_, &before_); }
  bool was_alone() const { return CPU_COUNT(&before_) == 1; }

 private:
  cpu_set_t before_;
};

TEST_F(Servo, OtherCoresLoadTheMemoryWhereNoLoadIsNamed) {
  if (OneCore().was_alone()) GTEST_SKIP() << "there is no other core";
  EXPECT_EQ(servo({"--seconds", "0.1"}).err, "");
  EXPECT_EQ(read("servo.csv").at(0).at("load"), "memory");
  EXPECT_NE(content_of(folder_.file("out/run.json")).find("\"load\": \"memory\""), std::string::npos);
  expect_valid();
}

TEST_F(Servo, WithOneCoreNothingIsLoadedAndALineSaysSo) {
  const OneCore one_core;
  EXPECT_EQ(servo({"--seconds", "0.1"}).err,
            "touchmark: load none: there is no other core that this program may use\n");
  EXPECT_EQ(read("servo.csv").at(0).at("load"), "none");
  expect_valid();
  EXPECT_EQ(servo({"--seconds", "0.1", "--load", "none"}).err, "");
  EXPECT_EQ(read("servo.csv").at(0).at("load"), "none");
  expect_bad_input({"servo", "--load", "memory"}, {"--load memory", "no other core"});
}

TEST_F(Servo, TheCommandOfAWorstTickAnswersItsStepAgain) {
  for (const char* rate : {"1000", "2500"}) {
    servo({"--seconds", "0.2", "--rate", rate});
    const auto rows = read("servo_worst.csv");
    ASSERT_EQ(rows.size(), 10u);
    for (const std::size_t i : {0u, 9u}) {
      const std::string command = rows[i].at("command"), step = rows[i].at("step");
      ASSERT_TRUE(command.starts_with("touchmark query ")) << command;
      const Outcome again = run_program_at(
          {"/bin/sh", "-c", TOUCHMARK_PROGRAM + command.substr(std::string("touchmark").size())});
      EXPECT_EQ(again.status, 0) << again.err;
      EXPECT_NE(again.out.find("\n" + step + ","), std::string::npos) << command << again.out;
    }
  }
}

TEST_F(Servo, ADetectorThatNeedsLongerThanThePeriodDoesNotHold) {
  // A query looks at 81,920 triangles, which no processor does in 100 us.
  const Outcome outcome =
      run_touchmark({"servo", "--mesh", "icosphere:6", "--steps", "3", "--detector", "brute-force", "--rate",
                     "10000", "--seconds", "1", "--out", folder_.file("out")});
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
  EXPECT_EQ(last_line(outcome.out), "does not hold");
  EXPECT_EQ(read("servo.csv").at(0).at("verdict"), "does not hold");
  expect_valid();
}

TEST_F(Servo, AnOverrunIsEndedAndIsTheMachinesWhereNothingWasAsked) {
  // More other work than a tick has time for: the loop never sleeps, nor does the idle one.
  const Outcome outcome = servo({"--seconds", "3", "--work", "1500"});
  EXPECT_EQ(outcome.status, 4) << outcome.out << outcome.err;
  EXPECT_EQ(read("servo.csv").at(0).at("status"), "overrun");
  EXPECT_NE(outcome.out.find("no time to sleep"), std::string::npos);
  expect_valid();
}

TEST_F(Servo, StepsAProxyAndJudgesEveryStep) {
  const Outcome outcome = servo({"--proxy", "--trajectory", "approach", "--method", "certified", "--friction",
                                 "0.3,0.2", "--stiffness", "500", "--seconds", "0.5"});
  EXPECT_NE(outcome.status, 2) << outcome.err;
  const auto rows = read("servo.csv");
  ASSERT_EQ(rows.size(), 1u);
  const auto& row = rows.front();
  EXPECT_EQ(row.at("status"), "ok");
  EXPECT_EQ(row.at("query"), "proxy");
  EXPECT_EQ(row.at("proxy"), "certified");
  EXPECT_EQ(row.at("ticks"), "500");
  EXPECT_GE(std::stoi(row.at("judged_ticks")) + std::stoi(row.at("lost_ticks")), 500);
  EXPECT_EQ(row.at("crossings") + row.at("violations"), "00");
  EXPECT_GT(std::stoi(row.at("contact_ticks")), 0) << "the approach presses";
  EXPECT_EQ(row.at("stuck_ticks"), "0");
  const std::string run = content_of(folder_.file("out/run.json"));
  for (const char* member :
       {"\"query\": \"proxy\"", "\"stiffness_n_per_m\": 500", "\"dynamic_friction\": 0.2"})
    EXPECT_NE(run.find(member), std::string::npos) << member << run;
  expect_valid();
}

TEST_F(Servo, ABoundOfWorkEndsStepsAndNeverTheProof) {
  servo({"--proxy", "--trajectory", "slide", "--max-work", "40", "--seconds", "0.3"});
  const auto row = read("servo.csv").at(0);
  EXPECT_EQ(row.at("status"), "ok");
  EXPECT_EQ(row.at("max_work"), "40");
  EXPECT_GT(std::stoi(row.at("unfinished_ticks")), 0);
  EXPECT_EQ(row.at("crossings") + row.at("violations"), "00");
  EXPECT_NE(content_of(folder_.file("out/run.json")).find("\"max_work\": 40"), std::string::npos);
  expect_valid();
}

// A tick every 20 ms: a second has 50.
TEST_F(Servo, EmptiesTheCachesBeforeEachTick) {
  const Outcome outcome = servo({"--evict", "--seconds", "1"});
  EXPECT_NE(outcome.status, 2) << outcome.err;
  const auto row = read("servo.csv").at(0);
  EXPECT_EQ(row.at("evicted"), "1");
  EXPECT_EQ(row.at("ticks"), "50");
  EXPECT_NE(outcome.out.find("a tick every 20 ms"), std::string::npos) << outcome.out;
  expect_valid();
}

TEST_F(Servo, AProxyBeginsOffTheSurfaceWhereNoGoalIsFree) {
  servo({"--proxy", "--trajectory", "slide", "--seconds", "0.2"});
  const auto row = read("servo.csv").at(0);
  EXPECT_EQ(row.at("stuck_ticks"), "0");
  EXPECT_EQ(row.at("contact_ticks"), row.at("judged_ticks"));
}

// Bodies move in each tick, there and back with the steps; every timed answer must be the verified one.
TEST_F(Servo, RunsOverBodiesThatMove) {
  const Outcome outcome = run_touchmark({"servo", "--scene", "heap:30:motion=all", "--radius", "0.5%",
                                         "--detector", "sphere-cluster", "--detector", "looped", "--seconds",
                                         "0.3", "--steps", "100", "--out", folder_.file("out")});
  EXPECT_NE(outcome.status, 2) << outcome.err;
  const auto rows = read("servo.csv");
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("status"), "ok") << row.at("detector");
    EXPECT_EQ(row.at("mesh"), "heap:30:motion=all");
    EXPECT_EQ(row.at("ticks"), "300");
    EXPECT_EQ(row.at("missed") + row.at("false_contacts") + row.at("wrong_triangle"), "000");
  }
  expect_valid();
}

TEST_F(Servo, StepsAProxyAmongBodiesThatMoveAndJudgesEveryStep) {
  const Outcome outcome =
      run_touchmark({"servo", "--proxy", "--scene", "heap:30:motion=all", "--radius", "0.5%", "--detector",
                     "sphere-cluster", "--detector", "grid-group", "--detector", "looped", "--seconds", "0.3",
                     "--steps", "100", "--out", folder_.file("out")});
  EXPECT_EQ(outcome.status, 1) << outcome.err << "looped answers no contacts, and guides no proxy";
  const auto rows = read("servo.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[2].at("status"), "unsupported");
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& row = rows[i];
    EXPECT_EQ(row.at("status"), "ok") << row.at("detector");
    EXPECT_EQ(row.at("mesh"), "heap:30:motion=all");
    EXPECT_EQ(row.at("query"), "proxy");
    EXPECT_EQ(row.at("ticks"), "300");
    EXPECT_NE(row.at("query_ns_max"), "");
    EXPECT_GE(std::stoi(row.at("judged_ticks")) + std::stoi(row.at("lost_ticks")), 300);
    EXPECT_EQ(row.at("crossings") + row.at("violations"), "00");
    EXPECT_GT(std::stoi(row.at("contact_ticks")), 0) << "a hand presses";
    EXPECT_NE(outcome.out.find("none of " + row.at("judged_ticks") + " steps crossed"), std::string::npos)
        << outcome.out;
  }
  expect_valid();
}

TEST_F(Servo, ADetectorThatGuidesNoProxyIsUnsupported) {
  const Outcome outcome = servo({"--proxy", "--detector", "fcl", "--seconds", "0.1"});
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_EQ(read("servo.csv").at(0).at("status"), "unsupported");
  expect_valid();
}

TEST_F(Servo, RefusesWhatItCannotDo) {
  expect_bad_input({"servo", "--proxy", "--query", "touches"}, {"--query", "--proxy"});
  expect_bad_input({"servo", "--proxy", "--reach", "1"}, {"--reach", "--proxy"});
  expect_bad_input({"servo", "--proxy", "--scene", "heap:3", "--shading", "1"},
                   {"--scene", "--shading", "excludes"});
  expect_bad_input({"servo", "--scene", "heap:3", "--mesh", "cube"}, {"--scene", "--mesh"});
  expect_bad_input({"servo", "--scene", "heap:3", "--rate", "500"}, {"--rate", "500", "hand", "1000"});
  expect_bad_input({"servo", "--stiffness", "10"}, {"--stiffness", "--proxy"});
  expect_bad_input({"servo", "--proxy", "--method", "penalty"}, {"penalty", "certified"});
  expect_bad_input({"servo", "--proxy", "--method", "certifed"}, {"certifed", "certified"});
  expect_bad_input({"servo", "--proxy", "--friction", "0.1,0.5"}, {"--friction", "static"});
  expect_bad_input({"servo", "--proxy", "--shading", "2"}, {"--shading", "2"});

  expect_bad_input({"servo", "--rate", "0"}, {"--rate"});
  expect_bad_input({"servo", "--seconds", "none"}, {"--seconds", "none"});
  expect_bad_input({"servo", "--load", "disk"}, {"--load", "disk", "memory"});
  expect_bad_input({"servo", "--work", "-1"}, {"--work"});
  expect_bad_input({"servo", "--cpu", "1000"}, {"--cpu", "1000"});
  expect_bad_input({"servo", "--trajectory", "slide", "--trajectory", "hover"}, {"--trajectory", "hover"});
}

TEST_F(Servo, ValidateFindsARowThatContradictsItself) {
  servo({"--proxy", "--seconds", "0.1"});
  const std::string path = folder_.file("out/servo.csv"), good = content_of(path);
  const auto with = [&](const std::map<std::string, std::string>& damage) {
    support::CsvReader reader(path);
    Fields header, fields;
    reader.next(header);
    reader.next(fields);
    for (const auto& [column, value] : damage)
      fields.at(static_cast<std::size_t>(std::find(header.begin(), header.end(), column) - header.begin())) =
          value;
    std::string text = good.substr(0, good.find('\n') + 1);
    for (std::size_t i = 0; i < fields.size(); ++i) text += (i > 0 ? "," : "") + fields[i];
    return text + "\n";
  };
  const auto expect_fault = [&](const std::map<std::string, std::string>& damage, const std::string& told) {
    folder_.file("out/servo.csv", with(damage));
    const Outcome outcome = run_touchmark({"validate", path});
    EXPECT_EQ(outcome.status, 1) << told;
    EXPECT_NE(outcome.out.find(told), std::string::npos) << told << "\n" << outcome.out;
    folder_.file("out/servo.csv", good);
  };
  expect_valid();
  for (const auto& [column, value] :
       std::vector<std::pair<std::string, std::string>>{{"ticks", "101"},
                                                        {"missed_ticks", "200"},
                                                        {"longest_miss_run", "99"},
                                                        {"miss_rate_below", "0.5"},
                                                        {"latency_ns_p99", "0"},
                                                        {"verdict", "perhaps"},
                                                        {"load", "disk"},
                                                        {"query", "nearest"},
                                                        {"proxy", "penalty"},
                                                        {"judged_ticks", "1"},
                                                        {"crossings", "1000000"},
                                                        {"run_id", "another"}})
    expect_fault({{column, value}}, column);
  expect_fault({{"violations", "1"}, {"verdict", "inconclusive"}},
               "does not follow from the crossings and violations");
}

}  // namespace
}  // namespace touchmark::bench::cli

/// `touchmark choose` as a user runs it. No time is demanded of this machine: limits are ones that any
/// processor keeps, or none.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/files/csv_reader.h"
#include "bench/support/table.h"
#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

class Choose : public testing::Test {
 protected:
  /// Any processor answers within a whole tick at 10 Hz.
  Outcome choose(const Fields& more, const std::string& rate = "10",
                 const std::string& share = "100%") const {
    Fields command{"choose", "--mesh", "icosphere:2", "--quick", "--steps", "300",
                   "--rate", rate,     "--share",     share,     "--out",   folder_.file("out")};
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  /// The fields of that column, a row each.
  Fields column(const std::string& name) const {
    Fields values;
    for (const Fields& record : fields_in(folder_.file("out/choose.csv"), {name}))
      values.push_back(record[0]);
    return values;
  }
  void expect_valid() const {
    const Outcome outcome = run_touchmark({"validate", folder_.file("out")});
    EXPECT_EQ(outcome.status, 0) << outcome.out;
  }
  TemporaryFolder folder_;
};

TEST_F(Choose, RecommendsOneThatIsRightAndPrintsItsCode) {
  const Outcome outcome =
      choose({"--trajectory", "slide", "--detector", "sphere-cluster", "--detector", "aabb-tree"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("\nrecommended: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nrunner-up: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("#include <touchmark/"), std::string::npos) << outcome.out;
  EXPECT_EQ(column("why_not"), (Fields{"", ""}));
  EXPECT_EQ(column("wrong_answers"), (Fields{"0", "0"}));
  EXPECT_NE(outcome.out.find(content_of(folder_.file("out/choose.cpp"))), std::string::npos);
  expect_valid();
}

TEST_F(Choose, OfAProxyPrintsAClassThatStepsItWithinABound) {
  const Outcome outcome = choose({"--trajectory", "slide", "--proxy"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find(".max_work = 6000"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("proxy_.step(hand, session_)"), std::string::npos) << outcome.out;
  const Fields detectors = column("detector");
  EXPECT_EQ(std::find(detectors.begin(), detectors.end(), "aabb-tree"), detectors.end());
  expect_valid();
}

TEST_F(Choose, OfAProxyRefusesWhatKeepsToNoBound) {
  for (const auto& [more, way_out] :
       {std::pair{Fields{"--detector", "aabb-tree"}, "sphere-cluster and grid-group do"},
        std::pair{Fields{"--query", "touches"}, "leave out --query"}}) {
    Fields command{"--trajectory", "slide", "--proxy"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = choose(command);
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_NE(outcome.err.find(way_out), std::string::npos) << outcome.err;
  }
}

TEST_F(Choose, SaysWhyNoneHoldsAndEndsWithStatus1) {
  const Outcome outcome = choose({"--trajectory", "slide", "--detector", "sphere-cluster", "--detector",
                                  "sphere-cluster:lookup=scan,precise=false", "--memory", "1KB"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("none holds"), std::string::npos) << outcome.out;
  EXPECT_EQ(column("why_not"), (Fields{"over the memory", "claims no exactness"}));
  EXPECT_EQ(column("rank"), (Fields{"", ""}));
  expect_valid();
}

TEST_F(Choose, NoQueryFitsIntoAHundredMillionthOfATick) {
  const Outcome outcome = choose({"--trajectory", "slide", "--detector", "aabb-tree"}, "100000", "1e-6%");
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
  EXPECT_EQ(column("why_not"), (Fields{"over the share at p99.9"}));
}

TEST_F(Choose, MeasuresOursAndTheExactRivalsOnSeveralMotions) {
  const Outcome outcome =
      choose({"--query", "touches", "--trajectory", "slide", "--trajectory", "fast-slide"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const Fields detectors = column("detector");
  for (const char* ours : {"brute-force", "aabb-tree", "grid-group", "sphere-cluster"})
    EXPECT_NE(std::find(detectors.begin(), detectors.end(), ours), detectors.end()) << ours;
  EXPECT_NE(outcome.out.find("motions: slide, fast-slide\n"), std::string::npos) << outcome.out;
  for (const std::string& guarantee : column("guarantee")) EXPECT_EQ(guarantee, "exact");
  expect_valid();
}

TEST_F(Choose, BeginsWithAHandWhereNoMotionIsGiven) {
  const Outcome outcome = choose({"--detector", "aabb-tree"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("motions: hand, approach, hover, cross\n"), std::string::npos) << outcome.out;
  EXPECT_EQ(column("motions"), (Fields{"4"}));
}

TEST_F(Choose, TakesAMotionByItsTimes) {
  std::string csv = "time_s,x,y,z\n";
  for (int i = 0; i <= 20; ++i)
    csv += std::to_string(i * 0.05) + ",0,0," + std::to_string(1.2 - i * 0.01) + "\n";
  const Outcome outcome =
      choose({"--motion", folder_.file("hand.csv", csv), "--detector", "aabb-tree"}, "5", "100%");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(column("judged"), (Fields{"6"})) << "a second at 5 Hz, both ends included";
}

/// Seconds along a line, all near the mesh or all far from it.
std::string motion_at(double height) {
  std::string csv = "time_s,x,y,z\n";
  for (int i = 0; i <= 20; ++i)
    csv += std::to_string(i * 0.05) + ",0,0," + std::to_string(height - i * 0.001) + "\n";
  return csv;
}

class ChooseWithinMinutes : public Choose {
 protected:
  Outcome choose_hostile(const std::string& minutes, const Fields& more) const {
    Fields command{TOUCHMARK_HOSTILE_PROGRAM,
                   "choose",
                   "--mesh",
                   "icosphere:2",
                   "--quick",
                   "--rate",
                   "20",
                   "--share",
                   "100%",
                   "--radius",
                   "5%",
                   "--out",
                   folder_.file("out"),
                   "--minutes",
                   minutes};
    command.insert(command.end(), more.begin(), more.end());
    return run_program_at(command);
  }
};

TEST_F(ChooseWithinMinutes, RecommendsFromWhatItHasMeasuredByThen) {
  const Outcome outcome = choose_hostile("0.15", {"--motion", folder_.file("near.csv", motion_at(1.05)),
                                                  "--motion", folder_.file("far.csv", motion_at(9)),
                                                  "--detector", "honest", "--detector", "hangs-far-away"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("\nrecommended: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("note: the 0.15 minutes were up: 1 of 2 motions"), std::string::npos)
      << outcome.out;
  const std::string run = content_of(folder_.file("out/run.json"));
  EXPECT_NE(run.find("\"minutes\": 0.15"), std::string::npos) << run;
  EXPECT_NE(run.find("\"finished\": false"), std::string::npos) << run;
  expect_valid();
}

TEST_F(ChooseWithinMinutes, EndsWithStatus4WhereNothingWasMeasuredByThen) {
  const Outcome outcome = choose_hostile("0.02", {"--motion", folder_.file("near.csv", motion_at(1.05)),
                                                  "--detector", "honest", "--detector", "hangs-at-build"});
  EXPECT_EQ(outcome.status, 4) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err,
            "touchmark: nothing is recommended: no candidate was measured within 0.02 minutes; allow more by "
            "--minutes\n");
}

TEST_F(Choose, ValidateFindsARowThatContradictsItself) {
  choose({"--trajectory", "slide", "--detector", "aabb-tree"});
  const std::string path = folder_.file("out/choose.csv"), good = content_of(path);
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, std::string>>{{"wrong_answers", "1"},
                                                        {"rank", "2"},
                                                        {"rank", ""},
                                                        {"margin_usual", "0.5"},
                                                        {"why_not", "over the share"},
                                                        {"run_id", "another"}}) {
    support::CsvReader reader(path);
    Fields header, fields;
    reader.next(header);
    reader.next(fields);
    fields.at(static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin())) =
        value;
    folder_.file("out/choose.csv", support::csv_line(header) + support::csv_line(fields));
    const Outcome outcome = run_touchmark({"validate", path});
    EXPECT_EQ(outcome.status, 1) << name << outcome.out;
    folder_.file("out/choose.csv", good);
  }
}

TEST_F(Choose, RefusesWhatItCannotDo) {
  expect_bad_input({"choose", "--share", "0"}, {"--share"});
  expect_bad_input({"choose", "--share", "101%"}, {"--share", "101%"});
  expect_bad_input({"choose", "--rate", "none"}, {"--rate", "none"});
  for (const char* minutes : {"0", "-1", "nan", "inf", "three"})
    expect_bad_input({"choose", "--minutes", minutes}, {"--minutes", minutes, "above 0"});
  expect_bad_input({"choose", "--memory", "much"}, {"--memory", "much", "50MB"});
  expect_bad_input({"choose", "--motion", "/nowhere.csv"}, {"/nowhere.csv"});
}

}  // namespace
}  // namespace touchmark::bench::cli

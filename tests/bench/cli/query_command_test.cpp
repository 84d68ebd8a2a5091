#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "core/geometry/sphere_triangle_sweep.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

const std::string row_header =
    "step,touching,triangle,distance,point_x,point_y,point_z,normal_x,normal_y,normal_z";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::vector<std::string> query(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"query", "--detector", "brute-force"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Above the middle of the cube's right half: over a face, away from its diagonal.
const std::string above_cube = "x,y,z\n0.25,0,1\n0.25,0,2\n";

TEST(QueryCommand, AnswersEveryStepOfACsvFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("path.csv", above_cube);
  const Outcome outcome = run_touchmark(query({"--mesh", "cube", "--trajectory", path, "--radius", "0.5"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3u) << outcome.out;
  EXPECT_EQ(lines[0], row_header);
  EXPECT_EQ(lines[1], "0,1,2,0.5,0.25,0,0.5,0,0,1");  // the first of the top's two triangles
  EXPECT_EQ(lines[2], "1,0,,,,,,,,");
}

TEST(QueryCommand, ReachSeesBeyondTheRadius) {
  const TemporaryFolder folder;
  const std::string path = folder.file("path.csv", above_cube);
  const Outcome outcome =
      run_touchmark(query({"--mesh", "cube", "--trajectory", path, "--radius", "0", "--reach", "inf"}));
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3u) << outcome.err;
  EXPECT_EQ(lines[1], "0,0,2,0.5,0.25,0,0.5,0,0,1");
  EXPECT_EQ(lines[2], "1,0,2,1.5,0.25,0,0.5,0,0,1");
}

TEST(QueryCommand, AFilesRadiusGoesBeforeTheOption) {
  const TemporaryFolder folder;
  const std::string path = folder.file("path.csv", "x,y,z,radius\n0.25,0,1,0.4\n0.25,0,1,0.6\n");
  const std::vector<std::string> lines =
      lines_of(run_touchmark(query({"--mesh", "cube", "--trajectory", path, "--radius", "9"})).out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1], "0,0,,,,,,,,");
  EXPECT_EQ(lines[2].substr(0, 4), "1,1,");
}

TEST(QueryCommand, TouchesSaysYesOrNo) {
  const TemporaryFolder folder;
  const std::string path = folder.file("path.csv", above_cube);
  const Outcome outcome =
      run_touchmark(query({"--mesh", "cube", "--trajectory", path, "--radius", "0.5", "--query", "touches"}));
  EXPECT_EQ(outcome.out, row_header + "\n0,1,,,,,,,,\n1,0,,,,,,,,\n");
}

TEST(QueryCommand, SweepAppendsTheFractionOfTheWay) {
  const TemporaryFolder folder;
  const std::string path = folder.file("path.csv", "x,y,z\n0.25,0,2.5\n0.25,0,-1.5\n");
  const Outcome outcome =
      run_touchmark(query({"--mesh", "cube", "--trajectory", path, "--radius", "0", "--query", "sweep"}));
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3u) << outcome.err;
  EXPECT_EQ(lines[0], row_header + ",fraction");
  EXPECT_EQ(lines[1], "0,0,,,,,,,,,");
  const std::vector<std::string> cells = cells_of(lines[2]);
  ASSERT_EQ(cells.size(), 11u) << lines[2];
  EXPECT_EQ(cells[1], "1");
  EXPECT_EQ(cells[2], "2");
  // The sweep stops a little before the touch, not on it; coordinates differ by at most 3, the way's by 4.
  const double rounding = 1e-12;
  EXPECT_NEAR(std::stod(cells[3]), 0, rounding);
  EXPECT_NEAR(std::stod(cells[6]), 0.5, rounding);
  EXPECT_NEAR(std::stod(cells[10]), 0.5, rounding);
}

TEST(QueryCommand, TellsTheSideInALastColumnWhereTheContestantIsAskedForIt) {
  const TemporaryFolder folder;
  const std::string path =
      folder.file("path.csv", "x,y,z\n0.25,0.1,0.25\n0.25,0.1,0.75\n0.25,0.1,0.5\n9,9,9\n");
  const Outcome outcome = run_touchmark(
      {"query", "--detector", "grid-group:side=on", "--mesh", "cube", "--trajectory", path, "--reach", "1"});
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5u) << outcome.err;
  EXPECT_EQ(lines[0], row_header + ",side");
  EXPECT_EQ(cells_of(lines[1]).at(10), "inside");
  EXPECT_EQ(cells_of(lines[2]).at(10), "outside");
  EXPECT_EQ(cells_of(lines[3]).at(10), "on_surface");
  EXPECT_EQ(lines[4], "3,0,,,,,,,,,");
}

TEST(QueryCommand, AnswersAllOfALongCsvFile) {
  const TemporaryFolder folder;
  std::string rows = "x,y,z\n";
  for (int i = 0; i < 20500; ++i) rows += "0,0,9\n";  // more than a generated trajectory has
  const std::string path = folder.file("path.csv", rows);
  EXPECT_EQ(lines_of(run_touchmark(query({"--mesh", "cube", "--trajectory", path})).out).size(), 20501u);
  EXPECT_EQ(
      lines_of(run_touchmark(query({"--mesh", "cube", "--trajectory", path, "--steps", "5"})).out).size(),
      6u);
}

TEST(QueryCommand, TheSameSeedGivesTheSameRowsAndAnotherOneOthers) {
  const std::vector<std::string> arguments =
      query({"--mesh", "torus:16x8", "--trajectory", "jump", "--steps", "50"});
  const std::string rows = run_touchmark(arguments).out;
  EXPECT_EQ(lines_of(rows).size(), 51u);
  EXPECT_EQ(run_touchmark(arguments).out, rows);
  std::vector<std::string> other = arguments;
  other.insert(other.end(), {"--reach", "inf"});
  const std::string first = run_touchmark(other).out;
  other.insert(other.end(), {"--seed", "2"});
  EXPECT_NE(run_touchmark(other).out, first);
}

TEST(QueryCommand, ACsvFileHoldsWhatStandardOutputWould) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = query({"--mesh", "icosphere:2", "--steps", "100"});
  std::vector<std::string> to_file = arguments;
  to_file.insert(to_file.end(), {"--csv", folder.file("rows.csv")});
  const Outcome outcome = run_touchmark(to_file);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(content_of(folder.file("rows.csv")), run_touchmark(arguments).out);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(QueryCommand, AFailedRunLeavesTheOldFileAndNoOther) {
  const TemporaryFolder folder;
  const std::string path = folder.file("rows.csv", "precious");
  expect_bad_input(query({"--mesh", "cube", "--steps", "0", "--csv", path}), {"--steps", "0"});
  EXPECT_EQ(content_of(path), "precious");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(QueryCommand, AWriteErrorIsStatusThree) {
  const TemporaryFolder folder;
  const std::vector<std::string> small = query({"--mesh", "cube", "--steps", "10"});
  const Outcome full = run_touchmark(small, "/dev/full");
  EXPECT_EQ(full.status, 3);
  EXPECT_NE(full.err.find("standard output"), std::string::npos) << full.err;
  for (const std::string& bad : {folder.file("missing/rows.csv"), folder.path(), std::string("/dev/full")}) {
    std::vector<std::string> arguments = small;
    arguments.insert(arguments.end(), {"--csv", bad});
    const Outcome outcome = run_touchmark(arguments);
    EXPECT_EQ(outcome.status, 3) << bad << outcome.err;
    EXPECT_NE(outcome.err.find(bad), std::string::npos) << outcome.err;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
  }
}

TEST(QueryCommand, AReaderThatLeavesIsNoError) {
  const TemporaryFolder folder;
  const std::string command = "{ '" TOUCHMARK_PROGRAM
                              "' query --detector brute-force --mesh cube --steps 20000 2> '" +
                              folder.file("err") + "'; echo $? > '" + folder.file("status") +
                              "'; } | head -n 1 > '" + folder.file("out") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT(cert-env33-c): a pipe is what is tested
  EXPECT_EQ(content_of(folder.file("out")), row_header + "\n");
  EXPECT_EQ(content_of(folder.file("status")), "0\n");
  EXPECT_EQ(content_of(folder.file("err")), "");
}

TEST(QueryCommand, AContestantThatTakesTooLongIsStatusThree) {
  const Outcome outcome = run_touchmark(
      query({"--mesh", "icosphere:6", "--steps", "20000", "--reach", "inf", "--timeout", "0.2"}));
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("brute-force did not answer: timeout"), std::string::npos) << outcome.err;
}

TEST(QueryCommand, RefusesBadInputInOneLine) {
  const TemporaryFolder folder;
  expect_bad_input({"query"}, {"--detector", "0 given"});
  expect_bad_input({"query", "--detector", "brute-force", "--detector", "grid-group"},
                   {"--detector", "2 given"});
  expect_bad_input({"query", "--detector", "brute-farce"}, {"brute-farce"});
  expect_bad_input({"query", "--detector", "brute-force:cell=1"}, {"brute-force", "cell"});
  expect_bad_input(query({"--mesh", "no-such-mesh"}), {"no-such-mesh"});
  expect_bad_input(query({"--mesh", "cube", "--mesh", "wedge"}), {"mesh"});
  expect_bad_input(query({"--mesh", "icosphere:x"}), {"icosphere:x"});
  expect_bad_input(query({"--mesh", folder.file("missing.ply")}), {"missing.ply"});
  expect_bad_input(query({"--mesh", "degenerate@scale=nan"}), {"nan"});
  expect_bad_input(query({"--mesh", "cube", "--trajectory", "glide"}), {"glide"});
  expect_bad_input(query({"--mesh", "cube", "--trajectory", "slide", "--trajectory", "jump"}),
                   {"--trajectory", "2 given"});
  expect_bad_input(query({"--mesh", "cube", "--trajectory", folder.file("bad.csv", "x,y,z\n0,0,oops\n")}),
                   {"bad.csv", "oops"});
  expect_bad_input(query({"--mesh", "cube", "--trajectory", folder.file("none.csv", "x,y,z\n")}),
                   {"none.csv"});
  expect_bad_input(query({"--mesh", "cube", "--query", "closest"}), {"--query", "closest"});
  expect_bad_input(query({"--mesh", "cube", "--query", "all"}), {"--query", "all"});
  expect_bad_input(query({"--mesh", "cube", "--radius", "-1"}), {"--radius", "-1"});
  expect_bad_input(query({"--mesh", "cube", "--radius", "nan"}), {"--radius", "nan"});
  expect_bad_input(query({"--mesh", "cube", "--reach", "far"}), {"--reach", "far"});
  expect_bad_input(query({"--mesh", "cube", "--steps", "0"}), {"--steps", "0"});
  expect_bad_input(query({"--mesh", "cube", "--steps", "1.5"}), {"--steps", "1.5"});
  expect_bad_input(query({"--mesh", "cube", "--seed", "-1"}), {"--seed", "-1"});
  expect_bad_input(query({"--mesh", "cube", "--timeout", "0"}), {"--timeout", "0"});
  expect_bad_input(query({"--mesh", "cube", "--no-such-option"}), {"--no-such-option"});
}

}  // namespace
}  // namespace touchmark::bench::cli

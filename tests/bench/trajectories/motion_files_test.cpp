// Motion and mesh files as users bring them: through the program.
#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

std::vector<std::string> query(const std::string& motion, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"query", "--detector",   "brute-force", "--mesh",   "cube", "--reach",
                                     "inf",   "--trajectory", motion,        "--radius", "0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::size_t rows_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1;  // without the header
}

/// Three rows above the cube, 2 ms apart.
const std::string plain = "time_s,x,y,z\n0,0.25,0,1\n0.002,0.25,0,2\n0.004,0.25,0,1\n";

TEST(MotionFiles, AnyDialectGivesTheSameAnswers) {
  const TemporaryFolder folder;
  const std::string expected = run_touchmark(query(folder.file("a.csv", "x,y,z\n0.25,0,1\n0.25,0,2\n"))).out;
  ASSERT_EQ(rows_in(expected), 2u);
  EXPECT_EQ(run_touchmark(query(folder.file("b.csv", "X;Y;Z\r\n0,25;0;1\r\n0,25;0;2\r\n"))).out, expected);
  EXPECT_EQ(run_touchmark(query(folder.file("c.tsv", "# px\tpy\tpz\n250\t0\t1000\n250\t0\t2000\n"),
                                {"--motion-scale", "1e-3"}))
                .out,
            expected);
  EXPECT_EQ(
      run_touchmark(query(folder.file("d.csv", "7,1,0,0.25\n7,2,0,0.25\n"), {"--columns", "z=2,y=3,x=4"}))
          .out,
      expected);
}

TEST(MotionFiles, SayOnceThatRowsAreStepsAndResampleOnRequest) {
  const TemporaryFolder folder;
  const std::string path = folder.file("hand.csv", plain);
  const Outcome rows = run_touchmark(query(path));
  EXPECT_EQ(rows.status, 0);
  EXPECT_EQ(rows.err,
            "touchmark: " + path +
                ": each row is a step, whatever the time (500 Hz, 0.004 s); --rate HZ resamples by time\n");
  EXPECT_EQ(rows_in(rows.out), 3u);
  const Outcome ticks = run_touchmark(query(path, {"--rate", "1000"}));
  EXPECT_EQ(ticks.err, "");
  EXPECT_EQ(rows_in(ticks.out), 5u);
  EXPECT_NE(ticks.out.find("\n1,0,2,1,0.25,0,0.5,0,0,1\n"), std::string::npos) << ticks.out;  // at z = 1.5
  EXPECT_EQ(rows_in(run_touchmark(query(path, {"--rate", "1000", "--steps", "2"})).out), 2u);
}

TEST(MotionFiles, RunJsonHasTimesUnitAndSpeed) {
  const TemporaryFolder folder;
  const std::string out = folder.file("out");
  const Outcome outcome = run_touchmark(
      {"bench", "--quick", "--no-cold", "--mesh", "cube", "--unit", "mm", "--detector", "brute-force",
       "--trajectory", folder.file("hand.csv", plain), "--rate", "1000", "--radius", "0.1",
       "--benchmark_repetitions=1", "--benchmark_min_time=0.001", "--out", out});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("radius 0.1 mm"), std::string::npos) << outcome.out;
  EXPECT_NE(
      outcome.out.find(
          "hand.csv (5 steps, 0.004 s at 500 Hz, resampled to 1000 Hz, mean speed 0.5 m/s, at most 0.5 m/s)"),
      std::string::npos)
      << outcome.out;
  const nlohmann::json run = nlohmann::json::parse(content_of(out + "/run.json"));
  EXPECT_EQ(run.at("unit"), "mm");
  const nlohmann::json& motion = run.at("trajectories").at(0);
  EXPECT_EQ(motion.at("steps"), 5);
  EXPECT_EQ(motion.at("rows"), 3);
  EXPECT_EQ(motion.at("duration_s"), 0.004);
  EXPECT_EQ(motion.at("rate_hz"), 500.0);
  EXPECT_EQ(motion.at("resampled_hz"), 1000.0);
  EXPECT_NEAR(motion.at("mean_speed_m_per_s").get<double>(), 0.5, 1e-12);  // 1 mm in 2 ms
  EXPECT_EQ(run_touchmark({"validate", out}).status, 0);
}

TEST(MotionFiles, MeshInfoSpeaksOfMetresWhereTheUnitIsKnown) {
  const Outcome plainly = run_touchmark({"mesh", "info", "cube"});
  EXPECT_EQ(plainly.out.find("unit"), std::string::npos) << plainly.out;
  const Outcome inches = run_touchmark({"mesh", "info", "cube", "--unit", "in"});
  EXPECT_EQ(inches.out.substr(0, plainly.out.size()), plainly.out);
  EXPECT_NE(inches.out.find("\nunit: in\nsize_x_m: 0.0254\n"), std::string::npos) << inches.out;
  EXPECT_NE(run_touchmark({"mesh", "info", "cube", "--unit", "mm", "--json"}).out.find("\"unit\": \"mm\""),
            std::string::npos);
  expect_bad_input({"mesh", "info", "cube", "--unit", "furlong"}, {"--unit", "furlong"});
}

TEST(MotionFiles, EveryCommandThatFollowsATrajectoryTakesTheOptions) {
  const TemporaryFolder folder;
  const std::string path = folder.file("hand.csv", plain);
  const std::vector<std::string> motion{"--mesh",         "cube",        "--trajectory", path,
                                        "--detector",     "brute-force", "--columns",    "x=x,y=y,z=z,time=1",
                                        "--motion-scale", "2",           "--rate",       "1000"};
  const std::vector<std::vector<std::string>> commands{
      {"verify"}, {"update", "--shares", "100%"}, {"plan", "--out", folder.file("sweep.json")}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), motion.begin(), motion.end());
    const Outcome outcome = run_touchmark(command);
    EXPECT_EQ(outcome.status, 0) << command[0] << outcome.err;
  }
  for (std::vector<std::string> command :
       {std::vector<std::string>{"bench"}, {"scale"}, {"gate", "--baseline", "none"}}) {
    command.insert(command.end(), motion.begin(), motion.end());
    command.back() = "-1";
    expect_bad_input(command, {"--rate", "-1"});
  }
  // What was planned with the options is run with them.
  const Outcome run =
      run_touchmark({"run", "--manifest", folder.file("sweep.json"), "--out", folder.file("jobs")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("1 jobs done"), std::string::npos) << run.err;
}

TEST(MotionFiles, AreLaidOnTheSurfaceByDrape) {
  const TemporaryFolder folder;
  std::string rows = "x,y,z\n";
  for (int i = 0; i < 50; ++i)  // 3 cm in waves of 4 mm, once 5 mm up
    rows += fmt::format("{},{},{}\n", 0.03 * i / 50, 0.001 * std::abs(i % 8 - 4),
                        i == 40 ? 0.005 : 0.0001 * (i % 3));
  const std::string path = folder.file("hand.csv", rows);
  const auto answers = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"query",      "--mesh",         "icosphere:3",  "--radius", "0.5%",
                                     "--detector", "sphere-cluster", "--trajectory", path};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run_touchmark(command);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  const auto touching = [](std::istringstream text) {
    std::size_t count = 0;
    for (std::string row; std::getline(text, row);) count += row.substr(row.find(',') + 1, 2) == "1," ? 1 : 0;
    return count;
  };
  const std::string contact = answers({"--drape"});
  EXPECT_EQ(rows_in(contact), 50u);
  EXPECT_EQ(touching(std::istringstream(contact)), 50u);
  EXPECT_EQ(touching(std::istringstream(answers({}))), 0u);
  EXPECT_EQ(answers({"--drape", "contact"}), contact);
  EXPECT_EQ(answers({"--drape", "--seed", "1"}), contact);
  const std::string free = answers({"--drape", "free"});
  EXPECT_LT(touching(std::istringstream(free)), 50u);
  EXPECT_GT(touching(std::istringstream(free)), 40u);
  EXPECT_EQ(answers({"--drape=free", "--steps", "50"}), free);
  EXPECT_NE(answers({"--drape", "--seed", "2"}), contact);
  EXPECT_NE(answers({"--drape", "--unit", "cm"}), contact);
  for (std::vector<std::string> command : {std::vector<std::string>{"verify"},
                                           {"servo", "--seconds", "0.05"},
                                           {"bench", "--quick", "--no-cold", "--benchmark_min_time=0.001"},
                                           {"choose", "--quick", "--minutes", "0.02"}}) {
    for (const char* word : {"--mesh", "icosphere:2", "--detector", "brute-force", "--trajectory",
                             path.c_str(), "--unit", "cm", "--drape", "free"})
      command.emplace_back(word);
    EXPECT_NE(run_touchmark(command).status, 2) << command[0];
    command.back() = "loose";
    expect_bad_input(command, {"--drape", "loose", "contact", "free"});
  }
}

TEST(MotionFiles, BadInputIsOneLine) {
  const TemporaryFolder folder;
  const std::string uneven =
      folder.file("uneven.csv", "time_s,x,y,z\n0,0,0,0\n0.001,1,0,0\n0.002,2,0,0\n0.009,3,0,0\n");
  expect_bad_input(query(uneven), {"uneven.csv:5:", "time_s", "0.007 s", "--rate"});
  expect_bad_input(query(folder.file("back.csv", "t,x,y,z\n1,0,0,0\n1,0,0,0\n")),
                   {"back.csv:3:", "'1'", "not after"});
  expect_bad_input(query(folder.file("none.csv", "x,y,z\n0,0,0\n"), {"--rate", "1000"}),
                   {"none.csv:1:", "--rate"});
  expect_bad_input(query("slide", {"--rate", "1000"}), {"--rate", "no --trajectory"});
  expect_bad_input(query("slide", {"--motion-scale", "2"}), {"--motion-scale", "no --trajectory"});
  expect_bad_input(query("hand", {"--drape"}), {"--drape", "no --trajectory"});
  expect_bad_input(query(folder.file("huge.csv", "x,y,z\n0,0,0\n1e200,0,0\n"), {"--drape"}),
                   {"huge.csv", "--drape", "too large"});
  expect_bad_input(query("hand:flat"), {"hand:flat", "contact", "free", "tap"});
  expect_bad_input(query(folder.file("long.csv", "t,x,y,z\n0,0,0,0\n1e12,0,0,0\n"), {"--rate", "1000"}),
                   {"long.csv", "1000000000000 s", "steps"});
}

TEST(MeshFiles, WhatIsNoMeshIsToldInOneLine) {
  const TemporaryFolder folder;
  expect_bad_input({"mesh", "info", folder.file("part.step", "ISO-10303-21;\n")},
                   {"part.step", "STEP", "STL"});
  const std::string pipe = folder.file("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_bad_input({"mesh", "info", pipe}, {"pipe.ply", "nobody writes"});
  expect_bad_input({"mesh", "info",
                    folder.file("twice.ply",
                                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                "property float x\nend_header\n")},
                   {"twice.ply", "line 5", "'x' twice"});
}

}  // namespace
}  // namespace touchmark::bench::cli

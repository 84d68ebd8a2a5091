/// The touchmark program from the outside: what it prints, what it leaves, what it exits with.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/bench/cli/child_program.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

const std::string hostile = TOUCHMARK_HOSTILE_PROGRAM;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::vector<std::string> split_csv(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char character : line) {
    if (character == '"') {
      quoted = !quoted;
    } else if (character == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += character;
    }
  }
  return fields;
}

TEST(Bench, LeavesOneRowAContestantAndTrajectoryAndARunJson) {
  const TemporaryFolder folder;
  const Outcome finished =
      run_touchmark({"bench", "--mesh", "icosphere:2", "--quick", "--no-cold", "--steps", "100",
                     "--trajectory", "slide", "--trajectory", "jump", "--detector", "brute-force",
                     "--detector", "grid-group:lookup=scan,shape=sphere", "--out", folder.file("new/folder"),
                     "--benchmark_min_time=0.001", "--benchmark_repetitions=2"});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  EXPECT_NE(finished.out.find("fastest exact: "), std::string::npos);

  const std::vector<std::string> csv = lines_of(content_of(folder.file("new/folder/results.csv")));
  ASSERT_EQ(csv.size(), 5U);
  const std::vector<std::string> header = split_csv(csv[0]);
  for (std::size_t i = 1; i < csv.size(); ++i) {
    const std::vector<std::string> row = split_csv(csv[i]);
    ASSERT_EQ(row.size(), header.size());
    constexpr int of_stored_mesh = 3;  // these two store what they are given
    constexpr int of_prepare = 3;      // and prepare nothing
    constexpr int of_few_steps = 1;    // no 99.9 %
    constexpr int of_cold = 8;         // by --no-cold
    constexpr int of_lines = 2;        // without --cache-lines
    constexpr int of_merge = 1;        // not from touchmark merge
    EXPECT_EQ(std::count(row.begin(), row.end(), ""),
              of_stored_mesh + of_prepare + of_few_steps + of_cold + of_lines + of_merge + i % 2)
        << "besides, only brute-force's options are empty";
    EXPECT_EQ(row[0], "1");
    EXPECT_EQ(row[3], i % 2 == 1 ? "" : "lookup=scan,shape=sphere");
    EXPECT_EQ(row[4], "icosphere:2");
    EXPECT_EQ(row[5], "320");
    EXPECT_EQ(row[6], i <= 2 ? "slide" : "jump");
    EXPECT_EQ(row[11], "exact");
    EXPECT_EQ(row[19], "ok");
    EXPECT_EQ(row[35], "2") << "repetitions";
  }
  EXPECT_EQ(split_csv(csv[1])[45], "0");

  const auto json = nlohmann::json::parse(content_of(folder.file("new/folder/run.json")));
  for (const char* key : {"schema", "run_id", "date", "commit", "compiler", "flags", "build_type", "native",
                          "cpu", "simd", "cores", "governor", "load_average", "flushed_to_zero", "libraries",
                          "seed", "command_line", "mesh", "clock"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["run_id"], split_csv(csv[1])[1]);
  EXPECT_EQ(json["finished"], true);
  EXPECT_EQ(json["mesh"]["triangles"], 320);
  EXPECT_EQ(json["trajectories"][1]["steps"], 100);
  EXPECT_GT(json["clock"]["cost_ns"], 0);
  EXPECT_EQ(json["contestants"][1]["options"]["lookup"], "scan");
  EXPECT_EQ(json.dump().find(folder.path()), std::string::npos) << "no paths of the machine";
}

TEST(Bench, WritesIntoARelativeFolder) {
  const TemporaryFolder folder;
  const std::string relative = std::filesystem::relative(folder.file("here")).string();
  const Outcome finished = run_touchmark({"bench", "--mesh", "icosphere:0", "--quick", "--no-cold", "--steps",
                                          "10", "--trajectory", "slide", "--detector", "brute-force", "--out",
                                          relative, "--benchmark_min_time=0.001"});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_TRUE(std::filesystem::exists(folder.file("here/results.csv")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("here/run.json")));
}

TEST(Bench, SameSeedSameAnswersAnotherSeedOthers) {
  const TemporaryFolder folder;
  const auto checksum = [&](const std::string& seed) {
    const Outcome finished =
        run_touchmark({"bench", "--mesh", "icosphere:1", "--quick", "--no-cold", "--steps", "50", "--seed",
                       seed, "--trajectory", "slide", "--detector", "aabb-tree", "--out", folder.path(),
                       "--benchmark_min_time=0.001"});
    EXPECT_EQ(finished.status, 0) << finished.err;
    const std::vector<std::string> csv = lines_of(content_of(folder.file("results.csv")));
    const std::vector<std::string> header = split_csv(csv.at(0));
    const auto column = std::find(header.begin(), header.end(), "answers_checksum");
    return split_csv(csv.at(1)).at(static_cast<std::size_t>(column - header.begin()));
  };
  const std::string first = checksum("7");
  EXPECT_EQ(checksum("7"), first);
  EXPECT_NE(checksum("8"), first);
}

TEST(Bench, ClocksPreparingApart) {
  const TemporaryFolder folder;
  const Outcome finished =
      run_touchmark({"bench", "--mesh", "icosphere:3", "--quick", "--no-cold", "--steps", "1000",
                     "--trajectory", "slide", "--detector", "sphere-cluster:prepare=true", "--detector",
                     "sphere-cluster", "--out", folder.path(), "--benchmark_min_time=0.001"});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(run_touchmark({"validate", folder.path()}).status, 0);
  const std::vector<std::string> csv = lines_of(content_of(folder.file("results.csv")));
  const std::vector<std::string> header = split_csv(csv.at(0));
  const auto field = [&](std::size_t row, const char* name) {
    const auto column = std::find(header.begin(), header.end(), name);
    return split_csv(csv.at(row)).at(static_cast<std::size_t>(column - header.begin()));
  };
  EXPECT_GT(std::stod(field(1, "prepare_ns_p50")), 0);
  EXPECT_GE(std::stod(field(1, "prepare_ns_max")), std::stod(field(1, "prepare_ns_p999")));
  EXPECT_EQ(field(2, "prepare_ns_p50"), "");
  EXPECT_EQ(field(1, "answers_checksum"), field(2, "answers_checksum"));
}

TEST(Bench, ShowsWhatAStepLookedAtWhenAsked) {
  const std::vector<std::string> command{
      "bench", "--mesh",       "icosphere:0", "--quick",    "--no-cold",   "--steps",
      "10",    "--trajectory", "slide",       "--detector", "brute-force", "--benchmark_min_time=0.001"};
  const Outcome without = run_touchmark(command);
  EXPECT_EQ(without.out.find("looked at"), std::string::npos) << without.out;
  std::vector<std::string> with = command;
  with.emplace_back("--work");
  const Outcome shown = run_touchmark(with);
  // Brute force looks at all of the icosahedron's triangles and at nothing else.
  EXPECT_TRUE(std::regex_search(shown.out, std::regex("brute-force +0 +0 +0 +20 +100 % +20 +0\n")))
      << shown.out;
}

TEST(Bench, ListsItsCasesAndFiltersThem) {
  const Outcome all =
      run_touchmark({"bench", "--mesh", "icosphere:0", "--steps", "10", "--benchmark_list_tests"});
  EXPECT_NE(all.out.find("brute-force/hand\n"), std::string::npos);
  const Outcome some =
      run_touchmark({"bench", "--mesh", "icosphere:0", "--steps", "10", "--benchmark_list_tests",
                     "--benchmark_filter=^grid-group/(hand|jump)$"});
  EXPECT_EQ(some.out, "grid-group/hand\ngrid-group/jump\n");
}

TEST(Bench, ANaNFreeRowForEveryQuery) {
  for (const char* query : {"touches", "nearest", "sweep"}) {
    const TemporaryFolder folder;
    const Outcome finished =
        run_touchmark({"bench", "--mesh", "cube", "--quick", "--no-cold", "--steps", "50", "--query", query,
                       "--trajectory", "tap", "--detector", "grid-group", "--reach", "inf", "--out",
                       folder.path(), "--benchmark_min_time=0.001"});
    EXPECT_EQ(finished.status, 0) << finished.err;
    const std::vector<std::string> csv = lines_of(content_of(folder.file("results.csv")));
    ASSERT_EQ(csv.size(), 2U);
    EXPECT_EQ(split_csv(csv[1])[7], query);
    EXPECT_EQ(split_csv(csv[1])[10], "inf");
    EXPECT_EQ(csv[1].find("nan"), std::string::npos);
  }
}

TEST(Bench, NamesEachBadArgumentInOneLine) {
  expect_bad_input({"bench", "--detector", "grid-grup"},
                   {"unknown contestant \"grid-grup\"; the nearest names: grid-group"});
  expect_bad_input({"bench", "--detector", "grid-group:size=1"}, {"grid-group has no option \"size\""});
  expect_bad_input({"bench", "--mesh", "no-such-mesh"}, {"no-such-mesh"});
  expect_bad_input({"bench", "--mesh", "cube", "--trajectory", "no-such"}, {"no-such"});
  expect_bad_input({"bench", "--mesh", "cube", "--radius", "-1"}, {"--radius \"-1\""});
  expect_bad_input({"bench", "--mesh", "cube", "--radius", "5mm"}, {"--radius \"5mm\""});
  expect_bad_input({"bench", "--mesh", "cube", "--reach", "far"}, {"--reach \"far\""});
  expect_bad_input({"bench", "--mesh", "cube", "--steps", "0"}, {"--steps \"0\""});
  expect_bad_input({"bench", "--mesh", "cube", "--seed", "x"}, {"--seed \"x\""});
  expect_bad_input({"bench", "--mesh", "cube", "--query", "all"}, {"--query \"all\""});
  expect_bad_input({"bench", "--mesh", "cube", "--timeout", "0"}, {"--timeout \"0\""});
  expect_bad_input({"bench", "--mesh", "cube", "--mesh", "cube"}, {"--mesh"});
  expect_bad_input({"bench", "--mesh", "cube", "--out", "/dev/null"},
                   {"--out \"/dev/null\" is not a folder"});
  expect_bad_input({"bench", "--mesh", "cube", "--out", "/dev/null/x"},
                   {"--out \"/dev/null/x\" is not a folder"});
  expect_bad_input({"bench", "--colour"}, {"unknown argument \"--colour\""});
  expect_bad_input({"bench", "cube"}, {"unknown argument \"cube\""});
  expect_bad_input({"bench", "--benchmark_repetitions=0"}, {"--benchmark_repetitions \"0\""});
  expect_bad_input({"bench", "--benchmark_min_time=x"}, {"--benchmark_min_time \"x\""});
  expect_bad_input({"bench", "--benchmark_filter=("}, {"--benchmark_filter \"(\""});
  expect_bad_input({"bench", "--benchmark_out_format=csv"}, {"--benchmark_out_format", "not json"});
  expect_bad_input({"bench", "--benchmark_nonsense=1"}, {"--benchmark_nonsense=1"});
  expect_bad_input({"verify", "--query", "near"}, {"--query \"near\""});
  expect_bad_input({"list", "--bar"}, {"--bar"});
  expect_bad_input({"no-such-command"}, {"no-such-command"});
}

TEST(Program, LooksAtTheFolderBeforeItLoadsTheMesh) {
  for (const char* command : {"bench", "verify", "choose", "servo", "update", "many"})
    expect_bad_input({command, "--mesh", "no-such-mesh", "--out", "/dev/null"},
                     {"--out \"/dev/null\" is not a folder"});
  expect_bad_input({"bench", "--mesh", "no-such-mesh", "--out", "/dev/null", "--timeout", "0"},
                   {"--timeout \"0\""});
}

TEST(Program, SaysWithoutACommandWhatItIsAndWhereToBegin) {
  const Outcome finished = run_touchmark({});
  EXPECT_EQ(finished.status, 2);
  EXPECT_EQ(finished.out, "");
  for (const char* command : {"bench", "choose", "servo", "mesh info", "list", "--help"})
    EXPECT_NE(finished.err.find(std::string("touchmark ") + command), std::string::npos) << finished.err;
}

TEST(Bench, AFullDiskIsStatus3AndLeavesNoHalfFile) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.file("results.csv"));
  const Outcome finished = run_touchmark({"bench", "--mesh", "icosphere:0", "--quick", "--no-cold", "--steps",
                                          "10", "--trajectory", "slide", "--detector", "brute-force", "--out",
                                          folder.path(), "--benchmark_min_time=0.001"});
  EXPECT_EQ(finished.status, 3);
  EXPECT_NE(finished.err.find("No space left"), std::string::npos) << finished.err;
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
}

TEST(Program, AFullDiskBehindStandardOutputIsStatus3) {
  for (const std::string name : {"list", "--help", "--version"}) {
    const Outcome finished = run_touchmark({name}, "/dev/full");
    EXPECT_EQ(finished.status, 3) << name;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

TEST(Program, HelpOfEveryCommandHasAnExample) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"bench", "--help"}, {"verify", "--help"}, {"list", "--help"}}) {
    const Outcome finished = run_touchmark(arguments);
    EXPECT_EQ(finished.status, 0);
    EXPECT_NE(finished.out.find("Example: touchmark "), std::string::npos) << finished.out;
  }
}

TEST(Program, TellsItsVersion) {
  const Outcome finished = run_touchmark({"--version"});
  EXPECT_EQ(finished.status, 0);
  EXPECT_EQ(finished.out.substr(0, 10), "touchmark ");
}

TEST(List, NamesContestantsScenesAndTrajectories) {
  const Outcome finished = run_touchmark({"list"});
  EXPECT_EQ(finished.status, 0);
  for (const char* name :
       {"brute-force", "grid-group", "sphere-cluster", "icosphere:N", "slide", "lookup=direct|scan"}) {
    EXPECT_NE(finished.out.find(name), std::string::npos) << name;
  }
}

TEST(Verify, IsContentWithWhatIsExact) {
  const TemporaryFolder folder;
  const Outcome finished =
      run_touchmark({"verify", "--mesh", "cube", "--mesh", "needles@offset=1e6", "--steps", "60",
                     "--detector", "grid-group", "--detector", "sphere-cluster", "--out", folder.path()});
  EXPECT_EQ(finished.status, 0) << finished.out;
  EXPECT_EQ(finished.out.find("BROKEN"), std::string::npos);
  // Two meshes, eight trajectories, three queries, two contestants.
  EXPECT_EQ(lines_of(content_of(folder.file("results.csv"))).size(), 1U + 2 * 8 * 3 * 2);
}

TEST(Verify, ExitsWith1WhenAClaimIsBroken) {
  const Outcome finished = run_program_at({hostile, "verify", "--mesh", "cube", "--steps", "40",
                                           "--trajectory", "slide", "--query", "nearest", "--detector",
                                           "lies", "--detector", "honest", "--detector", "aborts"});
  EXPECT_EQ(finished.status, 1);
  EXPECT_NE(finished.out.find("BROKEN lies: cube, slide, nearest"), std::string::npos) << finished.out;
  EXPECT_NE(finished.out.find("BROKEN aborts: cube, slide, nearest: crashed:SIGABRT"), std::string::npos);
  EXPECT_EQ(finished.out.find("BROKEN honest"), std::string::npos);
}

TEST(Bench, ExitsWith1AndSaysSoWhenTimedAnswersDiffer) {
  const Outcome finished =
      run_program_at({hostile, "bench", "--mesh", "cube", "--steps", "40", "--trajectory", "slide",
                      "--detector", "fickle", "--detector", "honest", "--quick", "--no-cold"});
  EXPECT_EQ(finished.status, 1);
  EXPECT_NE(finished.err.find("fickle on slide: timed answers differ from verified ones"), std::string::npos);
  EXPECT_NE(finished.out.find("fastest exact: honest"), std::string::npos);
}

/// The second trajectory hangs, so the first one's row is there when Ctrl-C comes.
TEST(Bench, CtrlCKeepsTheFinishedRowsAndEndsTheWorkers) {
  const TemporaryFolder folder;
  ChildProgram child({hostile,        "bench",     "--mesh",     "icosphere:0",  "--steps",
                      "40",           "--quick",   "--no-cold",  "--trajectory", "slide",
                      "--trajectory", "jump",      "--detector", "honest",       "--detector",
                      "hangs",        "--timeout", "4",          "--out",        folder.path()});
  for (int i = 0; i < 600 && !std::filesystem::exists(folder.file("results.csv")); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  child.signal(SIGINT);
  const auto asked = std::chrono::steady_clock::now();
  const Outcome finished = child.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(3)) << "it waited for the hang";
  EXPECT_EQ(finished.status, 130);
  EXPECT_NE(finished.err.find("interrupted; 2 finished rows are kept"), std::string::npos) << finished.err;
  const std::vector<std::string> csv = lines_of(content_of(folder.file("results.csv")));
  ASSERT_EQ(csv.size(), 3U);
  EXPECT_EQ(split_csv(csv[1])[19], "ok");
  EXPECT_EQ(split_csv(csv[2])[19], "timeout");
  EXPECT_EQ(nlohmann::json::parse(content_of(folder.file("run.json")))["finished"], false);
}

}  // namespace
}  // namespace touchmark::bench::cli

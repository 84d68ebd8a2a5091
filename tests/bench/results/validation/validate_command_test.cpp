/// `touchmark validate` from the outside: on what was recorded, on a fresh run, and on that run damaged in
/// one place after the other.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/results/results_csv.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

/// One run for all tests: two contestants, one of which does not answer the query.
class Validate : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    const Outcome finished =
        run_touchmark({"bench", "--mesh", "icosphere:1", "--quick", "--no-cold", "--steps", "50", "--query",
                       "sweep", "--trajectory", "slide", "--detector", "aabb-tree", "--detector", "fcl",
                       "--out", folder.path(), "--benchmark_min_time=0.001"});
    ASSERT_EQ(finished.status, 0) << finished.err;
    csv() = content_of(folder.file("results.csv"));
    run() = content_of(folder.file("run.json"));
  }

  static std::string& csv() {
    static std::string text;
    return text;
  }
  static std::string& run() {
    static std::string text;
    return text;
  }

  /// The file with one field, of a line from 2, replaced. No field of these rows has a comma in it.
  static std::string with(const std::string& column, int line, const std::string& value) {
    const std::vector<std::string> names = results::names_of(results::results_columns());
    auto at = std::find(names.begin(), names.end(), column) - names.begin();
    std::size_t begin = 0;
    for (int i = 1; i < line; ++i) begin = csv().find('\n', begin) + 1;
    for (; at > 0; --at) begin = csv().find(',', begin) + 1;
    std::string damaged = csv();
    return damaged.replace(begin, csv().find_first_of(",\n", begin) - begin, value);
  }

  static Outcome validate(const std::string& results, const std::string& description) {
    const TemporaryFolder folder;
    folder.file("results.csv", results);
    if (!description.empty()) folder.file("run.json", description);
    return run_touchmark({"validate", folder.path()});
  }

  /// Status 1, and among the lines one with that beginning, after the file's name.
  static void expect_fault(const Outcome& outcome, const std::string& beginning) {
    EXPECT_EQ(outcome.status, 1) << beginning;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("/" + beginning), std::string::npos)
        << "no line begins with " << beginning << " in\n"
        << outcome.out;
  }
};

TEST_F(Validate, FindsWhatIsRecordedHereFine) {
  std::vector<std::string> arguments{"validate"};
  for (const auto& machine : std::filesystem::directory_iterator(TOUCHMARK_RESULTS)) {
    // expected/ is the regression gate's: no results are in it.
    if (machine.is_directory() && machine.path().filename() != "expected")
      arguments.push_back(machine.path().string());
  }
  ASSERT_GT(arguments.size(), 1U);
  const Outcome outcome = run_touchmark(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("results.csv: fine (results, "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("run.json: fine (run)\n"), std::string::npos) << outcome.out;
}

TEST_F(Validate, FindsAFreshRunFine) {
  const Outcome outcome = validate(csv(), run());
  EXPECT_EQ(outcome.status, 0) << outcome.out;
}

TEST_F(Validate, FindsWhatVerifyLeavesFineWithoutTimes) {
  const TemporaryFolder folder;
  run_touchmark({"verify", "--mesh", "cube", "--steps", "20", "--detector", "aabb-tree", "--detector", "fcl",
                 "--out", folder.path()});
  const Outcome outcome = run_touchmark({"validate", folder.file("results.csv")});
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("rows)"), std::string::npos);
}

TEST_F(Validate, NamesLineColumnAndValueOfAWrongField) {
  const std::map<std::string, std::vector<std::string>> wrong{
      {"schema", {"2", "", "one"}},
      {"run_id", {""}},
      {"detector", {""}},
      {"options", {"=x", "leaf_size", "leaf_size="}},
      {"triangles", {"-1", "1.5", "many", ""}},
      {"query", {"near", ""}},
      {"steps", {"0", "-3"}},
      {"radius", {"-0.5", "nan", "1 mm"}},
      {"guarantee", {"certain", ""}},
      {"missed", {"51", "x", ""}},
      {"max_distance_error", {"-1", "nan"}},
      {"max_normal_angle_deg", {"181", "inf"}},
      {"status", {"fine", "refused: ", "crashed:", "Ok", ""}},
      {"ns_per_query", {"0", "inf", ""}},
      {"ns_p50", {"1e9", "abc"}},
      {"ns_p999", {"12"}},
      {"ns_undisturbed", {"0", "inf", "", "1e9"}},
      {"ns_undisturbed_low", {"1e9"}},
      {"disturbed_share", {"1.5", ""}},
      {"repetitions", {"0", "-1", ""}},
      {"false_contacts", {"1"}},
      {"wrong_triangle", {"1"}},
      {"update_rate_hz", {"1"}},
      {"build_ms", {"", "-1", "1e9"}},
      {"work_mean", {"1e9"}},
      {"longest_miss_run_10khz", {"50000"}},
      {"cpu_ns_per_query", {"nan", ""}},
      {"answers_checksum", {"", "12", "XY34567812345678"}},
      {"judged", {"0", "51", ""}},
      {"beyond_tolerance", {"51", "-1", ""}},
      {"rounding", {"51", "few", ""}},
  };
  for (const auto& [column, values] : wrong) {
    for (const std::string& value : values) {
      expect_fault(validate(with(column, 2, value), run()),
                   "results.csv:2: " + column + " \"" + value + "\"");
    }
  }
}

TEST_F(Validate, WantsNoMeanAboveTheMaximum) {
  // The rate and the share are made to fit, so that only the mean is wrong.
  const auto with_mean = [](const std::string& share, const std::string& processor = "1000000000") {
    std::string text = with("ns_per_query", 2, "1000000000");
    const std::string fresh = std::exchange(csv(), text);
    text = with("cpu_ns_per_query", 2, processor);
    csv() = text;
    text = with("update_rate_hz", 2, "1");
    csv() = text;
    text = with("disturbed_share", 2, share);
    csv() = fresh;
    return text;
  };
  expect_fault(validate(with_mean("0"), run()),
               "results.csv:2: ns_per_query \"1000000000\" is above ns_max ");
  EXPECT_EQ(validate(with_mean("0.5"), run()).status, 0) << "the row says that it was interrupted";
  EXPECT_EQ(validate(with_mean("0", "1"), run()).status, 0) << "others had the core while its passes ran";
}

TEST_F(Validate, WantsEachRowThatWasAskedForOnce) {
  const std::size_t second = csv().find('\n') + 1, third = csv().find('\n', second) + 1;
  const std::string row = csv().substr(second, third - second);
  expect_fault(validate(csv() + row, run()), "results.csv:4: detector \"aabb-tree\" has this row twice");
  expect_fault(validate(csv() + row, ""), "results.csv:4: detector \"aabb-tree\" has this row twice");
  std::string less = csv();
  less.erase(second, row.size());
  expect_fault(validate(less, run()), "results.csv:1: rows \"aabb-tree on icosphere:1, slide\" is missing");
  EXPECT_EQ(validate(less, "").status, 0) << "without run.json nobody knows";
  std::string interrupted = run();
  interrupted.replace(interrupted.find("\"finished\": true"), 16, "\"finished\": false");
  EXPECT_EQ(validate(less, interrupted).status, 0) << "what Ctrl-C left";
}

TEST_F(Validate, WantsThoseThatClaimExactnessToAgree) {
  const TemporaryFolder folder;
  const Outcome finished =
      run_touchmark({"bench", "--mesh", "icosphere:1", "--quick", "--no-cold", "--steps", "50",
                     "--trajectory", "slide", "--detector", "aabb-tree", "--detector", "brute-force", "--out",
                     folder.path(), "--benchmark_min_time=0.001"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  const std::string fresh = std::exchange(csv(), content_of(folder.file("results.csv")));
  const std::string other_answers = with("decisions_checksum", 3, "0123456789abcdef"), other_steps = [] {
    const std::string before = std::exchange(csv(), with("decisions_checksum", 3, "0123456789abcdef"));
    csv() = with("judged", 3, "49");
    std::string text = with("steps", 3, "49");
    csv() = before;
    return text;
  }();
  csv() = fresh;
  const std::string description = content_of(folder.file("run.json"));
  expect_fault(validate(other_answers, description),
               "results.csv:3: decisions_checksum \"0123456789abcdef\" is not that of aabb-tree, line 2");
  EXPECT_EQ(validate(other_steps, description).status, 0) << "other steps have other answers";
}

TEST_F(Validate, WantsNoTimesWhereTheStatusIsNotOk) {
  expect_fault(validate(with("ns_per_query", 3, "12"), run()), "results.csv:3: ns_per_query \"12\"");
  expect_fault(validate(with("status", 2, "timeout"), run()), "results.csv:2: ns_p50 ");
}

TEST_F(Validate, WantsRowsThatAgreeWithTheRunBesideThem) {
  for (const auto& [column, value] : std::map<std::string, std::string>{{"run_id", "20200101T000000Z-0000"},
                                                                        {"mesh", "bunny"},
                                                                        {"triangles", "81"},
                                                                        {"query", "nearest"},
                                                                        {"trajectory", "jump"},
                                                                        {"detector", "embree"}}) {
    expect_fault(validate(with(column, 2, value), run()), "results.csv:2: " + column + " \"" + value + "\"");
    EXPECT_EQ(validate(with(column, 2, value), "").status, 0)
        << column << ": without run.json nothing differs";
  }
}

TEST_F(Validate, WantsTheColumnsInTheirOrderButTakesMoreAtTheEnd) {
  std::string renamed = csv(), longer = csv(), shorter;
  renamed.replace(renamed.find("missed"), 6, "mixed1");
  expect_fault(validate(renamed, run()), "results.csv:1: header, column 13 \"mixed1\" is not missed");
  for (std::size_t at = longer.find('\n'); at != std::string::npos; at = longer.find('\n', at + 5)) {
    longer.insert(at, at == csv().find('\n') ? ",new" : ",1");
  }
  EXPECT_EQ(validate(longer, run()).status, 0) << validate(longer, run()).out;
  longer.replace(longer.find(",new"), 4, ",");
  expect_fault(validate(longer, run()), "results.csv:1: header \"\" is a column without a name");
}

TEST_F(Validate, NoticesATruncatedFile) {
  expect_fault(validate(csv().substr(0, csv().size() - 3), ""), "results.csv:3:");
  const std::size_t last = csv().rfind('\n', csv().size() - 2);
  const std::size_t cut = csv().find(",ok,");
  ASSERT_LT(cut, last);
  expect_fault(validate(csv().substr(0, cut), ""), "results.csv:2: the line has 19 fields, the header " +
                                                       std::to_string(results::results_columns().size()));
  expect_fault(validate("", ""), "results.csv: the file is empty");
  expect_fault(validate(csv() + "\"open", ""), "results.csv:4: a quote is never closed");
}

TEST_F(Validate, NamesLineAndPlaceInRunJson) {
  const auto damaged = [](const std::string& from, const std::string& to) {
    std::string text = run();
    return text.replace(text.find(from), from.size(), to);
  };
  expect_fault(validate(csv(), damaged("\"cores\": ", "\"cores\": -")), "run.json:14: /cores \"-");
  expect_fault(validate(csv(), damaged("\"finished\": true", "\"finished\": \"yes\"")),
               "run.json:5: /finished \"yes\" is not of type boolean");
  expect_fault(validate(csv(), damaged("\"seed\"", "\"sead\"")), "run.json:1: /seed \"\" is missing");
  const auto seed = run().begin() + static_cast<std::ptrdiff_t>(run().find("\"seed\""));
  const std::string line = std::to_string(1 + std::count(run().begin(), seed, '\n'));
  expect_fault(validate(csv(), damaged("\"seed\"", "\"date\"")),
               "run.json:" + line + ": /date \"date\" is there twice");
  expect_fault(validate(csv(), run().substr(0, run().size() / 2)), "run.json:");
  expect_fault(validate(csv(), std::string(200'000, '[') + std::string(200'000, ']')),
               "run.json:1: the text is nested deeper than 100 levels");
}

TEST_F(Validate, ChecksOtherTablesForTheirForm) {
  const TemporaryFolder folder;
  folder.file("fine.csv", "a,b\n1,2\n");
  EXPECT_EQ(run_touchmark({"validate", folder.path()}).status, 0);
  folder.file("other.csv", "a,b\n1,2\n1,2,3\n");
  expect_fault(run_touchmark({"validate", folder.path()}),
               "other.csv:3: the line has 3 fields, the header 2");
}

TEST_F(Validate, RefusesWhatIsNotThere) {
  const TemporaryFolder folder;
  expect_bad_input({"validate"}, {"path"});
  expect_bad_input({"validate", "no/such/file.csv"}, {"no/such/file.csv"});
  expect_bad_input({"validate", folder.path()}, {folder.path(), "no CSV file"});
}

}  // namespace
}  // namespace touchmark::bench::cli

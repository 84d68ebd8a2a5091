#include "bench/results/results_csv.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace touchmark::bench::results {
namespace {

// The contract of schema 1: appended to, never changed.
const std::string contract =
    "schema,run_id,detector,options,mesh,triangles,trajectory,query,steps,radius,reach,guarantee,missed,"
    "false_contacts,wrong_triangle,max_distance_error,max_distance_error_ulp,max_normal_angle_deg,unresolved,"
    "status,ns_per_query,ns_p50,ns_p90,ns_p99,ns_p999,ns_max,update_rate_hz,deadline_misses_1khz,longest_"
    "miss_run_1khz,build_ms,first_answer_ms,bytes,heap_bytes,work_mean,work_max,repetitions";

std::size_t fields_in(const std::string& line) {
  std::size_t fields = 1;
  bool quoted = false;
  for (const char character : line) {
    if (character == '"') quoted = !quoted;
    if (character == ',' && !quoted) ++fields;
  }
  return fields;
}

TEST(ResultsCsv, BeginsWithTheColumnsOfTheContract) {
  const std::string csv = results_csv("run", {});
  EXPECT_EQ(csv.substr(0, contract.size() + 1), contract + ",");
  EXPECT_EQ(csv.find('\n'), csv.size() - 1);
  EXPECT_EQ(results_columns()[columns_of_the_contract - 1].name, "repetitions");
}

TEST(ResultsCsv, SaysOfEachColumnWhatItMeansAndHolds) {
  std::set<std::string_view> names;
  for (const auto& column : results_columns()) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    EXPECT_GT(column.means.size(), 10U) << column.name;
    EXPECT_EQ(column.means.find_first_of("|\n"), std::string_view::npos)
        << column.name << ": not a cell of a table";
    EXPECT_NE(column.kind.what, "") << column.name;
    EXPECT_EQ(column.value == nullptr, column.name == "run_id") << column.name;
  }
}

TEST(ResultsCsv, AcceptsWhatItsColumnsAreFor) {
  using namespace kinds;
  const auto all = [](const Kind& kind, std::initializer_list<const char*> texts) {
    return std::all_of(texts.begin(), texts.end(), kind.accepts);
  };
  const auto none = [](const Kind& kind, std::initializer_list<const char*> texts) {
    return std::none_of(texts.begin(), texts.end(), kind.accepts);
  };
  EXPECT_TRUE(all(whole_number, {"0", "7"}) && none(whole_number, {"-1", "1.5", "seven", "inf"}));
  EXPECT_TRUE(all(positive_count, {"1"}) && none(positive_count, {"0", "-1", "1.5"}));
  EXPECT_TRUE(all(length, {"0", "1.5", "inf", "1e-300"}) && none(length, {"-1", "nan", "long"}));
  EXPECT_TRUE(all(finite, {"0", "1.5"}) && none(finite, {"inf", "nan", "-1", "1e999"}));
  EXPECT_TRUE(all(positive, {"1.5"}) && none(positive, {"0", "inf", "nan", "-1"}));
  EXPECT_TRUE(all(share, {"0", "0.5", "1"}) && none(share, {"1.01", "inf", "-1"}));
  EXPECT_TRUE(all(bit, {"0", "1"}) && none(bit, {"2", "true"}));
  EXPECT_TRUE(all(checksum, {"0123456789abcdef"}) && none(checksum, {"0123", "0123456789abcdeg"}));
  EXPECT_TRUE(all(query, {"touches", "nearest", "sweep"}) && none(query, {"touch"}));
  EXPECT_TRUE(all(guarantee, {"exact", "conservative", "approximate"}) && none(guarantee, {"Exact"}));
}

TEST(ResultsCsv, QuotesAsRfc4180Does) {
  EXPECT_EQ(support::csv_field("plain text"), "plain text");
  EXPECT_EQ(support::csv_field("lookup=scan,shape=cube"), "\"lookup=scan,shape=cube\"");
  EXPECT_EQ(support::csv_field("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(support::csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(support::csv_field(""), "");
}

TEST(ResultsCsv, LeavesEmptyWhatWasNotMeasured) {
  measurement::ResultRow row;
  row.detector = "fcl";
  row.options = "bv=obb,method=distance";
  row.mesh = "soup:10";
  row.triangles = 10;
  row.trajectory = "jump";
  row.reach = std::numeric_limits<double>::infinity();
  row.status = "refused: obb, it says, has no distance";
  const std::string csv = results_csv("run", {row});
  const std::string header = csv.substr(0, csv.find('\n'));
  const std::string line = csv.substr(csv.find('\n') + 1);
  EXPECT_EQ(fields_in(line), fields_in(header));
  EXPECT_EQ(line.substr(0, line.find(",,,,")),
            "1,run,fcl,\"bv=obb,method=distance\",soup:10,10,jump,nearest,0,0,inf");
  EXPECT_NE(line.find(",\"refused: obb, it says, has no distance\",,,"), std::string::npos);
}

TEST(ResultsCsv, WritesRadiusAndErrorsSoThatTheyReadBackTheSame) {
  measurement::ResultRow row;
  row.radius = 0.1 + 0.2;
  row.counts.emplace();
  row.counts->max_distance_error = 1.0 / 3e300;
  const std::string csv = results_csv("run", {row});
  EXPECT_NE(csv.find(",0.30000000000000004,"), std::string::npos);
  const std::string error = csv.substr(csv.find("e-301") - 18, 23);
  EXPECT_EQ(std::stod(error.substr(error.rfind(',') + 1)), 1.0 / 3e300);
}

}  // namespace
}  // namespace touchmark::bench::results

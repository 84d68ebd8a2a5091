#include "bench/results/results_csv.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace touchmark::bench::results {
namespace {

// The contract of schema 1: appended to, never changed.
const std::string contract =
    "schema,run_id,detector,options,mesh,triangles,trajectory,query,steps,radius,reach,guarantee,missed,"
    "false_contacts,wrong_triangle,max_distance_error,max_distance_error_ulp,max_normal_angle_deg,unresolved,"
    "status,ns_per_query,ns_p50,ns_p90,ns_p99,ns_p999,ns_max,update_rate_hz,deadline_misses_1khz,"
    "longest_miss_run_1khz,build_ms,first_answer_ms,bytes,heap_bytes,work_mean,work_max,repetitions";

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
}

TEST(ResultsCsv, QuotesAsRfc4180Does) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("lookup=scan,shape=cube"), "\"lookup=scan,shape=cube\"");
  EXPECT_EQ(csv_field("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field(""), "");
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

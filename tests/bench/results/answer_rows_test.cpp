#include "bench/results/answer_rows.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "bench/oracle/judge.h"

namespace touchmark::bench::results {
namespace {

std::string row(workload::Query query, double radius, const workload::Answer& answer) {
  std::string text;
  append_answer_row(text, query, 7, {{Vec3::Zero(), radius}, 10}, answer);
  return text;
}

workload::Answer near_two() {
  return workload::Answer::of({.point = {1, 2, 3}, .normal = {0, 0.6, -0.8}, .distance = 2, .triangle = 4},
                              0.25);
}

std::size_t commas(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
}

TEST(AnswerRows, TheHeaderIsTheContractAndSweepAppends) {
  const std::string contract =
      "step,touching,triangle,distance,point_x,point_y,point_z,normal_x,normal_y,normal_z";
  EXPECT_EQ(answer_header(workload::Query::nearest), contract + "\n");
  EXPECT_EQ(answer_header(workload::Query::touches), contract + "\n");
  EXPECT_EQ(answer_header(workload::Query::sweep), contract + ",fraction\n");
}

TEST(AnswerRows, NearestTouchesWhenTheDistanceIsAtMostTheRadius) {
  EXPECT_EQ(row(workload::Query::nearest, 2, near_two()), "7,1,4,2,1,2,3,0,0.6,-0.8\n");
  EXPECT_EQ(row(workload::Query::nearest, 1.9999999999999998, near_two()), "7,0,4,2,1,2,3,0,0.6,-0.8\n");
}

TEST(AnswerRows, SweepTouchesWhenItHitsAndTellsWhere) {
  EXPECT_EQ(row(workload::Query::sweep, 0, near_two()), "7,1,4,2,1,2,3,0,0.6,-0.8,0.25\n");
}

TEST(AnswerRows, TheSideComesLastWhereItIsAskedFor) {
  workload::Answer answer = near_two();
  answer.side = Side::inside;
  const workload::Step step{{Vec3::Zero(), 2}, 10};
  std::string rows;
  append_answer_row(rows, workload::Query::nearest, 7, step, answer, {.side = true});
  append_answer_row(rows, workload::Query::sweep, 7, step, answer, {.side = true});
  append_answer_row(rows, workload::Query::nearest, 7, step, {}, {.side = true});
  EXPECT_EQ(rows, "7,1,4,2,1,2,3,0,0.6,-0.8,inside\n7,1,4,2,1,2,3,0,0.6,-0.8,0.25,inside\n7,0,,,,,,,,,\n");
  for (const workload::Query query :
       {workload::Query::touches, workload::Query::nearest, workload::Query::sweep})
    EXPECT_EQ(answer_header(query, {.side = true}).substr(answer_header(query).size() - 1), ",side\n");
}

TEST(AnswerRows, TouchesTellsNothingElse) {
  EXPECT_EQ(row(workload::Query::touches, 0, near_two()), "7,1,,,,,,,,\n");
}

TEST(AnswerRows, NothingFoundLeavesTheRestEmpty) {
  for (const workload::Query query :
       {workload::Query::touches, workload::Query::nearest, workload::Query::sweep}) {
    const std::string text = row(query, 1, {});
    EXPECT_EQ(text.find_first_not_of(",\n", 3), std::string::npos) << text;
    EXPECT_EQ(text.substr(0, 4), "7,0,");
    EXPECT_EQ(commas(text), commas(answer_header(query)));
  }
}

TEST(AnswerRows, AContestantThatCannotTellTheTriangleLeavesItEmpty) {
  workload::Answer answer = near_two();
  answer.triangle = oracle::no_triangle;
  EXPECT_EQ(row(workload::Query::nearest, 2, answer), "7,1,,2,1,2,3,0,0.6,-0.8\n");
}

TEST(AnswerRows, DoublesReadBackToTheSameBits) {
  workload::Answer answer = near_two();
  answer.distance = 0.1 + 0.2;
  EXPECT_NE(row(workload::Query::nearest, 2, answer).find(",0.30000000000000004,"), std::string::npos);
}

}  // namespace
}  // namespace touchmark::bench::results

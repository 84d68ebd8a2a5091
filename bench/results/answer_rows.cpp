#include "bench/results/answer_rows.h"

#include <iterator>

#include <fmt/format.h>

#include "bench/oracle/judge.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {
namespace {

bool touching(workload::Query query, const workload::Step& step, const workload::Answer& answer) noexcept {
  if (answer.found == 0) return false;
  return query != workload::Query::nearest || answer.distance <= step.probe.radius;
}

/// A name as a field of CSV.
std::string field_of(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string answer_header(workload::Query query, const AnswerColumns& columns) {
  std::string header = "step,touching,triangle,distance,point_x,point_y,point_z,normal_x,normal_y,normal_z";
  if (workload::is_of_a_way(query)) header += ",fraction";
  if (columns.side) header += ",side";
  if (columns.bodies != nullptr) header += ",body";
  return header + "\n";
}

void append_answer_row(std::string& rows, workload::Query query, std::size_t index,
                       const workload::Step& step, const workload::Answer& answer,
                       const AnswerColumns& columns) {
  const auto out = std::back_inserter(rows);
  fmt::format_to(out, "{},{}", index, touching(query, step, answer) ? 1 : 0);
  if (query == workload::Query::touches || answer.found == 0) {
    rows += workload::is_of_a_way(query) ? ",,,,,,,,," : ",,,,,,,,";
    if (columns.side) rows += ',';
  } else {
    rows += ',';
    if (answer.triangle != oracle::no_triangle) fmt::format_to(out, "{}", answer.triangle);
    fmt::format_to(out, ",{}", answer.distance);
    for (const double x : answer.point) fmt::format_to(out, ",{}", x);
    for (const double x : answer.normal) fmt::format_to(out, ",{}", x);
    if (workload::is_of_a_way(query)) fmt::format_to(out, ",{}", answer.fraction);
    if (columns.side) fmt::format_to(out, ",{}", workload::name_of(answer.side));
  }
  if (columns.bodies != nullptr) {
    rows += ',';
    if (answer.found != 0) rows += field_of(columns.bodies->bodies[answer.body].name);
  }
  rows += '\n';
}

}  // namespace touchmark::bench::results

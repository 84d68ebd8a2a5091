#include "bench/results/answer_rows.h"

#include <iterator>

#include <fmt/format.h>

#include "bench/oracle/judge.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench {
namespace {

bool touching(Query query, const Step& step, const Answer& answer) noexcept {
  if (answer.found == 0) return false;
  return query != Query::nearest || answer.distance <= step.probe.radius;
}

}  // namespace

std::string answer_header(Query query, bool with_side) {
  std::string header = "step,touching,triangle,distance,point_x,point_y,point_z,normal_x,normal_y,normal_z";
  if (query == Query::sweep) header += ",fraction";
  if (with_side) header += ",side";
  return header + "\n";
}

void append_answer_row(std::string& rows, Query query, std::size_t index, const Step& step,
                       const Answer& answer, bool with_side) {
  const auto out = std::back_inserter(rows);
  fmt::format_to(out, "{},{}", index, touching(query, step, answer) ? 1 : 0);
  if (query == Query::touches || answer.found == 0) {
    rows += query == Query::sweep ? ",,,,,,,,," : ",,,,,,,,";
    rows += with_side ? ",\n" : "\n";
    return;
  }
  rows += ',';
  if (answer.triangle != no_triangle) fmt::format_to(out, "{}", answer.triangle);
  fmt::format_to(out, ",{}", answer.distance);
  for (const double x : answer.point) fmt::format_to(out, ",{}", x);
  for (const double x : answer.normal) fmt::format_to(out, ",{}", x);
  if (query == Query::sweep) fmt::format_to(out, ",{}", answer.fraction);
  if (with_side) fmt::format_to(out, ",{}", name_of(answer.side));
  rows += '\n';
}

}  // namespace touchmark::bench

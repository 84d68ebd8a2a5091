#include "bench/answer_rows.h"

#include <iterator>

#include <fmt/format.h>

#include "bench/verify.h"

namespace touchmark::bench {
namespace {

bool touching(Query query, const Step& step, const Answer& answer) noexcept {
  if (answer.found == 0) return false;
  return query != Query::nearest || answer.distance <= step.probe.radius;
}

}  // namespace

std::string_view answer_header(Query query) noexcept {
  return query == Query::sweep
             ? "step,touching,triangle,distance,point_x,point_y,point_z,normal_x,normal_y,normal_z,"
               "fraction\n"
             : "step,touching,triangle,distance,point_x,point_y,point_z,normal_x,normal_y,normal_z\n";
}

void append_answer_row(std::string& rows, Query query, std::size_t index, const Step& step,
                       const Answer& answer) {
  const auto out = std::back_inserter(rows);
  fmt::format_to(out, "{},{}", index, touching(query, step, answer) ? 1 : 0);
  if (query == Query::touches || answer.found == 0) {
    rows += query == Query::sweep ? ",,,,,,,,,\n" : ",,,,,,,,\n";
    return;
  }
  rows += ',';
  if (answer.triangle != no_triangle) fmt::format_to(out, "{}", answer.triangle);
  fmt::format_to(out, ",{}", answer.distance);
  for (const double x : answer.point) fmt::format_to(out, ",{}", x);
  for (const double x : answer.normal) fmt::format_to(out, ",{}", x);
  if (query == Query::sweep) fmt::format_to(out, ",{}", answer.fraction);
  rows += '\n';
}

}  // namespace touchmark::bench

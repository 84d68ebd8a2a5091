#include "bench/results/steps_csv.h"

#include <iterator>
#include <string>

#include <fmt/format.h>

#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {
namespace {

constexpr std::size_t block_size = 1 << 16;

void append_step(std::string& text, const std::string& row_fields, const measurement::ResultRow& row,
                 std::size_t step, std::size_t place) {
  const measurement::StepLog& log = *row.log;
  const workload::Answer& answer = log.answers[place];
  const bool located = answer.found != 0 && row.query != workload::Query::touches;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{},{},", row_fields, step);
  if (!log.ns.empty()) fmt::format_to(out, "{:.6g}", log.ns[place]);
  fmt::format_to(out, ",{},", answer.found != 0 ? 1 : 0);
  if (located) fmt::format_to(out, "{}", answer.triangle);
  text += ',';
  if (located) fmt::format_to(out, "{}", answer.distance);
  fmt::format_to(out, ",{}\n", log.work[place]);
}

}  // namespace

void write_steps_csv(const std::vector<measurement::ResultRow>& rows,
                     const std::function<void(std::string_view)>& write) {
  std::string text(steps_csv_header);
  for (const measurement::ResultRow& row : rows) {
    if (row.log == nullptr) continue;
    const std::string fields = fmt::format("{},{},{},{},{}", support::csv_field(row.detector),
                                           support::csv_field(row.options), support::csv_field(row.mesh),
                                           support::csv_field(row.trajectory), workload::name_of(row.query));
    std::size_t place = 0;
    for (const workload::StepRange& range : row.log->ranges) {
      for (std::size_t step = range.begin; step < range.end; ++step, ++place) {
        append_step(text, fields, row, step, place);
        if (text.size() < block_size) continue;
        write(text);
        text.clear();
      }
    }
  }
  write(text);
}

}  // namespace touchmark::bench::results

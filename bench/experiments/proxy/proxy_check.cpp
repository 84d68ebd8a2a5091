#include "bench/experiments/proxy/proxy_check.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "bench/experiments/proxy/proxy_csv.h"
#include "bench/results/validation/row_check.h"

namespace touchmark::bench::experiments::proxy {

namespace validation = results::validation;

namespace {

/// Columns that count ticks, each at most once.
constexpr std::array of_ticks{"crossings",     "pops",          "violations", "missed_goals",
                              "contact_ticks", "stuck_ticks",   "unanswered", "rest_ticks",
                              "optimum_ticks", "stopped_short", "preempted"};

/// Columns that files of the first releases do not have: those of the bare query, stopped_short, what a limit
/// of work does, and preempted.
constexpr std::size_t newer_columns = 6;

void check_numbers(const validation::RowCheck& row) {
  const std::uint64_t ticks = row.count("ticks"), rests = row.count("rest_ticks");
  for (const char* column : of_ticks)
    row.expect(row.count(column) <= ticks, column, fmt::format("is above ticks {}", ticks));
  row.expect(row.count("jitters") <= rests, "jitters", fmt::format("is above rest_ticks {}", rests));
  row.expect(row.field("max_optimum_error_m").empty() == (row.count("optimum_ticks") == 0),
             "max_optimum_error_m", "must be there where and only where there are optimum_ticks");
  row.expect(row.number("max_shortfall_m").value_or(0) == 0 || row.count("violations") > 0, "max_shortfall_m",
             "is above 0 without violations");
  row.expect(row.number("query_p50_ns").value_or(0) <= row.number("query_p999_ns").value_or(0),
             "query_p999_ns", "is below query_p50_ns");
  const double median = row.number("p50_ns").value_or(0), late = row.number("p999_ns").value_or(0);
  row.expect(median <= late && late <= row.number("max_ns").value_or(0), "p999_ns",
             "is not between p50_ns and max_ns");
}

}  // namespace

void check_proxy(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults) {
  validation::check_rows(table, proxy_columns(), proxy_columns().size() - newer_columns, faults,
                         [&](const validation::RowCheck& row) {
                           row.check_fields(proxy_columns(), false);
                           row.expect_run_id(run);
                           check_numbers(row);
                         });
}

}  // namespace touchmark::bench::experiments::proxy

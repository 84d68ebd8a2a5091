#include "bench/experiments/scaling/body_check.h"

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/scaling/body_row.h"
#include "bench/results/validation/row_check.h"

namespace touchmark::bench::experiments::scaling {

namespace validation = results::validation;

namespace {

/// Columns that files of the first releases do not have: those of what is prepared, and of first ticks over
/// those with one body.
constexpr std::size_t newer_columns = 6;

void check_numbers(const validation::RowCheck& row) {
  const std::uint64_t bodies = row.count("bodies"), moved = row.count("moved");
  const std::uint64_t ticks = row.count("frames") * row.count("ticks_per_frame");
  row.expect(moved <= bodies, "moved", fmt::format("is above the {} bodies", bodies));
  row.expect(row.count("found") <= ticks, "found", fmt::format("is above the {} ticks", ticks));
  row.expect(row.count("differing") <= ticks, "differing", fmt::format("is above the {} ticks", ticks));
  row.expect((row.field("status") == "differs") == (row.count("differing") > 0), "status",
             "does not go with differing");
  row.expect(moved > 0 || row.field("publish_ns_per_body").empty(), "publish_ns_per_body",
             "is there, and nothing moves");
  row.expect(bodies > 1 || row.field("bytes_per_body").empty(), "bytes_per_body",
             "is there for a single body");
  const bool prepares = !row.field("prepare_ns").empty();
  for (const std::string column : {"first_tick_prepared_ns", "tick_prepared_ns"})
    row.expect(row.field(column).empty() != prepares, column, "does not go with prepare_ns");
}

}  // namespace

void check_bodies(const validation::CsvTable& table, validation::Faults& faults) {
  validation::check_rows(table, body_columns(), body_columns().size() - newer_columns, faults,
                         [](const validation::RowCheck& row) {
                           row.check_fields(body_columns(), false);
                           check_numbers(row);
                         });
}

}  // namespace touchmark::bench::experiments::scaling

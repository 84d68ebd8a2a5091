#include "bench/experiments/scaling/body_check.h"

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "bench/experiments/scaling/body_row.h"
#include "bench/results/validation/row_check.h"

namespace touchmark::bench::experiments::scaling {

namespace validation = results::validation;

namespace {

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
}

}  // namespace

void check_bodies(const validation::CsvTable& table, validation::Faults& faults) {
  validation::check_rows(table, body_columns(), body_columns().size(), faults,
                         [](const validation::RowCheck& row) {
                           row.check_fields(body_columns(), false);
                           check_numbers(row);
                         });
}

}  // namespace touchmark::bench::experiments::scaling

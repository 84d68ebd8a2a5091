#include "bench/results/validation/row_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/support/numbers.h"

namespace touchmark::bench::results::validation {

std::uint64_t RowCheck::count(const std::string& column) const {
  return support::parse_count(field(column)).value_or(0);
}

std::optional<double> RowCheck::number(const std::string& column) const {
  return support::parse_number(field(column));
}

void RowCheck::fault(const std::string& column, const std::string& wrong) const {
  faults_.push_back({table_.path, row_.line, column, field(column), wrong});
}

void RowCheck::expect_run_id(const nlohmann::json* run) const {
  if (run == nullptr || !run->is_object()) return;
  const nlohmann::json id = run->value("run_id", nlohmann::json());
  expect(id == field("run_id"), "run_id", fmt::format("is not run.json's {}", id.dump()));
}

}  // namespace touchmark::bench::results::validation

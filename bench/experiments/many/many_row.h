/// What one contestant did with one set of points: a row of many.csv and of the printed table.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/column.h"
#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"
#include "core/search/many/many_options.h"

namespace touchmark::bench::experiments::many {

inline constexpr int many_schema = 1;

struct ManyRow {
  std::string detector;
  std::string options;  ///< as written out: "key=value,..."
  std::string mesh;
  std::size_t triangles = 0;
  std::string kind;
  std::size_t points = 0;  ///< a call's
  std::size_t calls = 0;
  double reach = 0;  ///< mesh units
  unsigned threads = 1;
  AskOrder order = AskOrder::automatic;
  std::size_t rounds = 0;
  double ns_per_point = 0;                  ///< median of the rounds
  std::optional<double> embree_ratio = {};  ///< Embree's time over this one's, median of the rounds
  std::size_t answered = 0;                 ///< points with something in reach, of all calls
  std::size_t differing = 0;                ///< answers that are not as they have to be
  std::string status = "ok";                ///< else wrong

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
};

std::string_view name_of(AskOrder order) noexcept;
/// Nothing for another name.
std::optional<AskOrder> order_named(std::string_view name) noexcept;

/// The columns of many.csv, schema 1. Columns are only ever appended.
std::span<const results::Column<ManyRow>> many_columns();

std::string many_csv(const std::vector<ManyRow>& rows);
std::string many_table(const std::vector<ManyRow>& rows);

/// Checks that a file is a many.csv of schema 1, and agrees with itself.
void check_many(const results::validation::CsvTable& table, results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::many

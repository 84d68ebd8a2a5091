/// Names of queries and of sides on the command line and in CSV.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "bench/workload/answer.h"

namespace touchmark::bench::workload {

/// What `all` stands for: the queries about one mesh.
inline constexpr std::array<Query, 3> all_queries{Query::touches, Query::nearest, Query::sweep};
inline constexpr std::array<Query, 4> queries_of_scenes{Query::touches, Query::nearest, Query::sweep,
                                                        Query::moving};

constexpr std::string_view name_of(Query query) noexcept {
  switch (query) {
    case Query::touches:
      return "touches";
    case Query::nearest:
      return "nearest";
    case Query::sweep:
      return "sweep";
    case Query::moving:
      return "moving";
  }
  return "";
}

constexpr std::optional<Query> query_named(std::string_view name) noexcept {
  for (const Query query : queries_of_scenes)
    if (name_of(query) == name) return query;
  return std::nullopt;
}

/// Returns "outside", "inside", "on_surface" or "undecided"; empty text where the side was not asked for.
inline const char* name_of(Side side) noexcept {
  switch (side) {
    case Side::unasked:
      return "";
    case Side::outside:
      return "outside";
    case Side::inside:
      return "inside";
    case Side::on_surface:
      return "on_surface";
    case Side::undecided:
      return "undecided";
  }
  return "";
}

}  // namespace touchmark::bench::workload

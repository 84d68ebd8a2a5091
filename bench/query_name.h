/// The queries' names on the command line and in CSV.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "bench/answer.h"

namespace touchmark::bench {

inline constexpr std::array<Query, 3> all_queries{Query::touches, Query::nearest, Query::sweep};

constexpr std::string_view name_of(Query query) noexcept {
  switch (query) {
    case Query::touches:
      return "touches";
    case Query::nearest:
      return "nearest";
    case Query::sweep:
      return "sweep";
  }
  return "";
}

constexpr std::optional<Query> query_named(std::string_view name) noexcept {
  for (const Query query : all_queries) {
    if (name_of(query) == name) return query;
  }
  return std::nullopt;
}

}  // namespace touchmark::bench

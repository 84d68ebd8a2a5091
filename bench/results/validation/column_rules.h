/// What each column of results.csv, schema 1, may hold.
#pragma once

#include <span>
#include <string_view>

namespace touchmark::bench::results::validation {

enum class Presence {
  always,
  optional,
  judged,  ///< in every row whose status is ok
  built,   ///< in every row whose status is ok, in a file with times; may be there in others
  timed,   ///< as built, but must be empty in every other row
};

struct ColumnRule {
  std::string_view name;
  Presence presence;
  bool (*accepts)(std::string_view text);  ///< asked only when there is text
  std::string_view expected;               ///< what a fault says the value is not
};

/// In the order of the file. A file may end earlier, but not before `columns_of_the_contract`, and may have
/// further columns that are not known here.
std::span<const ColumnRule> column_rules();

inline constexpr std::size_t columns_of_the_contract = 36;

}  // namespace touchmark::bench::results::validation

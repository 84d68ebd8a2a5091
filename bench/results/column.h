/// Columns of the CSV files: what a column is called, what writes it, what it may hold, and what it means.
/// The writer, `touchmark validate` and the reference all go by the one table of a file.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "bench/support/numbers.h"
#include "bench/support/table.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {

/// When a column must be filled in.
enum class Presence {
  always,
  optional,
  judged,  ///< in every row whose status is ok
  built,   ///< in every row whose status is ok, in a file with times; may be there in others
  timed,   ///< as built, but must be empty in every other row
};

/// What the text of a column may be. It is asked only when there is text.
struct Kind {
  bool (*accepts)(std::string_view text);
  std::string_view what;  ///< completes "is not ..."
};

namespace kinds {

using Text = std::string_view;

/// Returns true if `text` is a number that `accepts` takes.
template <class Accepts>
bool is_number(Text text, Accepts accepts) {
  const std::optional<double> value = support::parse_number(text);
  return value && *value >= 0 && accepts(*value);
}

inline constexpr Kind any_text{[](Text) { return true; }, "text"};
inline constexpr Kind one{[](Text text) { return text == "1"; }, "1"};
inline constexpr Kind bit{[](Text text) { return text == "0" || text == "1"; }, "0 or 1"};
inline constexpr Kind whole_number{[](Text text) { return support::parse_count(text).has_value(); },
                                   "a whole number of 0 or more"};
inline constexpr Kind positive_count{[](Text text) { return support::parse_count(text).value_or(0) > 0; },
                                     "a whole number above 0"};
inline constexpr Kind length{[](Text text) { return is_number(text, [](double) { return true; }); },
                             "a number of 0 or more, or inf"};
inline constexpr Kind finite{
    [](Text text) { return is_number(text, [](double x) { return std::isfinite(x); }); },
    "a finite number of 0 or more"};
inline constexpr Kind positive{
    [](Text text) { return is_number(text, [](double x) { return x > 0 && std::isfinite(x); }); },
    "a finite number above 0"};
inline constexpr Kind share{[](Text text) { return is_number(text, [](double x) { return x <= 1; }); },
                            "a share from 0 to 1"};
inline constexpr Kind checksum{[](Text text) { return support::is_hex(text); }, "16 hexadecimal digits"};
inline constexpr Kind query{[](Text text) { return workload::query_named(text).has_value(); },
                            "one of touches, nearest, sweep, moving"};
inline constexpr Kind guarantee{
    [](Text text) { return text == "exact" || text == "conservative" || text == "approximate"; },
    "one of exact, conservative, approximate"};

}  // namespace kinds

/// One column of a table of `Row`s.
template <class Row>
struct Column {
  std::string_view name;
  std::string (*value)(const Row& row);  ///< null in the column of the run's id, which no row knows
  Presence presence = Presence::optional;
  Kind kind = kinds::any_text;
  std::string_view means = {};  ///< for the reference, in Markdown
};

/// What `write` makes of the value that `members` lead to, each a member or a function of the one before.
/// Nothing where an optional on the way is empty.
template <class Write, class Value, class... Members>
std::string written(const Write& write, const Value& value, Members... members) {
  if constexpr (requires { value.has_value(); }) {
    return value ? written(write, *value, members...) : std::string();
  } else if constexpr (sizeof...(Members) == 0) {
    return write(value);
  } else {
    return [&](auto first, auto... rest) {
      return written(write, std::invoke(first, value), rest...);
    }(members...);
  }
}

/// A column's text: names of enumerations, 1 for true, and numbers so that they read back the same.
template <auto... Members, class Row>
std::string text(const Row& row) {
  const auto write = []<class Value>(const Value& value) {
    if constexpr (std::is_enum_v<Value>)
      return std::string(name_of(value));
    else if constexpr (std::is_same_v<Value, bool>)
      return std::string(value ? "1" : "0");
    else
      return fmt::format("{}", value);
  };
  return written(write, row, Members...);
}

/// Returns the same of a number with so many digits. Times have six: more than the clock has would be noise.
template <int digits, auto... Members, class Row>
std::string rounded(const Row& row) {
  const auto write = [](auto value) { return fmt::format("{:.{}g}", static_cast<double>(value), digits); };
  return written(write, row, Members...);
}

template <class Columns>
std::vector<std::string> names_of(const Columns& columns) {
  std::vector<std::string> names;
  for (const auto& column : columns) names.emplace_back(column.name);
  return names;
}

template <class Columns, class Row>
std::vector<std::string> fields_of(const Columns& columns, const Row& row, const std::string& run_id) {
  std::vector<std::string> fields;
  for (const auto& column : columns) fields.push_back(column.value != nullptr ? column.value(row) : run_id);
  return fields;
}

template <class Columns, class Rows>
support::Table table_of(const Columns& columns, const Rows& rows, const std::string& run_id = "") {
  support::Table table(names_of(columns));
  for (const auto& row : rows) table.add(fields_of(columns, row, run_id));
  return table;
}

}  // namespace touchmark::bench::results

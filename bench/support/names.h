/// Names of an enumeration's values, from one table in both directions.
#pragma once

#include <optional>
#include <string_view>

namespace touchmark::bench::support {

template <class Value>
struct Name {
  Value value;
  std::string_view name;
};

/// Returns the value's name; empty where the table has none.
template <class Value>
constexpr std::string_view name_in(const auto& names, Value value) noexcept {
  for (const Name<Value>& one : names)
    if (one.value == value) return one.name;
  return "";
}

template <class Value>
constexpr std::optional<Value> value_in(const auto& names, std::string_view name) noexcept {
  for (const Name<Value>& one : names)
    if (one.name == name) return one.value;
  return std::nullopt;
}

}  // namespace touchmark::bench::support

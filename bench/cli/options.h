/// Options of a command line, a line each: the name, the variable, the type in the help, and the meaning.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace touchmark::bench::cli {

/// Adds an option. The help shows the variable's value as the default, unless it is empty.
template <class Value>
CLI::Option* add_value(CLI::App& command, const char* name, Value& value, const char* type,
                       const std::string& what) {
  CLI::Option* const option = command.add_option(name, value, what)->type_name(type);
  if constexpr (requires { value.front(); } && !std::is_same_v<Value, std::string>) return option;
  return option->capture_default_str();
}

/// Adds an option that may be repeated, with one value each time.
inline CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& values,
                             const char* type, const std::string& what) {
  return command.add_option(name, values, what)->type_name(type)->expected(1)->take_all();
}

/// Returns the values that were given, or those otherwise.
inline std::vector<std::string> or_else(const std::vector<std::string>& given,
                                        std::vector<std::string> otherwise) {
  return given.empty() ? std::move(otherwise) : given;
}

}  // namespace touchmark::bench::cli

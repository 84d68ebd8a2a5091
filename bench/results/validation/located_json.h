/// A JSON document that remembers on which line each value stands.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "bench/results/validation/fault.h"

namespace touchmark::bench::results::validation {

struct LocatedJson {
  nlohmann::json value;
  std::map<std::string, std::size_t> lines;  ///< by JSON pointer (RFC 6901); from 1

  /// Returns the line of the value, or of the nearest that holds it.
  std::size_t line_of(const std::string& pointer) const;
};

/// Nothing, and a fault, when the text is not JSON; a fault for each key that an object has twice. Throws
/// std::invalid_argument when the file cannot be read.
std::optional<LocatedJson> read_located_json(const std::string& path, Faults& faults);

}  // namespace touchmark::bench::results::validation

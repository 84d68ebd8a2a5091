/// The part of JSON Schema, draft 7, that this project's schemas use.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/results/validation/fault.h"
#include "bench/results/validation/located_json.h"

namespace touchmark::bench::results::validation {

struct SchemaFault {
  std::string pointer;  ///< names the offending value
  std::string value;    ///< as text; of objects and arrays only their size
  std::string wrong;    ///< "is not of type integer"
};

class JsonSchema {
 public:
  /// Throws std::logic_error for a keyword it does not know, so that none is passed over in silence.
  explicit JsonSchema(nlohmann::json schema);

  std::vector<SchemaFault> check(const nlohmann::json& document) const;
  /// Appends what is wrong as faults of the file that the document was read from.
  void check(const std::string& path, const LocatedJson& document, Faults& faults) const;

 private:
  nlohmann::json schema_;
};

}  // namespace touchmark::bench::results::validation

#include "bench/results/validation/json_schema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace touchmark::bench::results::validation {
namespace {

using Json = nlohmann::json;

struct Location {
  std::string pointer;
  const Json& value;
};

void check(const Json& schema, const Location& location, std::vector<SchemaFault>& faults);

bool has_type(const Json& value, std::string_view type) {
  if (type == "integer")
    return value.is_number_integer() ||
           (value.is_number_float() && value.get<double>() == std::trunc(value.get<double>()));
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "number" && value.is_number()) ||
         (type == "boolean" && value.is_boolean()) || (type == "null" && value.is_null());
}

/// Names only the kind of objects and arrays: they may be nested deeper than dump() can recur.
std::string shown(const Json& value) {
  if (value.is_object()) return fmt::format("{{{} members}}", value.size());
  if (value.is_array()) return fmt::format("[{} items]", value.size());
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void fail(const Location& location, std::string wrong, std::vector<SchemaFault>& faults) {
  faults.push_back({location.pointer, shown(location.value), std::move(wrong)});
}

std::string child(const Location& location, const std::string& key) { return location.pointer + "/" + key; }

void check_members(const Json& schemas, const Location& location, std::vector<SchemaFault>& faults) {
  for (const auto& [key, member] : location.value.items())
    if (schemas.contains(key)) check(schemas[key], {child(location, key), member}, faults);
}

void check_required(const Json& keys, const Location& location, std::vector<SchemaFault>& faults) {
  for (const Json& key : keys) {
    if (location.value.contains(key.get<std::string>())) continue;
    faults.push_back({child(location, key), "", "is missing"});
  }
}

/// Checks all members: no schema has `properties` beside it, which would name some of them.
void check_every_member(const Json& schema, const Location& location, std::vector<SchemaFault>& faults) {
  for (const auto& [key, member] : location.value.items())
    check(schema, {child(location, key), member}, faults);
}

void check_items(const Json& schema, const Location& location, std::vector<SchemaFault>& faults) {
  for (std::size_t i = 0; i < location.value.size(); ++i)
    check(schema, {child(location, std::to_string(i)), location.value[i]}, faults);
}

void check_pattern(const Json& keyword, const Location& location, std::vector<SchemaFault>& faults) {
  constexpr std::size_t longest = 4096;  // the library's matcher recurs once a character
  const auto& pattern = keyword.get_ref<const std::string&>();
  const auto& text = location.value.get_ref<const std::string&>();
  if (text.size() > longest || !std::regex_search(text, std::regex(pattern)))
    fail(location, fmt::format("does not match {}", pattern), faults);
}

void check_any_of(const Json& schemas, const Location& location, std::vector<SchemaFault>& faults) {
  for (const Json& schema : schemas) {
    std::vector<SchemaFault> within;
    check(schema, location, within);
    if (within.empty()) return;
  }
  fail(location, fmt::format("is none of {}", schemas.dump()), faults);
}

void check_type(const Json& types, const Location& location, std::vector<SchemaFault>& faults) {
  if (!has_type(location.value, types.get<std::string>()))
    fail(location, fmt::format("is not of type {}", types.get<std::string>()), faults);
}

using J = const Json&;

struct Keyword {
  std::string_view name;
  std::string_view of;  ///< the type of the values that it is about; empty: any
  void (*check)(J keyword, const Location& location, std::vector<SchemaFault>& faults);
  bool (*holds)(J limit, J value) = nullptr;  ///< asked where check is null
  const char* wrong = "";  ///< told where the limit does not hold; {}: it; {1}: the value's size
};

constexpr std::array keywords{
    Keyword{"type", "", &check_type},
    Keyword{"properties", "object", &check_members},
    Keyword{"required", "object", &check_required},
    Keyword{"additionalProperties", "object", &check_every_member},
    Keyword{"items", "array", &check_items},
    Keyword{"pattern", "string", &check_pattern},
    Keyword{"anyOf", "", &check_any_of},
    Keyword{"const", "", nullptr, [](J limit, J value) { return value == limit; }, "is not {}"},
    Keyword{"enum", "", nullptr,
            [](J limit, J value) { return std::ranges::find(limit, value) != limit.end(); }, "is none of {}"},
    Keyword{"minLength", "string", nullptr,
            [](J limit, J value) { return value.get_ref<const std::string&>().size() >= limit; },
            "is too short"},
    Keyword{"minimum", "number", nullptr, [](J limit, J value) { return value >= limit; }, "is below {}"},
    Keyword{"maximum", "number", nullptr, [](J limit, J value) { return value <= limit; }, "is above {}"},
    Keyword{"minItems", "array", nullptr, [](J limit, J value) { return value.size() >= limit; },
            "has {1} items, not at least {0}"},
    Keyword{"maxItems", "array", nullptr, [](J limit, J value) { return value.size() <= limit; },
            "has {1} items, not at most {0}"}};

constexpr std::array notes{"$schema", "$id", "title", "description"};

const Keyword* keyword_named(const std::string& name) {
  const auto* const found =
      std::ranges::find_if(keywords, [&](const Keyword& keyword) { return keyword.name == name; });
  return found == keywords.end() ? nullptr : &*found;
}

void check(const Json& schema, const Location& location, std::vector<SchemaFault>& faults) {
  for (const auto& [name, value] : schema.items()) {
    const Keyword* const keyword = keyword_named(name);
    if (keyword == nullptr || (!keyword->of.empty() && !has_type(location.value, keyword->of))) continue;
    if (keyword->check != nullptr)
      keyword->check(value, location, faults);
    else if (!keyword->holds(value, location.value))
      fail(location, fmt::format(fmt::runtime(keyword->wrong), value.dump(), location.value.size()), faults);
  }
}

/// Throws for what check() would pass over.
void expect_known_keywords(const Json& schema) {
  if (!schema.is_object()) throw std::logic_error("a schema is not an object: " + schema.dump());
  for (const auto& [name, value] : schema.items()) {
    const bool is_note = std::ranges::find(notes, name) != notes.end();
    if (!is_note && keyword_named(name) == nullptr) throw std::logic_error("unknown schema keyword " + name);
    if (name == "items" || name == "additionalProperties") expect_known_keywords(value);
    if (name == "properties" || name == "anyOf") {
      for (const Json& within : value) expect_known_keywords(within);
    }
  }
  if (schema.contains("properties") && schema.contains("additionalProperties"))
    throw std::logic_error("properties and additionalProperties of one schema");
}

}  // namespace

JsonSchema::JsonSchema(nlohmann::json schema) : schema_(std::move(schema)) { expect_known_keywords(schema_); }

std::vector<SchemaFault> JsonSchema::check(const nlohmann::json& document) const {
  std::vector<SchemaFault> faults;
  validation::check(schema_, {"", document}, faults);
  return faults;
}

void JsonSchema::check(const std::string& path, const LocatedJson& document, Faults& faults) const {
  for (const SchemaFault& fault : check(document.value))
    faults.push_back({path, document.line_of(fault.pointer), fault.pointer.empty() ? "/" : fault.pointer,
                      fault.value, fault.wrong});
}

}  // namespace touchmark::bench::results::validation

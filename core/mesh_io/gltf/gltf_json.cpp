#include "core/mesh_io/gltf/gltf_json.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/mesh_io/mesh_builder.h"

namespace touchmark::mesh_io {
namespace {

using Json = nlohmann::json;

const Json& json(const void* value) { return *static_cast<const Json*>(value); }

/// Refuses what is not JSON and what the parser would take: keys that it would overwrite, and any depth.
class Strictness final : public nlohmann::json_sax<Json> {
 public:
  explicit Strictness(std::string_view text) : text_(text) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return begin(); }
  bool end_object() override { return end(); }
  bool start_array(std::size_t) override { return begin(); }
  bool end_array() override { return end(); }
  bool key(string_t& name) override {
    if (!keys_.back().insert(name).second)
      throw MeshError("its JSON has the key " + mesh_io::quoted(name) + " twice in one object");
    return true;
  }
  bool parse_error(std::size_t byte, const std::string&, const Json::exception& error) override {
    constexpr int number_overflows = 406;
    const std::string_view before = text_.substr(0, byte);
    throw MeshError("line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ": " +
                    (error.id == number_overflows ? "a number does not fit a double"
                     : byte > text_.size()        ? "its JSON ends early"
                                                  : "is not JSON"));
  }

 private:
  bool begin() {
    constexpr std::size_t max_depth = 512;  // glTF's own takes a dozen
    keys_.emplace_back();
    if (keys_.size() > max_depth)
      throw MeshError("its JSON nests more than " + std::to_string(max_depth) + " values");
    return true;
  }
  bool end() {
    keys_.pop_back();
    return true;
  }

  std::string_view text_;
  std::vector<std::set<std::string>> keys_;  // of the objects and arrays that the parser is in
};

}  // namespace

std::optional<JsonValue> JsonValue::find(const char* key) const {
  if (!json(value_).is_object()) fail("is not an object");
  const auto found = json(value_).find(key);
  if (found == json(value_).end()) return std::nullopt;
  return JsonValue(&*found, place_.empty() ? key : place_ + "." + key);
}

JsonValue JsonValue::at(const char* key) const {
  if (std::optional<JsonValue> member = find(key)) return *std::move(member);
  fail(std::string("has no ") + key);
}

bool JsonValue::lists(std::string_view text) const {
  for (std::size_t i = 0; i < size(); ++i)
    if ((*this)[i].text() == text) return true;
  return false;
}

std::size_t JsonValue::size() const {
  if (!json(value_).is_array()) fail("is not an array");
  return json(value_).size();
}

JsonValue JsonValue::operator[](std::size_t i) const {
  return {&json(value_)[i], place_ + "[" + std::to_string(i) + "]"};
}

double JsonValue::number() const {
  if (!json(value_).is_number()) fail("is not a number");
  return json(value_).get<double>();
}

std::size_t JsonValue::whole() const {
  constexpr double max_exact = 0x1p53;
  const double value = number();
  if (!(value >= 0 && value <= max_exact) || value != std::floor(value))
    fail("is " + json(value_).dump() + ", which is no whole number from 0 to 2^53");
  return static_cast<std::size_t>(value);
}

std::size_t JsonValue::whole(const char* key, std::size_t otherwise) const {
  const std::optional<JsonValue> member = find(key);
  return member ? member->whole() : otherwise;
}

std::string JsonValue::text() const {
  if (!json(value_).is_string()) fail("is not a text");
  return json(value_).get<std::string>();
}

bool JsonValue::is_true() const {
  if (!json(value_).is_boolean()) fail("is neither true nor false");
  return json(value_).get<bool>();
}

void JsonValue::fail(const std::string& message) const {
  throw MeshError((place_.empty() ? "the file" : place_ + ":") + " " + message);
}

struct JsonDocument::Parsed {
  Json json;
};

JsonDocument::JsonDocument(std::string_view text) : parsed_(std::make_unique<Parsed>()) {
  const std::size_t zero = text.find('\0');  // the parser takes it for the end
  if (zero != std::string_view::npos && !is_padding(text.substr(zero)))
    throw MeshError("its JSON has a zero byte, with more after it");
  Strictness strictness(text);
  Json::sax_parse(text.begin(), text.end(), &strictness);
  parsed_->json = Json::parse(text.begin(), text.end());
}

JsonDocument::~JsonDocument() = default;

JsonValue JsonDocument::root() const { return {&parsed_->json, ""}; }

}  // namespace touchmark::mesh_io

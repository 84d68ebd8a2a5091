/// A glTF file's JSON, checked where it is read.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace touchmark::mesh_io {

/// A value and its place, such as "nodes[3].scale", which errors name. Valid as long as its document is.
class JsonValue {
 public:
  JsonValue(const void* value, std::string place) : value_(value), place_(std::move(place)) {}

  /// Returns the member of an object, or nothing where the object lacks it.
  std::optional<JsonValue> find(const char* key) const;
  JsonValue at(const char* key) const;
  /// True if this is an array with this text in it.
  bool lists(std::string_view text) const;
  /// Returns the number of elements of an array.
  std::size_t size() const;
  JsonValue operator[](std::size_t i) const;
  double number() const;
  /// Returns a whole number from 0 to 2^53.
  std::size_t whole() const;
  /// Returns a member that is a whole number, or `otherwise` where there is none.
  std::size_t whole(const char* key, std::size_t otherwise) const;
  std::string text() const;
  bool is_true() const;
  /// Returns an array of just `n` numbers.
  template <std::size_t n>
  std::array<double, n> numbers() const {
    if (size() != n) fail("has " + std::to_string(size()) + " numbers instead of " + std::to_string(n));
    std::array<double, n> values;
    for (std::size_t i = 0; i < n; ++i) values[i] = (*this)[i].number();
    return values;
  }

  /// Throws MeshError("PLACE: message").
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const void* value_;  // of the JSON library, whose headers gltf_json.cpp alone sees
  std::string place_;  // empty: the root
};

class JsonDocument {
 public:
  /// Throws MeshError for text that is not JSON, has a key twice in one object, or nests too deeply.
  explicit JsonDocument(std::string_view text);
  ~JsonDocument();
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;
  JsonValue root() const;

 private:
  struct Parsed;
  std::unique_ptr<Parsed> parsed_;
};

}  // namespace touchmark::mesh_io

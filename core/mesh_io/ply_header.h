/// The header of a PLY file: which elements follow, and how each is stored.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace touchmark::mesh_io::ply {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(Scalar scalar) noexcept;

inline bool is_integer(Scalar scalar) noexcept {
  return scalar != Scalar::float32 && scalar != Scalar::float64;
}

struct Property {
  std::string name;
  Scalar value = Scalar::float32;
  std::optional<Scalar> length;  ///< type of a list's length
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::size_t line = 0;  ///< line of its declaration
  std::vector<Property> properties;

  /// Its place; properties.size() where there is none.
  std::size_t find(std::string_view wanted) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& property) { return property.name == wanted; });
    return static_cast<std::size_t>(found - properties.begin());
  }
  bool has(std::string_view wanted) const { return find(wanted) < properties.size(); }
  /// That of a face's or a strip's vertices.
  std::size_t indices() const { return find(has("vertex_indices") ? "vertex_indices" : "vertex_index"); }

  /// Throws MeshError with the line of the header.
  [[noreturn]] void fail(const std::string& message) const;
};

inline bool is_surface(const Element& element) {
  return element.name == "face" || element.name == "tristrips";
}

enum class Format { ascii, little_endian, big_endian };

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;

  /// Null where there is none.
  const Element* find(std::string_view name) const {
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [&](const Element& element) { return element.name == name; });
    return found == elements.end() ? nullptr : &*found;
  }

  std::size_t size = 0;  ///< bytes
  std::size_t lines = 0;
};

/// Throws MeshError for a header that is no PLY 1.0, names anything twice, or declares more than the file can
/// hold or something else than a surface: before memory is taken for it.
Header parse_header(std::string_view bytes);

}  // namespace touchmark::mesh_io::ply

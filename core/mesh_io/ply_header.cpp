#include "core/mesh_io/ply_header.h"

#include <array>
#include <utility>

#include "core/mesh_io/mesh_builder.h"

namespace touchmark::mesh_io::ply {
namespace {

struct ScalarName {
  std::string_view name;
  Scalar scalar;
};
constexpr std::array<ScalarName, 16> scalar_names = {{{"char", Scalar::int8},
                                                      {"int8", Scalar::int8},
                                                      {"uchar", Scalar::uint8},
                                                      {"uint8", Scalar::uint8},
                                                      {"short", Scalar::int16},
                                                      {"int16", Scalar::int16},
                                                      {"ushort", Scalar::uint16},
                                                      {"uint16", Scalar::uint16},
                                                      {"int", Scalar::int32},
                                                      {"int32", Scalar::int32},
                                                      {"uint", Scalar::uint32},
                                                      {"uint32", Scalar::uint32},
                                                      {"float", Scalar::float32},
                                                      {"float32", Scalar::float32},
                                                      {"double", Scalar::float64},
                                                      {"float64", Scalar::float64}}};

Scalar parse_scalar(std::string_view word, const TextCursor& cursor) {
  for (const ScalarName& known : scalar_names)
    if (known.name == word) return known.scalar;
  cursor.fail("unknown type " + quoted(word));
}

Property parse_property(TextCursor& cursor) {
  Property property;
  std::string_view type = cursor.word_on_line();
  if (type == "list") {
    property.length = parse_scalar(cursor.word_on_line(), cursor);
    if (!is_integer(*property.length)) cursor.fail("a list's length must be an integer type");
    type = cursor.word_on_line();
  }
  property.value = parse_scalar(type, cursor);
  property.name = cursor.word_on_line();
  if (property.name.empty()) cursor.fail("a property without a name");
  return property;
}

/// The least bytes that one of these takes, so that a count can be held against the file's size.
std::size_t min_bytes(const Element& element, Format format) {
  std::size_t bytes = 0;
  for (const Property& property : element.properties)
    bytes += format == Format::ascii ? 2 : bytes_of(property.length.value_or(property.value));
  return std::max<std::size_t>(bytes, 1);
}

Format parse_format(TextCursor& cursor) {
  const std::string_view format = cursor.word_on_line();
  if (format == "ascii") return Format::ascii;
  if (format == "binary_little_endian") return Format::little_endian;
  if (format == "binary_big_endian") return Format::big_endian;
  cursor.fail("unknown format " + quoted(format));
}

void add_element(Header& header, TextCursor& cursor) {
  Element element;
  element.line = cursor.line();
  element.name = cursor.word_on_line();
  const std::int64_t count = parse_integer(cursor.word_on_line(), "an element's count", cursor);
  if (count < 0)
    cursor.fail("element " + mesh_io::quoted(element.name) + " has count " + std::to_string(count));
  if (header.find(element.name) != nullptr)
    cursor.fail("element " + mesh_io::quoted(element.name) + " stands in the header twice");
  element.count = static_cast<std::size_t>(count);
  header.elements.push_back(std::move(element));
}

void add_property(Header& header, TextCursor& cursor) {
  if (header.elements.empty()) cursor.fail("a property before any element");
  Element& element = header.elements.back();
  Property property = parse_property(cursor);
  if (element.has(property.name))
    cursor.fail("element " + mesh_io::quoted(element.name) + " has property " +
                mesh_io::quoted(property.name) + " twice");
  element.properties.push_back(std::move(property));
}

Header parse(std::string_view bytes) {
  TextCursor cursor(without_byte_order_mark(bytes));
  if (cursor.word() != "ply") cursor.fail("does not start with 'ply'");
  Header header;
  std::size_t formats = 0;
  for (;;) {
    const std::string_view keyword = cursor.word();
    if (keyword == "format") {
      header.format = parse_format(cursor);
      if (++formats > 1) cursor.fail("a second format");
    } else if (keyword == "element") {
      add_element(header, cursor);
    } else if (keyword == "property") {
      add_property(header, cursor);
    } else if (keyword == "end_header") {
      break;
    } else if (keyword.empty()) {
      cursor.fail("the header has no end_header");
    } else if (keyword != "comment" && keyword != "obj_info") {
      cursor.fail("unknown keyword " + quoted(keyword));
    }
    cursor.skip_line();
  }
  if (formats == 0) cursor.fail("the header names no format");
  cursor.skip_line();
  header.size = bytes.size() - cursor.rest().size();
  header.lines = cursor.line() - 1;
  return header;
}

/// Refuses what the body could not hold or mean, before memory is taken for it.
void check(const Header& header, std::size_t file_size) {
  for (const Element& element : header.elements) {
    const std::size_t least = min_bytes(element, header.format);
    if (element.count > file_size / least)
      throw MeshError("the header declares " + std::to_string(element.count) + " of element " +
                      mesh_io::quoted(element.name) + ", of at least " + std::to_string(least) +
                      " bytes each; the file has " + std::to_string(file_size) + " bytes");
    if (element.name == "vertex") {
      for (const std::string_view axis : {"x", "y", "z"})
        if (!element.has(axis) || element.properties[element.find(axis)].length)
          element.fail("has no coordinate " + std::string(axis));
    }
    if (is_surface(element)) {
      const std::size_t at = element.indices();
      if (at == element.properties.size() || !element.properties[at].length)
        element.fail("has no list vertex_indices");
    }
  }
  const Element* const grid = header.find("range_grid");
  if (header.find("vertex") == nullptr) throw MeshError("the header has no element vertex");
  const auto holds = [&](const Element* element) { return element != nullptr && element->count > 0; };
  const Element *const faces = header.find("face"), *const edges = header.find("edge");
  if (holds(faces) || holds(header.find("tristrips"))) return;
  if (grid != nullptr) grid->fail("is not supported, and there are no faces");
  if (holds(edges)) edges->fail("is no surface, and there are no faces");
  if (faces != nullptr) faces->fail("has count 0: these are points without a surface");
  throw MeshError("the header has no element face: these are points without a surface");
}

}  // namespace

std::size_t bytes_of(Scalar scalar) noexcept {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(scalar)];
}

void Element::fail(const std::string& message) const {
  throw MeshError("line " + std::to_string(line) + ": element " + mesh_io::quoted(name) + " " + message);
}

Header parse_header(std::string_view bytes) {
  Header header = parse(bytes);
  check(header, bytes.size());
  return header;
}

}  // namespace touchmark::mesh_io::ply

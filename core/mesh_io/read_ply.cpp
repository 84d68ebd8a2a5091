#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh_io/mesh_file.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

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

std::size_t bytes_of(Scalar scalar) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(scalar)];
}

bool is_integer(Scalar scalar) { return scalar != Scalar::float32 && scalar != Scalar::float64; }

struct Property {
  std::string name;
  Scalar value = Scalar::float32;
  std::optional<Scalar> length;  // of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  std::size_t find(std::string_view wanted) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& property) { return property.name == wanted; });
    return static_cast<std::size_t>(found - properties.begin());
  }
};

enum class Format { ascii, little_endian, big_endian };

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
  std::size_t size = 0;  // bytes
  std::size_t lines = 0;
};

Scalar parse_scalar(std::string_view word, const TextCursor& cursor) {
  for (const ScalarName& known : scalar_names) {
    if (known.name == word) return known.scalar;
  }
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
std::size_t least_bytes(const Element& element, Format format) {
  std::size_t bytes = 0;
  for (const Property& property : element.properties) {
    bytes += format == Format::ascii ? 2 : bytes_of(property.length.value_or(property.value));
  }
  return std::max<std::size_t>(bytes, 1);
}

Header parse_header(std::string_view bytes) {
  TextCursor cursor(bytes);
  if (cursor.word() != "ply") cursor.fail("does not start with 'ply'");
  Header header;
  bool has_format = false;
  for (;;) {
    const std::string_view keyword = cursor.word();
    if (keyword == "format") {
      const std::string_view format = cursor.word_on_line();
      if (format == "ascii") {
        header.format = Format::ascii;
      } else if (format == "binary_little_endian") {
        header.format = Format::little_endian;
      } else if (format == "binary_big_endian") {
        header.format = Format::big_endian;
      } else {
        cursor.fail("unknown format " + quoted(format));
      }
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = cursor.word_on_line();
      const std::int64_t count = parse_integer(cursor.word_on_line(), "an element's count", cursor);
      if (count < 0)
        cursor.fail("element " + mesh_io::quoted(element.name) + " has count " + std::to_string(count));
      element.count = static_cast<std::size_t>(count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("a property before any element");
      header.elements.back().properties.push_back(parse_property(cursor));
    } else if (keyword == "end_header") {
      break;
    } else if (keyword.empty()) {
      cursor.fail("the header has no end_header");
    } else if (keyword != "comment" && keyword != "obj_info") {
      cursor.fail("unknown keyword " + quoted(keyword));
    }
    cursor.skip_line();
  }
  if (!has_format) cursor.fail("the header names no format");
  cursor.skip_line();
  header.size = bytes.size() - cursor.rest().size();
  header.lines = cursor.line() - 1;
  return header;
}

/// Reads the values of an ascii body.
class AsciiBody {
 public:
  AsciiBody(std::string_view text, std::size_t header_lines) : cursor_(text, 0, header_lines + 1) {}

  bool at_end() { return cursor_.at_end(); }
  double real(Scalar, std::string_view what) { return cursor_.number(what); }
  std::int64_t integer(Scalar, std::string_view what) { return cursor_.integer(what); }
  void skip(Scalar, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (cursor_.word().empty()) fail("ends in the middle of an element");
    }
  }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }
  const TextCursor& cursor() const { return cursor_; }

 private:
  TextCursor cursor_;
};

/// Reads the values of a binary body.
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, std::size_t offset, bool swapped)
      : bytes_(bytes), at_(offset), swapped_(swapped) {}

  bool at_end() const { return at_ == bytes_.size(); }
  double real(Scalar scalar, std::string_view what) {
    const double value = take(scalar);
    if (!std::isfinite(value)) fail(std::string(what) + " is not finite");
    return value;
  }
  std::int64_t integer(Scalar scalar, std::string_view what) {
    const double value = take(scalar);
    if (!is_integer(scalar) && value != std::floor(value)) fail(std::string(what) + " is not a whole number");
    if (!(std::abs(value) < 0x1p53)) fail(std::string(what) + " is out of range");
    return static_cast<std::int64_t>(value);
  }
  void skip(Scalar scalar, std::size_t count) {
    if (count > (bytes_.size() - at_) / bytes_of(scalar)) fail("ends in the middle of an element");
    at_ += count * bytes_of(scalar);
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw MeshError("byte " + std::to_string(at_) + ": " + message);
  }

 private:
  double take(Scalar scalar) {
    const std::size_t size = bytes_of(scalar);
    if (bytes_.size() - at_ < size) fail("ends in the middle of an element");
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), bytes_.data() + at_, size);
    if (swapped_) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    at_ += size;
    const auto as = [&]<class T>(T value) {
      std::memcpy(&value, raw.data(), sizeof value);
      return static_cast<double>(value);
    };
    switch (scalar) {
      case Scalar::int8:
        return as(std::int8_t{});
      case Scalar::uint8:
        return as(std::uint8_t{});
      case Scalar::int16:
        return as(std::int16_t{});
      case Scalar::uint16:
        return as(std::uint16_t{});
      case Scalar::int32:
        return as(std::int32_t{});
      case Scalar::uint32:
        return as(std::uint32_t{});
      case Scalar::float32:
        return as(float{});
      case Scalar::float64:
        return as(double{});
    }
    return 0;
  }

  std::string_view bytes_;
  std::size_t at_;
  bool swapped_;
};

template <class Body>
void skip_property(Body& body, const Property& property) {
  std::int64_t count = 1;
  if (property.length) count = body.integer(*property.length, "a list's length");
  if (count < 0) body.fail("a list of length " + std::to_string(count));
  body.skip(property.value, static_cast<std::size_t>(count));
}

template <class Body>
void read_vertices(Body& body, const Element& element, MeshBuilder& mesh) {
  const std::array<std::size_t, 3> axis = {element.find("x"), element.find("y"), element.find("z")};
  for (std::size_t i = 0; i < element.count; ++i) {
    if (body.at_end())
      body.fail("ends after " + std::to_string(i) + " of " + std::to_string(element.count) + " vertices");
    Vec3 position;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const auto found = std::find(axis.begin(), axis.end(), p);
      if (found == axis.end()) {
        skip_property(body, element.properties[p]);
      } else {
        position[found - axis.begin()] = body.real(element.properties[p].value, element.properties[p].name);
      }
    }
    mesh.add_vertex(position);
  }
}

template <class Body>
void read_faces(Body& body, const Element& element, std::size_t indices, MeshBuilder& mesh) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < element.count; ++i) {
    if (body.at_end())
      body.fail("ends after " + std::to_string(i) + " of " + std::to_string(element.count) + " faces");
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const Property& property = element.properties[p];
      if (p != indices) {
        skip_property(body, property);
        continue;
      }
      const std::int64_t size = body.integer(*property.length, "a face's number of corners");
      corners.clear();
      for (std::int64_t k = 0; k < size; ++k) {
        corners.push_back(mesh.checked_corner(body.integer(property.value, "a face's vertex"), body));
      }
      mesh.add_face(corners, body);
    }
  }
}

template <class Body>
TriangleMesh read_body(Body body, const Header& header) {
  MeshBuilder mesh;
  bool has_vertices = false, has_faces = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      mesh.reserve(element.count, 0);
      read_vertices(body, element, mesh);
      has_vertices = true;
    } else if (element.name == "face") {
      if (!has_vertices) body.fail("the faces stand before the vertices");
      std::size_t indices = element.find("vertex_indices");
      if (indices == element.properties.size()) indices = element.find("vertex_index");
      mesh.reserve(0, element.count);
      read_faces(body, element, indices, mesh);
      has_faces = true;
    } else {
      for (std::size_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) skip_property(body, property);
      }
    }
  }
  if (!has_faces) body.fail("the file has no faces");
  if (!body.at_end()) body.fail("goes on after its last element");
  return std::move(mesh).build();
}

/// Refuses what the body could not hold or mean, before memory is taken for it.
void check(const Header& header, std::size_t file_size) {
  for (const Element& element : header.elements) {
    const std::size_t least = least_bytes(element, header.format);
    if (element.count > file_size / least) {
      throw MeshError("the header declares " + std::to_string(element.count) + " of element " +
                      mesh_io::quoted(element.name) + ", of at least " + std::to_string(least) +
                      " bytes each; the file has " + std::to_string(file_size) + " bytes");
    }
    if (element.name == "vertex") {
      for (const std::string_view axis : {"x", "y", "z"}) {
        const std::size_t at = element.find(axis);
        if (at == element.properties.size() || element.properties[at].length) {
          throw MeshError("element vertex has no coordinate " + std::string(axis));
        }
      }
    }
    if (element.name == "face") {
      std::size_t at = element.find("vertex_indices");
      if (at == element.properties.size()) at = element.find("vertex_index");
      if (at == element.properties.size() || !element.properties[at].length ||
          !is_integer(element.properties[at].value)) {
        throw MeshError("element face has no list of integers vertex_indices");
      }
    }
  }
}

}  // namespace

TriangleMesh read_ply(std::string_view bytes) {
  const Header header = parse_header(bytes);
  check(header, bytes.size());
  if (header.format == Format::ascii) {
    return read_body(AsciiBody(bytes.substr(header.size), header.lines), header);
  }
  const bool swapped = (header.format == Format::big_endian) == (std::endian::native == std::endian::little);
  return read_body(BinaryBody(bytes, header.size, swapped), header);
}

}  // namespace touchmark::mesh_io

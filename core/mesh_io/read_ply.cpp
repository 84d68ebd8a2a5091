#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh_io/mesh_builder.h"
#include "core/mesh_io/ply_header.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

using ply::Element;
using ply::Format;
using ply::Header;
using ply::Property;
using ply::Scalar;

/// A vertex's number that was stored as a floating-point one.
template <class Body>
std::int64_t whole(double value, Scalar scalar, std::string_view what, const Body& body) {
  // Beyond these not every whole number is one of the type: what was meant may have been another one.
  const double exact = scalar == Scalar::float32 ? 0x1p24 : 0x1p53;
  if (value != std::floor(value)) body.fail(std::string(what) + " is not a whole number");
  if (!(std::abs(value) < exact)) body.fail(std::string(what) + " is beyond the whole numbers of its type");
  return static_cast<std::int64_t>(value);
}

/// Reads the values of an ascii body.
class AsciiBody {
 public:
  AsciiBody(std::string_view text, std::size_t header_lines) : cursor_(text, 0, header_lines + 1) {}

  bool at_end() { return cursor_.at_end(); }
  double real(Scalar, std::string_view what) { return cursor_.number(what); }
  std::int64_t integer(Scalar scalar, std::string_view what) {
    return ply::is_integer(scalar) ? cursor_.integer(what) : whole(cursor_.number(what), scalar, what, *this);
  }
  void skip(Scalar, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      if (cursor_.word().empty()) fail("ends in the middle of an element");
  }
  bool has_only_padding_left() const { return is_padding(cursor_.rest()); }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

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
    return whole(take(scalar), scalar, what, *this);
  }
  void skip(Scalar scalar, std::size_t count) {
    if (count > (bytes_.size() - at_) / ply::bytes_of(scalar)) fail("ends in the middle of an element");
    at_ += count * ply::bytes_of(scalar);
  }
  bool has_only_padding_left() const { return is_padding(bytes_.substr(at_)); }
  [[noreturn]] void fail(const std::string& message) const {
    throw MeshError("byte " + std::to_string(at_) + ": " + message);
  }

 private:
  double take(Scalar scalar) {
    const std::size_t size = ply::bytes_of(scalar);
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

/// Reads the list of vertices of a face or a strip, and skips the rest of it. A negative number is left to
/// `take`, which gets each.
template <class Body, class Take>
void read_indices(Body& body, const Element& element, const Take& take) {
  const std::size_t indices = element.indices();
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const Property& property = element.properties[p];
    if (p != indices) {
      skip_property(body, property);
      continue;
    }
    const std::int64_t size = body.integer(*property.length, "a list's length");
    for (std::int64_t k = 0; k < size; ++k) take(body.integer(property.value, "a face's vertex"));
  }
}

template <class Body>
void expect_more(Body& body, const Element& element, std::size_t done, const char* what) {
  if (body.at_end())
    body.fail("ends after " + std::to_string(done) + " of " + std::to_string(element.count) + " " + what);
}

template <class Body>
void read_faces(Body& body, const Element& element, MeshBuilder& mesh) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < element.count; ++i) {
    expect_more(body, element, i, "faces");
    corners.clear();
    read_indices(body, element,
                 [&](std::int64_t vertex) { corners.push_back(mesh.checked_corner(vertex, body)); });
    mesh.add_face(corners, body);
  }
}

/// A strip's triangles turn alternately the one and the other way; -1 begins another strip. A triangle that
/// has a vertex twice only leads to the next one, and is no face.
template <class Body>
void read_strips(Body& body, const Element& element, MeshBuilder& mesh) {
  for (std::size_t i = 0; i < element.count; ++i) {
    expect_more(body, element, i, "triangle strips");
    std::uint32_t a = 0, b = 0;
    std::size_t length = 0;
    read_indices(body, element, [&](std::int64_t vertex) {
      if (vertex == -1) {
        length = 0;
        return;
      }
      const std::uint32_t c = mesh.checked_corner(vertex, body);
      if (++length >= 3 && a != b && b != c && c != a)
        length % 2 == 1 ? mesh.add_triangle(a, b, c) : mesh.add_triangle(b, a, c);
      a = b;
      b = c;
    });
  }
}

template <class Body>
void read_surface(Body& body, const Element& element, MeshBuilder& mesh) {
  if (element.name == "face") {
    mesh.reserve(0, element.count);
    read_faces(body, element, mesh);
  } else {
    read_strips(body, element, mesh);
  }
}

template <class Body>
void skip(Body& body, const Element& element) {
  for (std::size_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) skip_property(body, property);
}

template <class Body>
TriangleMesh read_body(Body body, const Header& header) {
  MeshBuilder mesh;
  bool has_vertices = false;
  std::vector<std::pair<Body, const Element*>> before_vertices;  // surfaces, to be read once these are known
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      mesh.reserve(element.count, 0);
      read_vertices(body, element, mesh);
      has_vertices = true;
      for (auto& [there, surface] : before_vertices) read_surface(there, *surface, mesh);
    } else if (ply::is_surface(element) && has_vertices) {
      read_surface(body, element, mesh);
    } else {
      if (ply::is_surface(element)) before_vertices.emplace_back(body, &element);
      skip(body, element);
    }
  }
  if (!body.at_end() && !body.has_only_padding_left()) body.fail("goes on after its last element");
  return std::move(mesh).build();
}

}  // namespace

TriangleMesh read_ply(std::string_view bytes) {
  const Header header = ply::parse_header(bytes);
  if (header.format == Format::ascii)
    return read_body(AsciiBody(bytes.substr(header.size), header.lines), header);
  const bool swapped = (header.format == Format::big_endian) == (std::endian::native == std::endian::little);
  return read_body(BinaryBody(bytes, header.size, swapped), header);
}

}  // namespace touchmark::mesh_io

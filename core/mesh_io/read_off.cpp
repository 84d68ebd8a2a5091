#include <optional>
#include <string>

#include "core/mesh_io/mesh_file.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

/// What stands in a vertex's line before the values that are not used here.
struct Form {
  bool homogeneous = false;       // a fourth coordinate, by which the others are divided
  bool states_dimension = false;  // "n": the number of coordinates follows
};

/// [ST][C][N][4][n]OFF, as Geomview writes it. Texture coordinates, colours and normals follow the position.
std::optional<Form> form_of(std::string_view header) {
  Form form;
  const auto takes = [&](std::string_view prefix) {
    if (!header.starts_with(prefix)) return false;
    header.remove_prefix(prefix.size());
    return true;
  };
  takes("ST");
  takes("C");
  takes("N");
  form.homogeneous = takes("4");
  form.states_dimension = takes("n");
  return header == "OFF" ? std::optional(form) : std::nullopt;
}

bool is_count(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
}

/// The header may be missing: then the counts come first.
Form read_form(TextCursor& cursor) {
  TextCursor ahead = cursor;
  const std::string_view header = ahead.word();
  if (is_count(header)) return {};
  const std::optional<Form> form = form_of(header);
  if (!form) ahead.fail("starts with " + quoted(header) + " instead of OFF");
  cursor = ahead;
  if (ahead.word() == "BINARY") ahead.fail("binary OFF is not supported");
  if (form->states_dimension) {
    const std::int64_t dimension = cursor.integer("the dimension");
    if (dimension != 3) cursor.fail("dimension " + std::to_string(dimension) + " is not supported; 3 is");
  }
  return *form;
}

/// A count that the rest of the file can hold, at two bytes a value.
std::size_t count(TextCursor& cursor, std::string_view what, std::size_t file_size) {
  const std::int64_t value = cursor.integer(what);
  if (value < 0 || static_cast<std::uint64_t>(value) > file_size / 2) {
    cursor.fail(std::string(what) + " " + std::to_string(value) + " in a file of " +
                std::to_string(file_size) + " bytes");
  }
  return static_cast<std::size_t>(value);
}

Vec3 read_position(TextCursor& cursor, const Form& form) {
  const double x = cursor.number_on_line("x"), y = cursor.number_on_line("y"), z = cursor.number_on_line("z");
  if (!form.homogeneous) return {x, y, z};
  const double w = cursor.number_on_line("w");
  const Vec3 position(x / w, y / w, z / w);
  if (!position.allFinite()) cursor.fail("a vertex at infinity");
  return position;
}

}  // namespace

TriangleMesh read_off(std::string_view bytes) {
  bytes = without_byte_order_mark(bytes);
  TextCursor cursor(bytes, '#');
  const Form form = read_form(cursor);
  const std::size_t vertices = count(cursor, "the number of vertices", bytes.size());
  const std::size_t faces = count(cursor, "the number of faces", bytes.size());
  cursor.integer("the number of edges");
  cursor.skip_line();

  MeshBuilder mesh;
  mesh.reserve(vertices, faces);
  for (std::size_t i = 0; i < vertices; ++i) {
    if (cursor.at_end())
      cursor.fail("ends after " + std::to_string(i) + " of " + std::to_string(vertices) + " vertices");
    mesh.add_vertex(read_position(cursor, form));
    cursor.skip_line();
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < faces; ++i) {
    if (cursor.at_end())
      cursor.fail("ends after " + std::to_string(i) + " of " + std::to_string(faces) + " faces");
    const std::size_t size = count(cursor, "a face's number of corners", bytes.size());
    corners.clear();
    for (std::size_t k = 0; k < size; ++k) {
      corners.push_back(
          mesh.checked_corner(parse_integer(cursor.word_on_line(), "a face's vertex", cursor), cursor));
    }
    mesh.add_face(corners, cursor);
    cursor.skip_line();
  }
  if (!cursor.at_end() && !is_padding(cursor.rest()))
    cursor.fail("goes on after its " + std::to_string(faces) + " faces");
  return std::move(mesh).build();
}

}  // namespace touchmark::mesh_io

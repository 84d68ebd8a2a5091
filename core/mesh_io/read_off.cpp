#include <string>

#include "core/mesh_io/mesh_file.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

/// The header's letters before "OFF" announce values after a vertex's position; none of them are used here.
bool is_header(std::string_view word) {
  if (word.size() < 3 || word.substr(word.size() - 3) != "OFF") return false;
  const std::string_view before = word.substr(0, word.size() - 3);
  return before.find_first_not_of("STCN") == before.npos;
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

}  // namespace

TriangleMesh read_off(std::string_view bytes) {
  TextCursor cursor(bytes, '#');
  const std::string_view header = cursor.word();
  if (!is_header(header)) cursor.fail("starts with " + quoted(header) + " instead of OFF");
  const std::size_t vertices = count(cursor, "the number of vertices", bytes.size());
  if (vertices == 0 && bytes.find("BINARY") != bytes.npos) cursor.fail("binary OFF is not supported");
  const std::size_t faces = count(cursor, "the number of faces", bytes.size());
  cursor.integer("the number of edges");
  cursor.skip_line();

  MeshBuilder mesh;
  mesh.reserve(vertices, faces);
  for (std::size_t i = 0; i < vertices; ++i) {
    if (cursor.at_end())
      cursor.fail("ends after " + std::to_string(i) + " of " + std::to_string(vertices) + " vertices");
    const double x = cursor.number_on_line("x"), y = cursor.number_on_line("y"),
                 z = cursor.number_on_line("z");
    mesh.add_vertex({x, y, z});
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
  if (!cursor.at_end()) cursor.fail("goes on after its " + std::to_string(faces) + " faces");
  return std::move(mesh).build();
}

}  // namespace touchmark::mesh_io

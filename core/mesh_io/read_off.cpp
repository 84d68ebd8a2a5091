#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "core/mesh_io/mesh_builder.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

/// What the header says about the position. Texture coordinates, colours and normals follow it.
struct Form {
  bool homogeneous = false;          // a fourth coordinate, by which the others are divided
  bool states_dimension = false;     // "n": the number of coordinates follows
  bool may_state_dimension = false;  // "n" in lower case throughout: this or "N", which is for normals
};

bool is_count(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
}

std::string upper_case(std::string_view word, char kept = 0) {
  std::string upper(word);
  for (char& c : upper)
    if (c != kept) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return upper;
}

/// Cuts "OFF" off `word`, with what stands before it: ST, C, N, 4 and n, each at most once, in any order.
std::optional<Form> take_form(std::string_view& word) {
  const bool is_lower = std::none_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  const std::string header = upper_case(word, is_lower ? 0 : 'n');
  const std::size_t end = header.find("OFF");
  if (end == header.npos) return std::nullopt;
  std::string parts = header.substr(0, end);
  if (const std::size_t at = parts.find("ST"); at != parts.npos) parts.replace(at, 2, "t");
  std::sort(parts.begin(), parts.end());
  const bool repeats = std::adjacent_find(parts.begin(), parts.end()) != parts.end();
  if (repeats || parts.find_first_not_of("4CNnt") != parts.npos) return std::nullopt;
  word.remove_prefix(end + 3);
  const auto has = [&](char part) { return parts.find(part) != parts.npos; };
  return Form{has('4'), has('n'), is_lower && has('N')};
}

/// The header may be missing: then the counts come first. They may be glued to it: "OFF8 6 12".
Form read_form(TextCursor& cursor) {
  TextCursor ahead = cursor;
  const std::string_view header = ahead.word();
  if (is_count(header)) return {};
  std::string_view glued = header;
  std::optional<Form> form = take_form(glued);
  if (!form || !(glued.empty() || is_count(glued)))
    ahead.fail("starts with " + quoted(header) + " instead of OFF");
  const std::string_view after = ahead.rest();
  cursor = TextCursor({glued.data(), glued.size() + after.size()}, '#', ahead.line());
  if (upper_case(ahead.word()) == "BINARY") ahead.fail("binary OFF is not supported");
  if (form->may_state_dimension) {
    ahead = cursor;
    ahead.word();
    form->states_dimension = ahead.word_on_line().empty();
  }
  if (form->states_dimension) {
    const std::int64_t dimension = cursor.integer("the dimension");
    if (dimension != 3) cursor.fail("dimension " + std::to_string(dimension) + " is not supported; 3 is");
  }
  return *form;
}

/// The number of edges, which is not used, stands behind the others or alone on the next line.
void skip_edge_count(TextCursor& cursor) {
  TextCursor ahead = cursor;
  std::string_view word = ahead.word_on_line();
  if (word.empty()) {
    word = ahead.word();
    if (!ahead.word_on_line().empty()) cursor.fail("has no number of edges; write 0 where it is unknown");
  }
  parse_integer(word, "the number of edges", ahead);
  cursor = ahead;
  cursor.skip_line();
}

/// A count that the rest of the file can hold, at two bytes a value.
std::size_t count(TextCursor& cursor, std::string_view what, std::size_t file_size) {
  const std::int64_t value = cursor.integer(what);
  if (value < 0 || static_cast<std::uint64_t>(value) > file_size / 2)
    cursor.fail(std::string(what) + " " + std::to_string(value) + " in a file of " +
                std::to_string(file_size) + " bytes");
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
  skip_edge_count(cursor);

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
    for (std::size_t k = 0; k < size; ++k)
      corners.push_back(
          mesh.checked_corner(parse_integer(cursor.word_on_line(), "a face's vertex", cursor), cursor));
    mesh.add_face(corners, cursor);
    cursor.skip_line();
  }
  if (!cursor.at_end() && !is_padding(cursor.rest()))
    cursor.fail("goes on after its " + std::to_string(faces) + " faces");
  return std::move(mesh).build();
}

}  // namespace touchmark::mesh_io

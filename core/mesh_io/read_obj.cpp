#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "core/mesh_io/mesh_file.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

/// Statements that carry no surface.
constexpr std::array<std::string_view, 26> skipped = {
    "vt",       "vn",     "vp",     "g",      "o",    "s",          "mtllib",    "usemtl", "l",
    "p",        "mg",     "usemap", "maplib", "lod",  "shadow_obj", "trace_obj", "bevel",  "c_interp",
    "d_interp", "cstype", "deg",    "bmat",   "step", "parm",       "end",       "call"};

/// Lines that end in a backslash go on in the next one.
std::string with_joined_lines(std::string_view bytes) {
  std::string text(bytes);
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
    std::size_t end = at + 1;
    if (end < text.size() && text[end] == '\r') ++end;
    if (end < text.size() && text[end] == '\n')
      std::fill(text.begin() + static_cast<std::ptrdiff_t>(at),
                text.begin() + static_cast<std::ptrdiff_t>(end) + 1, ' ');
  }
  return text;
}

/// "7", "7/1", "7//3" or "-1/2/3": the vertex, counted from 1, or backwards from the last one read.
std::uint32_t corner(std::string_view word, const MeshBuilder& mesh, const TextCursor& cursor) {
  const std::int64_t given = parse_integer(word.substr(0, word.find('/')), "a face's vertex", cursor);
  const auto count = static_cast<std::int64_t>(mesh.vertex_count());
  const std::int64_t index = given > 0 ? given - 1 : count + given;
  if (given == 0 || index < 0 || index >= count) {
    cursor.fail("face " + std::to_string(mesh.face_count()) + " names vertex " + std::to_string(given) +
                " of the " + std::to_string(count) + " read so far");
  }
  return static_cast<std::uint32_t>(index);
}

}  // namespace

TriangleMesh read_obj(std::string_view bytes) {
  const bool joined = bytes.find("\\\n") != bytes.npos || bytes.find("\\\r\n") != bytes.npos;
  const std::string text = joined ? with_joined_lines(bytes) : std::string();
  TextCursor cursor(joined ? std::string_view(text) : bytes, '#');
  MeshBuilder mesh;
  std::vector<std::uint32_t> corners;
  while (!cursor.at_end()) {
    const std::string_view statement = cursor.word();
    if (statement == "v") {
      const double x = cursor.number_on_line("x"), y = cursor.number_on_line("y"),
                   z = cursor.number_on_line("z");
      mesh.add_vertex({x, y, z});
    } else if (statement == "f" || statement == "fo") {
      corners.clear();
      for (std::string_view word = cursor.word_on_line(); !word.empty(); word = cursor.word_on_line()) {
        corners.push_back(corner(word, mesh, cursor));
      }
      mesh.add_face(corners, cursor);
    } else if (std::find(skipped.begin(), skipped.end(), statement) == skipped.end()) {
      cursor.fail("unknown statement " + quoted(statement));
    }
    cursor.skip_line();
  }
  return std::move(mesh).build();
}

}  // namespace touchmark::mesh_io

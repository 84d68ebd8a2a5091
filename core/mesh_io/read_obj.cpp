#include <algorithm>
#include <array>
#include <string>

#include "core/mesh_io/mesh_builder.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

/// Statements that carry no surface: attributes, groups, points, lines and curves; "t", "vw" and "vc" are
/// tags, weights and colours of a vertex that some programs add.
constexpr std::array<std::string_view, 35> skipped = {
    "t",          "vw",        "vc",     "res",      "vt",       "vn",     "vp",     "g",      "o",
    "s",          "mtllib",    "usemtl", "l",        "p",        "mg",     "usemap", "maplib", "lod",
    "shadow_obj", "trace_obj", "bevel",  "c_interp", "d_interp", "cstype", "deg",    "bmat",   "step",
    "parm",       "end",       "curv",   "curv2",    "sp",       "ctech",  "stech",  "scrv"};

struct Refused {
  std::string_view statement, what;
};
/// Skipping these would lose parts of the surface.
constexpr std::array<Refused, 7> refused = {{{"surf", "a free-form surface"},
                                             {"bsp", "a B-spline patch"},
                                             {"bzp", "a Bezier patch"},
                                             {"cdc", "a Cardinal curve"},
                                             {"cdp", "a Cardinal patch"},
                                             {"call", "another file"},
                                             {"csh", "a command"}}};

/// What the corners of a face may name, at the face's line.
struct VerticesThere {
  std::size_t so_far, in_all;
};

/// "7", "7/1", "7//3" or "-1/2/3": the vertex, counted from 1, or backwards from the last one so far.
std::uint32_t corner(std::string_view word, const VerticesThere& vertices, std::size_t face,
                     const TextCursor& cursor) {
  const std::int64_t given = parse_integer(word.substr(0, word.find('/')), "a face's vertex", cursor);
  const auto so_far = static_cast<std::int64_t>(vertices.so_far);
  const auto in_all = static_cast<std::int64_t>(vertices.in_all);
  if (given < -so_far || given == 0 || given > in_all)
    cursor.fail("face " + std::to_string(face) + " names vertex " + std::to_string(given) + " of " +
                (given < 0 ? std::to_string(so_far) + " so far" : std::to_string(in_all)));
  return static_cast<std::uint32_t>(given > 0 ? given - 1 : so_far + given);
}

void read_vertices(TextCursor cursor, MeshBuilder& mesh) {
  for (; !cursor.at_end(); cursor.skip_line()) {
    if (cursor.word() != "v") continue;
    const double x = cursor.number_on_line("x"), y = cursor.number_on_line("y"),
                 z = cursor.number_on_line("z");
    mesh.add_vertex({x, y, z});
  }
}

void check_statement(std::string_view statement, const TextCursor& cursor) {
  for (const Refused& known : refused)
    if (statement == known.statement)
      cursor.fail(std::string(statement) + ", " + std::string(known.what) + ", is not supported");
  if (std::find(skipped.begin(), skipped.end(), statement) == skipped.end())
    cursor.fail("unknown statement " + quoted(statement));
}

}  // namespace

// Vertices first: a face may name one that stands after it.
TriangleMesh read_obj(std::string_view bytes) {
  TextCursor cursor(without_byte_order_mark(bytes), '#', 1, true);
  MeshBuilder mesh;
  read_vertices(cursor, mesh);
  VerticesThere vertices{0, mesh.vertex_count()};
  std::vector<std::uint32_t> corners;
  for (; !cursor.at_end() && !is_padding(cursor.rest()); cursor.skip_line()) {
    const std::string_view statement = cursor.word();
    if (statement == "v") {
      ++vertices.so_far;
    } else if (statement == "f" || statement == "fo") {
      corners.clear();
      for (std::string_view word = cursor.word_on_line(); !word.empty(); word = cursor.word_on_line())
        corners.push_back(corner(word, vertices, mesh.face_count(), cursor));
      mesh.add_face(corners, cursor);
    } else {
      check_statement(statement, cursor);
    }
  }
  return std::move(mesh).build();
}

}  // namespace touchmark::mesh_io

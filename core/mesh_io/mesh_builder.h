/// A mesh file in memory, and the parts that every reader of one needs: errors that name the place, a
/// polygon's triangles, and the mesh they end up in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh_io/polygon.h"
#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

/// The bytes of a file up to 4 GiB, or of a pipe up to 1 GiB. Throws MeshError when it cannot be read, is
/// larger, is anything else or is empty, or when nobody writes to the pipe.
std::string read_file(const std::filesystem::path& path);

/// Text without a UTF-8 byte-order mark. Throws MeshError for UTF-16.
std::string_view without_byte_order_mark(std::string_view bytes);

/// True of zero bytes, white space and MS-DOS's end-of-file byte alone: what programs fill the end of a file
/// with.
bool is_padding(std::string_view bytes) noexcept;

/// Returns a reference with each %XY replaced by its byte; nothing where a % has no two hexadecimal digits
/// after it, or has two zeros.
std::optional<std::string> decoded_percents(std::string_view text);

/// The position of a reader in a text: whitespace-separated words, counted by line. Handles LF, CR LF and CR.
class TextCursor {
 public:
  /// `comment` starts a comment that runs to the end of its line; 0 for none. With `joins_lines`, a line that
  /// ends in a backslash goes on in the next one, unless the backslash is part of a comment.
  explicit TextCursor(std::string_view text, char comment = 0, std::size_t first_line = 1,
                      bool joins_lines = false)
      : rest_(text), line_(first_line), comment_(comment), joins_lines_(joins_lines) {}

  /// The next word anywhere; empty at the end.
  std::string_view word();
  /// The next word of this line; empty at its end.
  std::string_view word_on_line();
  /// Goes to the start of the next line.
  void skip_line();
  bool at_end();
  std::size_t line() const noexcept { return line_; }
  std::string_view rest() const noexcept { return rest_; }

  /// The next word as a finite double, bit for bit what the file says; `what` names it in the error.
  double number(std::string_view what);
  double number_on_line(std::string_view what);
  /// The next word as an integer.
  std::int64_t integer(std::string_view what);

  /// Throws MeshError("line N: message").
  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_spaces(bool across_lines);
  void take_line_end();
  std::string_view take_word();
  bool joins_at(std::size_t at) const noexcept;

  std::string_view rest_;
  std::size_t line_;
  char comment_;
  bool joins_lines_;
};

/// For messages: the word in quotes, cut to a sane length, with nothing that upsets a terminal.
std::string quoted(std::string_view word);

/// A word as a number; throws through `cursor`. Overflow, trailing letters, decimal commas, NaN and infinity
/// are refused.
double parse_double(std::string_view word, std::string_view what, const TextCursor& cursor);
std::int64_t parse_integer(std::string_view word, std::string_view what, const TextCursor& cursor);

/// Collects vertices and faces; a face's id is its number in the file, from 0. `position` is where the reader
/// stands: its fail(message) throws MeshError with the line or the byte.
class MeshBuilder {
 public:
  /// The most corners of a polygon whose ears are clipped, which takes the cube of their number at worst.
  static constexpr std::size_t max_clipped_corners = 1024;

  void reserve(std::size_t vertices, std::size_t faces);
  void add_vertex(const Vec3& position) { vertices_.push_back(position); }

  /// A vertex read so far, as a face names it.
  template <class Position>
  std::uint32_t checked_corner(std::int64_t vertex, const Position& position) const {
    if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= vertices_.size())
      position.fail("face " + std::to_string(faces_) + " names vertex " + std::to_string(vertex) + " of " +
                    std::to_string(vertices_.size()));
    return static_cast<std::uint32_t>(vertex);
  }

  /// A polygon becomes triangles that share its id: clipped ears, or a fan where it has more corners than
  /// are clipped. A larger polygon whose first corner does not see all of it is refused.
  template <class Position>
  void add_face(const std::vector<std::uint32_t>& corners, const Position& position) {
    const auto fail = [&](const std::string& why) {
      position.fail("face " + std::to_string(faces_) + " has " + std::to_string(corners.size()) + " corners" +
                    why);
    };
    if (corners.size() < 3) fail("; a face has at least 3");
    if (corners.size() == 3) return add_triangle(corners[0], corners[1], corners[2]);
    if (corners.size() <= max_clipped_corners) return add_polygon(corners, clipped_ears(vertices_, corners));
    const std::vector<PolygonTriangle> triangles = fan(vertices_, corners);
    if (triangles.empty())
      fail(" and is not convex; " + std::to_string(max_clipped_corners) + " are the most of one that is not");
    add_polygon(corners, triangles);
  }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  std::size_t vertex_count() const noexcept { return vertices_.size(); }
  std::size_t face_count() const noexcept { return faces_; }
  /// Throws MeshError as TriangleMesh does.
  TriangleMesh build() &&;

 private:
  void add_polygon(const std::vector<std::uint32_t>& corners, const std::vector<PolygonTriangle>& triangles);

  std::vector<Vec3> vertices_;
  std::vector<TriangleMesh::Corners> triangles_;
  std::vector<TriangleId> ids_;  // filled from the first polygon on; until then ids are positions
  std::uint32_t faces_ = 0;
};

}  // namespace touchmark::mesh_io

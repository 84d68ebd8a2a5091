#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <string>
#include <unordered_map>

#include "core/mesh_io/mesh_builder.h"
#include "core/mesh_io/readers.h"

namespace touchmark::mesh_io {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read in place");

constexpr std::size_t header_size = 84, facet_size = 50;

/// Gives corners with the same coordinates the same vertex (0 and -0 are the same).
class Welder {
 public:
  explicit Welder(MeshBuilder& mesh) : mesh_(mesh) {}

  std::uint32_t vertex(const Vec3& position) {
    const Vec3 key = position + Vec3::Zero();  // turns -0 into 0
    const auto [found, is_new] = known_.try_emplace({key.x(), key.y(), key.z()}, mesh_.vertex_count());
    if (is_new) mesh_.add_vertex(position);
    return static_cast<std::uint32_t>(found->second);
  }

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const noexcept {
      std::uint64_t hash = 0;
      for (const double x : key)
        hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
      return hash ^ (hash >> 32);
    }
  };
  MeshBuilder& mesh_;
  std::unordered_map<Key, std::size_t, Hash> known_;
};

TriangleMesh read_binary(std::string_view bytes, std::size_t facets) {
  MeshBuilder mesh;
  Welder welder(mesh);
  std::vector<std::uint32_t> corners(3);
  for (std::size_t i = 0; i < facets; ++i) {
    std::array<float, 12> values;  // the normal, which is not used, and three corners
    std::memcpy(values.data(), bytes.data() + header_size + i * facet_size, sizeof values);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 corner(values[3 + 3 * k], values[4 + 3 * k], values[5 + 3 * k]);
      if (!corner.allFinite())
        throw MeshError("byte " + std::to_string(header_size + i * facet_size + 12 * (k + 1)) + ": corner " +
                        std::to_string(k) + " of facet " + std::to_string(i) + " is not finite");
      corners[k] = welder.vertex(corner);
    }
    mesh.add_triangle(corners[0], corners[1], corners[2]);
  }
  return std::move(mesh).build();
}

bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
    return a == b || std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

[[noreturn]] void fail_at(std::string_view word, const std::string& wanted, const TextCursor& cursor) {
  cursor.fail((word.empty() ? "the end" : quoted(word)) + " stands where " + wanted + " should");
}

/// Skips words without a meaning up to the line's end, or to one of `keywords`: the next statement's, or one
/// that shows that a part of the surface would be skipped.
void skip_words(TextCursor& cursor, std::initializer_list<std::string_view> keywords) {
  for (TextCursor ahead = cursor;; cursor = ahead) {
    const std::string_view word = ahead.word_on_line();
    const auto is_word = [&](std::string_view keyword) { return is_keyword(word, keyword); };
    if (word.empty() || std::any_of(keywords.begin(), keywords.end(), is_word)) return;
  }
}

/// The next statement's first word; lines that begin with "color" are skipped.
std::string_view next_keyword(TextCursor& cursor) {
  std::string_view word = cursor.word();
  for (; is_keyword(word, "color"); word = cursor.word()) skip_words(cursor, {"vertex"});
  return word;
}

void expect(TextCursor& cursor, std::string_view wanted) {
  const std::string_view word = next_keyword(cursor);
  if (!is_keyword(word, wanted)) fail_at(word, "'" + std::string(wanted) + "'", cursor);
}

/// From "facet" to "endfacet": a triangle, or the polygon that some programs write.
void read_facet(TextCursor& cursor, Welder& welder, std::vector<std::uint32_t>& corners) {
  skip_words(cursor, {"outer"});  // "normal" and three numbers, which many programs leave wrong
  expect(cursor, "outer");
  expect(cursor, "loop");
  skip_words(cursor, {"vertex"});
  corners.clear();
  std::string_view word;
  for (word = next_keyword(cursor); is_keyword(word, "vertex"); word = next_keyword(cursor)) {
    const double x = cursor.number("x"), y = cursor.number("y"), z = cursor.number("z");
    corners.push_back(welder.vertex({x, y, z}));
  }
  if (!is_keyword(word, "endloop")) fail_at(word, "'vertex' or 'endloop'", cursor);
  skip_words(cursor, {"endfacet", "vertex"});
  expect(cursor, "endfacet");
  TextCursor ahead = cursor;
  word = ahead.word_on_line();
  if (!is_keyword(word, "facet") && !is_keyword(word, "endsolid")) skip_words(cursor, {"endfacet"});
}

/// True of a binary file's header only if it declares over 150 million facets.
bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](unsigned char c) { return std::isprint(c) || std::isspace(c); });
}

bool starts_as_ascii(std::string_view bytes) {
  return is_keyword(TextCursor(without_byte_order_mark(bytes)).word(), "solid") ||
         is_text(bytes.substr(0, header_size));
}

TriangleMesh read_ascii(std::string_view bytes) {
  TextCursor cursor(without_byte_order_mark(bytes));
  MeshBuilder mesh;
  Welder welder(mesh);
  std::vector<std::uint32_t> corners;
  while (!cursor.at_end() && !(mesh.face_count() > 0 && is_padding(cursor.rest()))) {
    expect(cursor, "solid");
    skip_words(cursor, {"endfacet"});  // the solid's name; a facet on its line would be lost
    std::string_view word = next_keyword(cursor);
    for (; is_keyword(word, "facet"); word = next_keyword(cursor)) {
      read_facet(cursor, welder, corners);
      mesh.add_face(corners, cursor);
    }
    if (!is_keyword(word, "endsolid")) fail_at(word, "'facet' or 'endsolid'", cursor);
    skip_words(cursor, {"endfacet"});
  }
  return std::move(mesh).build();
}

}  // namespace

TriangleMesh read_stl(std::string_view bytes) {
  if (bytes.size() >= header_size) {
    std::uint32_t facets = 0;
    std::memcpy(&facets, bytes.data() + 80, sizeof facets);
    const std::size_t needed = header_size + facet_size * std::size_t{facets};
    // Binary files may start with "solid" too: the size decides.
    if (bytes.size() >= needed && is_padding(bytes.substr(needed))) return read_binary(bytes, facets);
    if (!starts_as_ascii(bytes))
      throw MeshError("byte 80: " + std::to_string(facets) + " facets need " + std::to_string(needed) +
                      " bytes, the file has " + std::to_string(bytes.size()));
  }
  return read_ascii(bytes);
}

}  // namespace touchmark::mesh_io

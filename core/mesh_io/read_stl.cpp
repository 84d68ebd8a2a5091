#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_map>

#include "core/mesh_io/mesh_file.h"
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
      if (!corner.allFinite()) {
        throw MeshError("byte " + std::to_string(header_size + i * facet_size + 12 * (k + 1)) + ": corner " +
                        std::to_string(k) + " of facet " + std::to_string(i) + " is not finite");
      }
      corners[k] = welder.vertex(corner);
    }
    mesh.add_triangle(corners[0], corners[1], corners[2]);
  }
  return std::move(mesh).build();
}

void expect(TextCursor& cursor, std::string_view wanted) {
  const std::string_view word = cursor.word();
  if (word != wanted)
    cursor.fail((word.empty() ? "the end" : quoted(word)) + " stands where '" + std::string(wanted) +
                "' should");
}

TriangleMesh read_ascii(std::string_view bytes) {
  TextCursor cursor(bytes);
  MeshBuilder mesh;
  Welder welder(mesh);
  std::array<std::uint32_t, 3> corners{};
  while (!cursor.at_end()) {
    expect(cursor, "solid");
    cursor.skip_line();  // the solid's name
    std::string_view word = cursor.word();
    for (; word == "facet"; word = cursor.word()) {
      cursor.skip_line();  // "normal" and three numbers, which many programs leave wrong
      expect(cursor, "outer");
      expect(cursor, "loop");
      for (std::uint32_t& corner : corners) {
        expect(cursor, "vertex");
        const double x = cursor.number("x"), y = cursor.number("y"), z = cursor.number("z");
        corner = welder.vertex({x, y, z});
      }
      expect(cursor, "endloop");
      expect(cursor, "endfacet");
      mesh.add_triangle(corners[0], corners[1], corners[2]);
    }
    if (word != "endsolid")
      cursor.fail((word.empty() ? "the end" : quoted(word)) + " stands where 'facet' or 'endsolid' should");
    cursor.skip_line();
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
    if (bytes.size() == needed) return read_binary(bytes, facets);
    if (bytes.substr(0, 5) != "solid") {
      throw MeshError("byte 80: " + std::to_string(facets) + " facets need " + std::to_string(needed) +
                      " bytes, the file has " + std::to_string(bytes.size()));
    }
  }
  return read_ascii(bytes);
}

}  // namespace touchmark::mesh_io

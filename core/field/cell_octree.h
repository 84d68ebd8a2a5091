/// Cubes of space, each with the plane or the triangle that answers for it: an octree below a lattice of
/// equal cubes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/field/plane_cell.h"
#include "core/field/sample.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::field {

/// How finely cubes are divided.
struct Division {
  double error;       ///< mesh units, above 0: no cube's answer is off by more
  double band;        ///< cubes farther from the mesh than this hold nothing
  unsigned threads;   ///< at least 1; the same bits
  std::size_t bytes;  ///< no more memory than this
};

/// A plane answers for a cube where it was proved to be good enough (plane_fitter.h); else, where that is,
/// one triangle T. There d(p, T) is what the octree answers for a point p, and d(p) <= d(p, T) the true
/// distance. d(p)^2 - |p|^2 is concave, as the least of functions that are linear in p, so in a cube it is at
/// least what its corners' values are in trilinear interpolation; and d(p, T)^2 - |p|^2 is at most |p - q|^2
/// - |p|^2, q being T's nearest point to the cube's middle. The difference of both bounds is trilinear, so
/// greatest at a corner: d(p, T)^2 - d(p)^2 <= max over corners c of |c - q|^2 - d(c)^2.
class CellOctree {
 public:
  /// Stands for a triangle in a leaf that is farther than the band, and in what is outside of the lattice.
  static constexpr std::uint32_t far = 0x3fffffffU;
  /// A cube of the octree and what it holds. Lengths are edges of the smallest cube.
  struct Leaf {
    Vec3 corner = Vec3::Zero();
    double edge = 0;           ///< 0: holds no place
    std::uint32_t held = far;  ///< a triangle's position in the mesh; with plane_bit, where the plane is
    PlaneCell plane;           ///< if it is one

    bool is_plane() const noexcept { return (held & plane_bit) != 0; }
    bool is_none() const noexcept { return held == far; }
    bool holds(const Vec3& place) const noexcept {
      const Vec3 in = place - corner;
      return in.x() >= 0 && in.x() < edge && in.y() >= 0 && in.y() < edge && in.z() >= 0 && in.z() < edge;
    }
  };

  CellOctree() = default;
  /// Divides the space around a mesh, whose triangles are given in its order, and which each thread samples
  /// by a function that make_sampler returns. Stays empty where cubes would have to be smaller than doubles
  /// can tell apart there, or squares of lengths leave the range of doubles. Throws std::invalid_argument
  /// where the memory would not do.
  CellOctree(const TriangleMesh& mesh, std::span<const PreparedTriangle> triangles, const Division& division,
             const std::function<Sampler()>& make_sampler);

  bool empty() const noexcept { return entries_.empty(); }
  /// Returns where the point is, in edges of the smallest cube.
  Vec3 place_of(const Vec3& point) const noexcept { return (point - origin_) * places_per_length_; }
  /// Returns the leaf that holds the place; outside of the lattice, where no triangle is within the band, one
  /// that holds none.
  Leaf leaf_at(const Vec3& place) const noexcept;
  /// Returns how far a place in a leaf with a plane is above that plane, in mesh units: negative below.
  double height(const Leaf& leaf, const Vec3& place) const noexcept;
  /// Returns the contact of a point with the leaf's plane: at the point's foot, on its side, and with the
  /// position in the mesh of a triangle that is within the error of that foot. The place is where the point
  /// is, and the height how far above the plane.
  Contact contact(const Leaf& leaf, const Vec3& point, const Vec3& place, double height) const noexcept;
  /// Returns the largest error that was proved of any leaf: at most what was asked for.
  double error() const noexcept { return error_; }
  std::size_t bytes() const noexcept {
    return entries_.capacity() * sizeof(std::uint32_t) + blocks_.capacity() * sizeof(Block);
  }

 private:
  using Place = std::array<std::uint32_t, 3>;  ///< in edges of the smallest cube
  static constexpr std::uint32_t leaf_bit = 0x80000000U, plane_bit = 0x40000000U;
  static constexpr std::size_t words_a_block = 16;
  /// Planes begin a block each; see PlaneCell for what is behind them.
  struct alignas(64) Block {
    std::array<std::uint32_t, words_a_block> words{};
  };
  /// The entries of one cube of the lattice, the first, and of what is below it; children by their place
  /// here.
  struct Tree {
    std::vector<std::uint32_t> entries;
    std::vector<Block> blocks;
    double error = 0;
  };
  class Divider;

  bool choose_lattice(const Aabb& bounds, const Division& division) noexcept;
  std::vector<double> sample_lattice(const Division& division, std::vector<Sampler>& samplers) const;
  void append(const std::vector<Tree>& trees);
  std::uint32_t word(std::size_t at) const noexcept {
    return blocks_[at / words_a_block].words[at % words_a_block];
  }
  std::uint32_t triangle_near(const Leaf& leaf, const Vec3& in_leaf, double height) const noexcept;
  Vec3 position(const Place& at) const noexcept {
    return origin_ +
           unit_ * Vec3(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2]));
  }

  Vec3 origin_ = Vec3::Zero();
  double unit_ = 1;  ///< edge of the smallest cube
  double places_per_length_ = 1;
  std::array<double, 3> end_{};  ///< just beyond the places along each axis
  double slop_ = 0;              ///< more than what rounding does to a place, and to which cube a point is in
  std::uint32_t depth_ = 0;      ///< levels below the lattice
  Place counts_{};               ///< the lattice's cubes along each axis
  double error_ = 0;
  /// The lattice's cubes first. What a leaf holds with leaf_bit, or the place of the first of eight children.
  std::vector<std::uint32_t> entries_;
  std::vector<Block> blocks_;
};

}  // namespace touchmark::field

/// Cubes of space, each with the one triangle that answers for it: an octree below a lattice of equal cubes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/aabb.h"
#include "core/probe.h"

namespace touchmark::field {

/// What is known of one point: its distance from the mesh, and where and in which triangle that is.
struct Sample {
  double distance = 0;
  Vec3 nearest = Vec3::Zero();
  std::uint32_t triangle = 0;  ///< position in the mesh
};

/// Takes samples one after the other; each thread has its own.
using Sampler = std::function<Sample(const Vec3&)>;

/// How finely cubes are divided.
struct Division {
  double error;       ///< mesh units, above 0: no cube's triangle is farther than the nearest by more
  double band;        ///< cubes farther from the mesh than this hold nothing
  unsigned threads;   ///< at least 1; the same bits
  std::size_t bytes;  ///< no more memory than this
};

/// For points p and a triangle T, d(p, T) is what the octree answers and d(p) <= d(p, T) the true distance.
/// d(p)^2 - |p|^2 is concave, as the least of functions that are linear in p, so in a cube it is at least
/// what its corners' values are in trilinear interpolation; and d(p, T)^2 - |p|^2 is at most
/// |p - q|^2 - |p|^2, q being T's nearest point to the cube's middle. The difference of both bounds is
/// trilinear, so greatest at a corner: d(p, T)^2 - d(p)^2 <= max over corners c of |c - q|^2 - d(c)^2.
class CellOctree {
 public:
  using Place = std::array<std::uint32_t, 3>;  ///< in edges of the smallest cube
  /// Stands for a triangle in a leaf that is farther than the band.
  static constexpr std::uint32_t far = 0x7fffffffU;
  /// A cube of the octree and what it holds.
  struct Leaf {
    Place at{~0U, ~0U, ~0U};  ///< its corner; no place of the octree: holds none
    std::uint32_t level = 0;  ///< the edge is so many times double that of the smallest cube
    std::uint32_t triangle = far;

    bool holds(const Place& place) const noexcept {
      return (((place[0] ^ at[0]) | (place[1] ^ at[1]) | (place[2] ^ at[2])) >> level) == 0;
    }
  };

  CellOctree() = default;
  /// Divides the space around a mesh of this box, which each thread samples by a function that make_sampler
  /// returns. Stays empty where cubes would have to be smaller than doubles can tell apart there, or squares
  /// of lengths leave the range of doubles. Throws std::invalid_argument where the memory would not do.
  CellOctree(const Aabb& bounds, const Division& division, const std::function<Sampler()>& make_sampler);

  bool empty() const noexcept { return entries_.empty(); }
  /// Returns the smallest cube that the point is in, or nothing outside of the lattice, where no triangle is
  /// within the band.
  std::optional<Place> place_of(const Vec3& point) const noexcept;
  /// Returns the leaf that holds the place.
  Leaf leaf_at(const Place& place) const noexcept;
  /// Returns the largest error that was proved of any leaf: at most what was asked for.
  double error() const noexcept { return error_; }
  std::size_t leaves() const noexcept { return leaves_; }
  std::size_t bytes() const noexcept { return entries_.capacity() * sizeof(std::uint32_t); }

 private:
  static constexpr std::uint32_t leaf_bit = 0x80000000U;
  /// The entries of one cube of the lattice, the first, and of what is below it; children by their place
  /// here.
  struct Tree {
    std::vector<std::uint32_t> entries;
    double error = 0;
    std::size_t leaves = 0;
  };
  class Divider;

  bool choose_lattice(const Aabb& bounds, const Division& division) noexcept;
  std::vector<double> sample_lattice(const Division& division, std::vector<Sampler>& samplers) const;
  void append(const std::vector<Tree>& trees);
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
  std::size_t leaves_ = 0;
  /// The lattice's cubes first. A leaf's triangle with leaf_bit, or the place of the first of eight children.
  std::vector<std::uint32_t> entries_;
};

inline std::optional<CellOctree::Place> CellOctree::place_of(const Vec3& point) const noexcept {
  const Vec3 along = (point - origin_) * places_per_length_;
  Place place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = along[static_cast<int>(axis)];
    if (!(at >= 0 && at < end_[axis])) return std::nullopt;
    place[axis] = static_cast<std::uint32_t>(static_cast<std::int32_t>(at));
  }
  return place;
}

inline CellOctree::Leaf CellOctree::leaf_at(const Place& place) const noexcept {
  const auto [x, y, z] = place;
  std::uint32_t level = depth_;
  std::uint32_t entry = entries_[((z >> level) * counts_[1] + (y >> level)) * counts_[0] + (x >> level)];
  while ((entry & leaf_bit) == 0) {
    --level;
    entry = entries_[entry + ((x >> level & 1) | (y >> level & 1) << 1 | (z >> level & 1) << 2)];
  }
  return {place, level, entry & ~leaf_bit};
}

}  // namespace touchmark::field

/// Cells around the mesh: small ones near the surface, each naming a triangle near its middle.
///
/// An octree over a cube about the mesh, in the coordinates of the filter's frame; its top is one dense
/// table.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/grid_group/direct/box_tree.h"
#include "core/grid_group/direct/groups.h"
#include "core/grid_group/direct/triangle_store.h"
#include "core/search/memory/lazy_construction.h"

namespace touchmark::grid {

struct CellOptions {
  double smallest = 0;  ///< edge, in the frame; 0: as the triangles are
  std::size_t max_bytes = 0;
  bool lazy = false;  ///< leaves hold what their parents know, until built
  unsigned threads = 1;
  const Groups* groups = nullptr;  ///< if built: where there are none, cells need not be small
};

/// A triangle about as near to a cell's middle as the nearest, and how far that is: what a query starts from.
struct Cell {
  Vec3 middle;      ///< in the frame
  double distance;  ///< from there to the mesh, in the frame, at least
  std::uint32_t slot;
};

class CellTree {
 public:
  static CellTree build(const TriangleStore& store, const BoxTree& tree, const CellOptions& options);

  /// After the triangles in these boxes of the frame moved within them: looks anew for what is nearest to the
  /// cells that one of them can have been or be nearest to. The cells stay.
  void update(const TriangleStore& store, const BoxTree& tree, const std::vector<Aabb>& moved,
              unsigned threads = 1);

  bool holds(const Vec3& in_frame) const noexcept {
    return std::abs(in_frame.x()) < half_ && std::abs(in_frame.y()) < half_ && std::abs(in_frame.z()) < half_;
  }
  /// Returns the cell that a point of the cube lies in.
  Cell at(const Vec3& in_frame) const noexcept {
    const Units at = units(in_frame);
    const Found found = find(at);
    const Leaf leaf = leaves_[found.leaf].load();
    return {middle(at, found.shift), static_cast<double>(leaf.distance), leaf.slot};
  }
  /// Returns the length of that cell's edges.
  double edge_at(const Vec3& in_frame) const noexcept { return unit_ * (1u << find(units(in_frame)).shift); }
  /// The mesh is no farther from the middle of a cell of this distance, where the search for it came to its
  /// end.
  double upper_bound(double distance) const noexcept {
    return max_times * ((distance + 2 * rounded_down_to) * (1 + 2 * rounded_down_by) + 2 * middle_error_);
  }
  /// In the frame: how far a cell's middle may be from where it is looked at in the mesh's own coordinates,
  /// in which it is rounded.
  double middle_error() const noexcept { return middle_error_; }
  /// Finds what is near the middle of that cell, where that is not known yet; else false. Any thread
  /// may meanwhile read or build the same.
  bool build_lazily(const Vec3& in_frame, const TriangleStore& store, const BoxTree& tree,
                    std::uint64_t budget, Work& work) const noexcept;

  std::size_t cells() const noexcept { return leaves_.size(); }
  double smallest_edge() const noexcept { return smallest_edge_; }
  bool coarsened() const noexcept { return coarsened_; }
  std::size_t bytes() const noexcept {
    return links_.capacity() * sizeof(std::uint32_t) + leaves_.capacity() * sizeof(SharedLeaf) +
           states_.capacity() * sizeof(LazyState);
  }

 private:
  friend class CellTreeBuilder;
  static constexpr unsigned max_levels = 24;
  static constexpr std::uint32_t is_leaf = 1u << 31;

  struct Leaf {
    std::uint32_t slot;
    float distance;
  };
  /// A leaf that any thread may read and set: with a new slot and the old distance both are still true.
  struct SharedLeaf {
    SharedValue<std::uint32_t> slot;
    SharedValue<float> distance;

    Leaf load() const noexcept { return {slot.load(), distance.load()}; }
    void store(const Leaf& leaf) const noexcept {
      slot.store(leaf.slot);
      distance.store(leaf.distance);
    }
  };

  using Units = std::array<std::uint32_t, 3>;  ///< numbers of a cell of the last possible level
  struct Found {
    std::uint32_t leaf;
    unsigned shift;  ///< the level's distance from the finest one, in levels
  };
  Units units(const Vec3& in_frame) const noexcept {
    return {unit(in_frame.x()), unit(in_frame.y()), unit(in_frame.z())};
  }
  Found find(const Units& at) const noexcept {
    unsigned shift = max_levels - top_levels_;
    std::uint32_t link =
        links_[((at[2] >> shift << top_levels_ | at[1] >> shift) << top_levels_) | at[0] >> shift];
    while (!(link & is_leaf)) {
      --shift;
      link = links_[link + ((at[0] >> shift & 1u) | (at[1] >> shift & 1u) << 1 | (at[2] >> shift & 1u) << 2)];
    }
    return {link & ~is_leaf, shift};
  }
  Vec3 middle(const Units& at, unsigned shift) const noexcept {
    const double edge = unit_ * (1u << shift);
    const auto middle = [&](std::uint32_t along) { return ((along >> shift) + 0.5) * edge - half_; };
    return {middle(at[0]), middle(at[1]), middle(at[2])};
  }

  /// Bounds the error of a cell's middle besides from_frame's rounding, as a share of half the cube's edge.
  /// The middle is a sum over the levels when the cells are made, and a product and a sum in middle(), each
  /// rounded by u = 2^-53 of half the cube's edge or its whole; 32 of them in each of three coordinates, and
  /// as much again for the difference between the two.
  static constexpr double middle_relative_error = 2 * 3 * 32 * 0x1p-53;
  /// Shares by which a distance is rounded down, relatively and besides: to single precision, and for the
  /// kernel's error.
  static constexpr double rounded_down_by = 0x1p-20, rounded_down_to = 0x1p-30;

  /// Cells name a triangle whose squared distance times this is at most that of the nearest: to find it takes
  /// half of the work, and it serves as well to start from. The distance that they keep is the root of this
  /// part of the square.
  static constexpr float min_part = 0.98F;
  static constexpr double max_times = 1.0102;  ///< at least the root of its inverse

  static float rounded_down(double distance) noexcept {
    return static_cast<float>(distance * (1 - rounded_down_by) - rounded_down_to);
  }
  /// `hint` is tried first. Where testing `budget` triangles and boxes is not enough, the nearest of those
  /// and no distance. The search is from where the middle is when rounded, the distance holds of the middle.
  Leaf nearest_to(const TriangleStore& store, const BoxTree& tree, const Vec3& middle, std::uint32_t hint,
                  std::uint64_t budget, Work& work) const noexcept;
  std::uint32_t unit(double along) const noexcept {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>((along + half_) * units_per_length_));
  }

  double half_ = 0;  ///< half of the cube's edge; the cube's middle is the frame's origin
  double unit_ = 0;  ///< edge of a cell of the last possible level
  double units_per_length_ = 0;
  double middle_error_ = 0;
  unsigned top_levels_ = 0;
  std::vector<std::uint32_t> links_;  ///< the top table, then eight a node: the first of a node, or a leaf
  std::vector<SharedLeaf> leaves_;
  std::vector<LazyState> states_;  ///< states of the leaves, with lazy construction
  std::uint32_t root_ = 0;         ///< link of the whole cube
  double smallest_edge_ = 0;
  bool coarsened_ = false;
};

}  // namespace touchmark::grid

/// Finds which triangles make a triangle's group. Takes no memory beyond its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/grid_group/direct/box_tree.h"
#include "core/grid_group/direct/groups.h"
#include "core/grid_group/direct/near_balls.h"
#include "core/grid_group/direct/prism.h"
#include "core/grid_group/direct/triangle_store.h"

namespace touchmark::grid {

class GroupFinder {
 public:
  struct Effort {
    /// Neighbours in the order are neighbours in space: what is gathered for one slot is to serve all those
    /// of its block that come after it, and after a block's worth of slots without a group only the first
    /// slot of a block is looked at, of every fourth block in the end, until there is one.
    bool shares = false;
    /// Else only every fourth block's first slot is looked at from the start.
    bool has_hope = true;
    std::uint64_t max_boxes = ~std::uint64_t{0};  ///< are looked at to gather; past that there is no group
    std::uint64_t max_near = ~std::uint64_t{0};   ///< are gathered, likewise
  };
  /// Each triangle gathered is looked at no more often than this.
  static constexpr std::uint64_t max_looks = 8;

  /// `exclusion_margin`: by how much, in the frame, a triangle must lose to be left out.
  GroupFinder(const TriangleStore& store, const BoxTree& tree, double exclusion_margin,
              const Effort& effort) noexcept
      : store_(store),
        tree_(tree),
        exclusion_margin_(exclusion_margin),
        effort_(effort),
        failures_(effort.has_hope ? 0 : hopeless) {}

  struct Found {
    std::span<const std::uint32_t> members;  ///< valid until the next call; behind them copies of the last
    float height = -1, margin = -1;
  };
  /// Returns the group of a slot's triangle, without members where no group can cover a point, or it would be
  /// too large.
  Found find(std::uint32_t slot) noexcept;
  /// Boxes and triangles looked at since the last call.
  Work take_work() noexcept;

  /// Everything that can be nearest where a group is valid comes this near to the triangle's ball, in its
  /// radii.
  static constexpr double reach_in_radii = 6;

 private:
  /// The most triangles gathered: where there are more around the lowest prism, a group would be too large.
  static constexpr std::size_t max_near = NearBalls::max_before;
  /// After so many slots without a group every fourth block is looked at.
  static constexpr unsigned hopeless = 2 * TriangleStore::block_size;

  double find_members(std::uint32_t slot, const FaceFrame& face_frame) noexcept;
  double find_below(std::uint32_t slot, const FaceFrame& face_frame, double start) noexcept;
  void fail(std::uint32_t slot) noexcept;
  bool gather(std::uint32_t slot, const FaceFrame& face_frame, const Aabb& box) noexcept;
  Aabb shared_box(std::uint32_t slot, const FaceFrame& face_frame, const Aabb& box) const noexcept;
  bool gather_in(const Aabb& box) noexcept;
  double select_members(std::uint32_t own, const FaceFrame& face_frame, const Prism& highest,
                        double height) noexcept;
  void add_members(const Prism& prism, const std::uint32_t* slots, std::size_t count) noexcept;
  void keep_members(const Prism& prism) noexcept;

  const TriangleStore& store_;
  const BoxTree& tree_;
  double exclusion_margin_;
  Effort effort_;
  Work work_;

  std::array<double, 2> heights_{1, 1};  ///< the heights of the last two prisms, in sizes of their triangles
  Aabb gathered_;                        ///< near_ holds every triangle that reaches into this
  std::uint32_t alone_until_ = 0;        ///< slots before this one gather for themselves
  unsigned failures_ = 0;                ///< slots without a group since the last with one
  std::uint32_t passed_over_until_ = 0;  ///< slots before this one are not looked at
  std::uint64_t boxes_seen_ = 0;         ///< for the group looked for
  NearBalls near_;
  OpenSlots open_;  ///< for the group looked for
  std::size_t member_count_ = 0;
  std::array<std::uint32_t, Groups::max_members + 2 * Prism::triangles_a_look> members_;
};

}  // namespace touchmark::grid

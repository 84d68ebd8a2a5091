/// The nearest of the triangles that a search comes by: filter in single precision, decide in double.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/geometry/point_triangle.h"
#include "core/geometry/widest_offset.h"
#include "core/grid_group/direct/box_tree.h"
#include "core/grid_group/direct/group_filter.h"
#include "core/grid_group/direct/triangle_store.h"
#include "core/search/linear_scan.h"
#include "core/search/ties/closest_candidates.h"
#include "core/search/ties/nearest_of_ties.h"
#include "core/search/tracing.h"
#include "core/simd/prefetch.h"

namespace touchmark::grid {

/// Returns what offset_from does for a centre that the plane filter puts inside the prism over the face: it
/// is inside by 2 units in the last place of single precision at least, far more than the rounding of the
/// kernel's own three tests, so they all hold. Fourth powers of the mesh's extent must stay within the range
/// of double.
inline Offset offset_over_face(const PreparedTriangle& triangle, const Vec3& center) noexcept {
  const std::array<Vec3, 3> to = {center - triangle.corner[0], center - triangle.corner[1],
                                  center - triangle.corner[2]};
  const std::array<double, 3> squared = {to[0].squaredNorm(), to[1].squaredNorm(), to[2].squaredNorm()};
  std::size_t near = squared[1] < squared[0] ? 1 : 0;
  if (squared[2] < squared[near]) near = 2;
  const double height = to[near].dot(triangle.normal);
  return {height * triangle.normal, height * height};
}

/// Starts at the reach, with room for the kernel's error, and tightens it with every triangle found.
class NearestSearch {
 public:
  /// The store's frame covers `center`, which is kept by reference.
  NearestSearch(const TriangleStore& store, const Vec3& center, double reach) noexcept
      : NearestSearch(store, center, store.frame.point(center), reach) {}
  NearestSearch(const TriangleStore&, const Vec3&&, double) = delete;
  /// `point` is the centre in that frame.
  NearestSearch(const TriangleStore& store, const Vec3& center, const FilterPoint& point,
                double reach) noexcept
      : store_(store),
        center_(center),
        point_(point),
        error_(store.frame.kernel_error(point_.plane_error)),
        limit_(store.frame.limit((reach + error_) * (reach + error_))),
        candidates_(store.exact.data(), center, error_) {}

  bool found() const noexcept { return found_; }
  std::uint32_t slot() const noexcept { return slot_; }  ///< slot of the nearest triangle
  /// Returns the offset from the nearest triangle as the exact kernel gives it. Something must have been
  /// found.
  Offset offset() const noexcept {
    const PreparedTriangle& triangle = store_.exact[slot_];
    if (known_) return offset_;
    return over_face_ ? offset_over_face(triangle, center_) : widest_offset_from(triangle, center_);
  }
  /// Returns true if the nearest is surely the first of those exactly as near. Something must have been
  /// found.
  bool is_surely_first() const noexcept { return candidates_.is_surely_first(error_); }
  /// The exactly nearest, the first where several are, when there is one; counts where whole numbers decide.
  const PreparedTriangle& exactly_nearest(std::uint64_t& exact_decisions) const noexcept;
  /// From now on any triangle within the radius ends the search, and no ties are kept. Those that doubles
  /// leave open are decided exactly, if `certified`. Before anything is considered.
  void seek_touch(double radius, bool certified) noexcept {
    candidates_.keep_no_ties();
    radius_ = radius;
    enough_ = radius - error_;
    enough_high_ = store_.frame.to_frame_rounded_down(enough_);
    if (!certified) return;
    // With room for the roundings of these, and of the root and the difference in leave_open: below 8 units.
    constexpr double error = 0x1p-48;
    const double from = std::max(enough_, 0.0), to = radius + error_;
    open_from_ = from * from * (1 - error);
    open_to_ = to * to * (1 + error);
  }
  /// Was a triangle found within the radius? Then `within` bounds its distance, and `slot` is its.
  bool touches() const noexcept { return within_ < enough_; }
  double within() const noexcept { return within_; }
  /// Decides at the end of the search what is still open, for the squared distance of the nearest.
  bool touches_at_last(double squared) noexcept { return is_open(squared) && decide_last(squared); }
  std::uint64_t exact_decisions() const noexcept { return exact_decisions_; }
  const FilterPoint& point() const noexcept { return point_; }
  double error() const noexcept { return error_; }  ///< bounds the error of a computed distance
  std::uint64_t triangles() const noexcept { return triangles_; }  ///< tested
  std::uint64_t boxes() const noexcept { return boxes_; }          ///< tested

  /// Can the triangle be within the limit, as far as its planes tell?
  bool may_be_near(std::uint32_t slot) noexcept {
    ++triangles_;
    return squared_lower_bound(plane_values(store_.planes[slot], point_), point_) <= limit_;
  }

  void consider(std::uint32_t slot) noexcept {
    ++triangles_;
    decide(slot);
  }

  /// Considers a group, which must come first and be all there is. Afterwards something is found unless
  /// nothing is within the limit. Returns a lower bound of the squared distance to all of them, in the frame.
  float consider_group(std::span<const std::uint32_t> members) noexcept;

  /// A guess at the nearest member, by the filter alone.
  std::uint32_t closest_of(std::span<const std::uint32_t> members) noexcept;

  /// Visits the tree nearest first. False when it has tested more than `budget` triangles and boxes before
  /// the end.
  bool consider_tree(const BoxTree& tree, std::uint64_t budget = any_work) noexcept {
    BoxStack stack;
    visit(tree, static_cast<std::uint32_t>(tree.levels()) - 1, 0, stack);
    while (!stack.empty()) {
      if (triangles_ + boxes_ > budget) return false;
      const BoxStack::Entry next = stack.pop();
      if (next.bound > limit_) continue;
      if (next.level > 0) {
        visit(tree, next.level - 1, next.index, stack);
      } else {
        consider_block(next.index);
        if (touches()) break;
      }
    }
    return true;
  }

 private:
  GroupBounds filter(std::span<const std::uint32_t> members) const noexcept;
  /// Bit i is set for member i.
  std::uint64_t within_limit(const GroupBounds& bounds, std::size_t members) const noexcept;

  void visit(const BoxTree& tree, std::uint32_t level, std::uint32_t node, BoxStack& stack) noexcept {
    boxes_ += BoxTree::arity;
    if constexpr (tracing) note_boxes(tree.node(level, node));
    const std::size_t base = stack.size();
    stack.push(lower_bounds(tree.node(level, node), point_), limit_, node, level);
    for (const BoxStack::Entry& child : stack.from(base)) {
      if (level > 0)
        prefetch_lines(&tree.node(level - 1, child.index), sizeof(EightBoxes));
      else
        prefetch_lines(&store_.planes[child.index * TriangleStore::block_size],
                       TriangleStore::block_size * sizeof(TrianglePlanes));
    }
  }
  void consider_block(std::uint32_t block) noexcept {
    const std::uint32_t first = block * TriangleStore::block_size;
    triangles_ += TriangleStore::block_size;
    for (std::uint32_t at = first; at < first + TriangleStore::block_size; at += 4) {
      const TrianglePlanes* planes = &store_.planes[at];
      const Lanes bounds = lower_bounds(planes[0], planes[1], planes[2], planes[3], point_);
      for (unsigned left = at_most(bounds, limit_); left != 0; left &= left - 1)
        decide(at + static_cast<std::uint32_t>(std::countr_zero(left)));
      if (touches()) return;
    }
  }
  void decide(std::uint32_t slot) noexcept {
    const PreparedTriangle& triangle = store_.exact[slot];
    if constexpr (tracing)
      if (visits != nullptr) visits->triangles.push_back(triangle.index);
    const Offset offset = widest_offset_from(triangle, center_);
    if (is_open(offset.squared)) leave_open(slot, offset.squared);
    if (!candidates_.update({offset.squared, triangle.index}, slot)) return;
    offset_ = offset;
    slot_ = slot;
    found_ = known_ = true;
    limit_ = std::min(limit_, store_.frame.limit(offset.squared));
    if (enough_ > 0) within_ = std::min(within_, std::sqrt(offset.squared));
  }
  void note_boxes(const EightBoxes& boxes) const;
  /// Do doubles leave open whether this is within the radius, or nearly so?
  bool is_open(double squared) const noexcept { return squared >= open_from_ && squared <= open_to_; }
  [[gnu::cold, gnu::noinline]] bool decide_last(double squared) noexcept;
  [[gnu::cold, gnu::noinline]] void leave_open(std::uint32_t slot, double squared) noexcept;
  void decide_open() noexcept;
  std::uint64_t without_far_balls(std::uint64_t left, std::span<const std::uint32_t> members) const noexcept;
  /// Is it, by its ball, farther than the limit?
  bool ball_excludes(std::uint32_t slot) const noexcept;

  const TriangleStore& store_;
  const Vec3& center_;
  FilterPoint point_;
  double error_;
  float limit_;
  bool found_ = false;
  bool known_ = false;  ///< offset_, and candidates_ with it
  double enough_ = -1;
  float enough_high_ = -1;  ///< `enough_` in the frame
  double within_ = std::numeric_limits<double>::infinity();
  double radius_ = 0;  ///< what touches is within it
  /// Squares of distances about the radius; from infinity where nothing is left open.
  double open_from_ = std::numeric_limits<double>::infinity(), open_to_ = -1;
  bool over_face_ = false;  ///< is the point surely over the face of the triangle found?
  std::uint32_t slot_ = 0;
  ClosestCandidates candidates_;
  Offset offset_{Vec3::Zero(), 0};
  std::uint64_t triangles_ = 0;
  std::uint64_t boxes_ = 0;
  std::uint64_t exact_decisions_ = 0;
  std::uint32_t open_count_ = 0;
  std::optional<WithinRadius> is_within_;  ///< what deciding these has told of the others
  std::array<std::uint32_t, 16> open_;     ///< slots that doubles leave open, not decided yet
};

}  // namespace touchmark::grid

/// A search for a triangle that is about as near as the nearest: what cells and samples are made from.
///
/// It keeps neither ties nor the offset, and boxes and triangles that are hardly nearer than what was found
/// are not looked into.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/geometry/widest_offset.h"
#include "core/grid_group/direct/box_tree.h"
#include "core/grid_group/direct/triangle_store.h"

namespace touchmark::grid {

/// What a rough search has found and looked at.
struct RoughNearest {
  double squared = std::numeric_limits<double>::infinity();  ///< distance, in mesh units; infinite: nothing
  std::uint32_t slot = 0;
  std::uint64_t triangles = 0, boxes = 0;
};

class RoughSearch {
 public:
  /// `center` is in the mesh's coordinates and is kept by reference. `part`, at most 1: at the end no
  /// triangle has a squared distance below this part of what was found. What is beyond `reach` by more than
  /// the kernel's error need not be found.
  RoughSearch(const TriangleStore& store, const Vec3& center, float part, double reach) noexcept
      : store_(store), center_(center), point_(store.frame.point(center)), part_(part) {
    const double padded = reach + store.frame.kernel_error(point_.plane_error);
    limit_ = store.frame.limit(padded * padded);
  }
  RoughSearch(const TriangleStore&, const Vec3&&, float, double) = delete;

  /// Looks at one triangle.
  void consider(std::uint32_t slot) noexcept {
    ++nearest_.triangles;
    measure(slot);
  }
  /// Looks through the tree, nearest boxes first. Returns false when it has looked at more than `budget`
  /// triangles and boxes before the end.
  bool consider_tree(const BoxTree& tree, std::uint64_t budget) noexcept;
  const RoughNearest& nearest() const noexcept { return nearest_; }

  // For the code of each instruction set.
  const TriangleStore& store() const noexcept { return store_; }
  const FilterPoint& point() const noexcept { return point_; }
  float limit() const noexcept { return limit_; }
  RoughNearest& found() noexcept { return nearest_; }
  void measure(std::uint32_t slot) noexcept {
    const double squared = widest_offset_from(store_.exact[slot], center_).squared;
    if (!(squared < nearest_.squared)) return;
    nearest_.squared = squared;
    nearest_.slot = slot;
    limit_ = std::min(limit_, store_.frame.limit(squared) * part_);
  }

 private:
  const TriangleStore& store_;
  const Vec3& center_;
  FilterPoint point_;
  float part_;
  float limit_;
  RoughNearest nearest_;
};

}  // namespace touchmark::grid

/// Looks for the first touch among many triangles that a moving ball may reach, and asks the exact sweep of
/// those alone that no plane keeps apart from it.
///
/// About the hub of a fan every needle is within rounding of its neighbours for all bounding volumes. Planes
/// in doubles tell them apart: those across the offsets from where the ball first touches, as far as is known.
#pragma once

#include <cstdint>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/probe.h"
#include "core/search/first_touch.h"
#include "core/simd/dispatch.h"
#include "core/sphere_cluster/tree/node.h"

namespace touchmark::spheres {

class SweepCandidates {
 public:
  /// `first`, which nothing has been shown yet, and the tree must outlive this.
  SweepCandidates(const TreeParts& tree, Simd simd, FirstTouch& first) noexcept
      : tree_(tree), simd_(simd), first_(first) {}

  /// Returns the part of the path that is still to be looked at.
  double limit() const noexcept { return first_.limit(); }
  /// Does the plane that kept the last one apart do so here?
  bool last_plane_keeps_apart(std::uint32_t at) const noexcept {
    return has_plane_ && keeps_apart(at, plane_);
  }
  /// Looks at the triangle in this slot. Counts what is measured besides.
  void consider(std::uint32_t at, Work& work) noexcept;
  /// Likewise, where its offset to a place on the path is known.
  void consider(std::uint32_t at, const Vec3& place, const Offset& found, Work& work) noexcept;
  /// Asks the exact sweep.
  void decide(std::uint32_t at, Work& work) noexcept;

 private:
  bool keeps_apart(std::uint32_t at, const Vec3& normal) const noexcept {
    return plane_keeps_apart(tree_.triangles[at], first_.sweep(), normal, first_.limit());
  }
  bool plane_across_keeps_apart(std::uint32_t at, const Offset& offset) noexcept;
  Offset measured(std::uint32_t at, const Vec3& place, Work& work) const noexcept;

  const TreeParts& tree_;
  Simd simd_;
  FirstTouch& first_;
  Vec3 end_ = Vec3::Zero();  ///< where the ball is at the first touch so far, rounded
  Vec3 plane_ = Vec3::Zero();
  bool has_plane_ = false;
};

}  // namespace touchmark::spheres

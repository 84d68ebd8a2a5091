/// Looks for the first touch among many triangles that a moving ball may reach, and asks the exact sweep of
/// those alone that no plane keeps apart from it.
///
/// About the hub of a fan every needle is within rounding of its neighbours for all bounding volumes. Planes
/// in doubles tell them apart: those across the offsets from where the ball first touches, as far as is
/// known.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/bvh/wide_bvh.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/probe.h"
#include "core/search/first_touch.h"
#include "core/search/memory/backoff.h"

namespace touchmark::queries {

class SweepCandidates {
 public:
  /// The hierarchy, and `first`, which nothing has been shown yet, must outlive this. `near` is the slot of a
  /// triangle near the start, or beyond all slots. With `waits` some triangles are looked at together, which
  /// is for a ball that comes near to many; else what is found first leaves less of the path to the next.
  SweepCandidates(const WideBvh& bvh, bool waits, std::uint32_t near, FirstTouch& first) noexcept
      : bvh_(bvh), triangles_(bvh.parts().triangles), waits_(waits), near_(near), first_(first) {}

  /// Returns the part of the path that is still to be looked at.
  double limit() const noexcept { return first_.limit(); }
  /// Is it known without measuring that there is nothing to be found at the triangle in this slot?
  bool passes_over(std::uint32_t at) noexcept {
    if (++shown_ < many) return false;
    return is_settled(at) || keeps_apart(at, plane_);
  }
  /// Looks at the triangle in this slot now, or together with others that wait: where there are eight, or
  /// `consider_waiting` is called.
  void take(std::uint32_t at, LimitedWork& work) noexcept {
    if (!waits_) return consider(at, work);
    waiting_[waiting_count_++] = at;
    if (waiting_count_ == waiting_.size()) consider_waiting(work);
  }
  void consider_waiting(LimitedWork& work) noexcept;
  /// Looks at the triangle in this slot. Counts where whole numbers decide.
  void consider(std::uint32_t at, LimitedWork& work) noexcept {
    if (passes_over(at)) return;
    if (shown_ < many) return decide(at, work);
    look_at(at, work);
  }
  /// Likewise, where its offset to a place on the path is known.
  void consider(std::uint32_t at, const Vec3& place, const Offset& found, LimitedWork& work) noexcept;

 private:
  /// So many triangles are many: it pays to look for planes, and to remember what has been settled.
  static constexpr std::uint32_t many = 16;
  static constexpr std::uint32_t max_settled = 2048;

  bool keeps_apart(std::uint32_t at, const Vec3& normal) const noexcept {
    return plane_keeps_apart(triangles_[at], first_.sweep(), normal, first_.limit());
  }
  bool is_settled(std::uint32_t at) const noexcept {
    return is_prepared_ && at < max_settled && (settled_[at / 64] >> at % 64 & 1) != 0;
  }
  void settle(std::uint32_t at) noexcept {
    if (is_prepared_ && at < max_settled) settled_[at / 64] |= std::uint64_t{1} << at % 64;
  }
  void look_at(std::uint32_t at, LimitedWork& work) noexcept;
  void prepare(LimitedWork& work) noexcept;
  Vec3 face_towards_start(std::uint32_t at) const noexcept;
  bool is_apart_across(std::uint32_t at, const Vec3& normal) noexcept;
  bool is_apart_by_known(std::uint32_t at) noexcept;
  bool is_apart_elsewhere(std::uint32_t at, const Vec3& place) noexcept;
  /// Asks the exact sweep, within the limit.
  void decide(std::uint32_t at, LimitedWork& work) noexcept {
    if (work.exceeds_limit()) return first_.give_up();
    first_.consider(triangles_[at], work.exact_decisions);
  }
  /// Returns where the ball is at the first touch so far, rounded, or at the end of the path.
  Vec3 end() const noexcept { return position_at(first_.sweep(), first_.limit()); }
  Offset measured(std::uint32_t at, const Vec3& place) const noexcept;

  const WideBvh& bvh_;
  std::span<const PreparedTriangle> triangles_;
  bool waits_;
  std::uint32_t near_;
  FirstTouch& first_;
  /// Normals of planes are zero, which keeps nothing apart, where there is none yet.
  Vec3 plane_ = Vec3::Zero();   ///< the normal of the one that kept the last triangle apart
  Vec3 face_ = Vec3::Zero();    ///< the near triangle's normal
  Vec3 across_ = Vec3::Zero();  ///< the direction of its offset
  std::uint32_t shown_ = 0, waiting_count_ = 0;
  std::array<std::uint32_t, bvh::width> waiting_;
  /// For so many more no other place is measured, since one did not tell a triangle apart; longer each time.
  Backoff<std::uint32_t, 3> elsewhere_;
  bool is_prepared_ = false;  ///< else the array is not set yet
  std::array<std::uint64_t, max_settled / 64> settled_;
};

}  // namespace touchmark::queries

/// A mesh that goes from where it is to where it is next within a tick, each vertex straight and at an even
/// pace.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// What `update` is going to do to a detector of `before`. Both meshes outlive this.
class MeshMotion {
 public:
  /// Throws std::invalid_argument when `after` has other vertices, corners or ids, as `update` does.
  MeshMotion(const TriangleMesh& before, const TriangleMesh& after);

  const TriangleMesh& before() const noexcept { return *before_; }
  const TriangleMesh& after() const noexcept { return *after_; }
  /// Returns how far a vertex goes at most, rounded up; 0 where and only where nothing moves.
  double max_shift() const noexcept { return max_shift_; }
  /// Returns the corners of a triangle of the mesh after a part of the tick, rounded; exact at 0 and 1.
  std::array<Vec3, 3> corners_at(std::uint32_t triangle, double time) const noexcept;
  /// Returns the contact at the end of the tick that one at a part of it becomes when it stays on its
  /// triangle and turns with it, rounded. Its distance is how far its point goes.
  Contact carried(const Contact& contact, double time) const noexcept;

 private:
  const TriangleMesh* before_;
  const TriangleMesh* after_;
  double max_shift_ = 0;
};

// Version 14 takes `noexcept ->` apart.
// clang-format off
/// The first touch of a probe that moves along a straight line while the mesh goes from where the detector has
/// it to where it is next. A point is touched where and only where it is touched exactly; its fraction is at most
/// 2^-50 early. A ball may be told to be touched where it is as near as max_early_moving_gap of
/// core/geometry/moving_triangle_sweep.h says. No fraction is late. A limit of work plays no part.
template <class D>
concept AnswersMovingSweep = requires(const D& detector, const Sweep& sweep, const MeshMotion& motion,
                                      typename D::Session& session) {
  { detector.first_hit_moving(sweep, motion, session) } noexcept -> std::same_as<std::optional<Impact>>;
};
// clang-format on

}  // namespace touchmark

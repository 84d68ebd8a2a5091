/// The kernel of point_triangle.h for any scalar: core decides in doubles, FloatTree in floats.
///
/// Which points are over the face is the caller's to say, since what its own test may compute depends on how
/// far squares reach in the scalar. Static and always inline, so that the compiler knows all callers:
/// the kernel for doubles takes 0.4 % more instructions than one written for them alone, else 2 %.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/geometry/point_triangle.h"

namespace touchmark::kernel {

template <class Scalar>
using Vector = Eigen::Matrix<Scalar, 3, 1>;

/// Which of two ends to measure a segment from must not depend on the order in which a triangle names them.
template <class Scalar>
static bool precedes(const Vector<Scalar>& a, const Vector<Scalar>& b) noexcept {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

/// From the segment between corners p and q, evaluated from the end nearer to the point; `to_p` and `to_q`
/// run from the ends to the point, `pp` and `qq` are their squared lengths.
template <class Scalar>
static OffsetIn<Scalar> from_segment(const Vector<Scalar>& p, const Vector<Scalar>& q,
                                     const Vector<Scalar>& to_p, const Vector<Scalar>& to_q, Scalar pp,
                                     Scalar qq) noexcept {
  const bool p_first = pp < qq || (pp == qq && precedes(p, q));
  const Vector<Scalar>& near = p_first ? to_p : to_q;
  const Scalar near_squared = p_first ? pp : qq;
  const Vector<Scalar> edge = p_first ? Vector<Scalar>(q - p) : Vector<Scalar>(p - q);
  const Scalar along = near.dot(edge);
  if (!(along > 0)) return {near, near_squared};
  // At most half way but for rounding; the ends of an edge that is short for its distance are equally near.
  const Vector<Scalar> across = near - std::min(along / edge.squaredNorm(), Scalar{1}) * edge;
  const Scalar squared = across.squaredNorm();
  if (squared < near_squared) return {across, squared};
  return {near, near_squared};
}

/// From a triangle with the corners and the unit normal of a PreparedTriangle. `surely_over_face(triangle,
/// to, squared)` says whether the point is inside the prism over it by more than rounding; `to` runs from the
/// corners to the point, `squared` are their squared lengths.
template <class Scalar, class Triangle, class SurelyOverFace>
[[gnu::always_inline]] inline OffsetIn<Scalar> offset_from(const Triangle& t, const Vector<Scalar>& point,
                                                           const SurelyOverFace& surely_over_face) noexcept {
  const std::array<Vector<Scalar>, 3> to = {point - t.corner[0], point - t.corner[1], point - t.corner[2]};
  const std::array<Scalar, 3> squared = {to[0].squaredNorm(), to[1].squaredNorm(), to[2].squaredNorm()};
  if (surely_over_face(t, to, squared)) {
    std::size_t near = squared[1] < squared[0] ? 1 : 0;
    if (squared[2] < squared[near]) near = 2;
    const Scalar height = to[near].dot(t.normal);
    return {height * t.normal, height * height};
  }
  OffsetIn<Scalar> best = from_segment(t.corner[0], t.corner[1], to[0], to[1], squared[0], squared[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    const OffsetIn<Scalar> other =
        from_segment(t.corner[i], t.corner[j], to[i], to[j], squared[i], squared[j]);
    if (other.squared < best.squared) best = other;
  }
  return best;
}

}  // namespace touchmark::kernel

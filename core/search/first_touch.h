/// The triangle that a moving ball touches first, of those that a search looks at, and the impact on it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/probe.h"
#include "core/search/tracing.h"
#include "core/triangle_ids.h"

namespace touchmark {

/// Keeps the smallest fraction, then the lowest index, so that triangles may come in any order and more than
/// once.
class FirstTouch {
 public:
  /// The sweep must outlive this.
  explicit FirstTouch(const Sweep& sweep) noexcept : sweep_(sweep) {}
  explicit FirstTouch(const Sweep&&) = delete;

  const Sweep& sweep() const noexcept { return sweep_; }
  bool found() const noexcept { return triangle_ != nullptr; }
  /// Returns the part of the path that is still to be looked at.
  double limit() const noexcept { return bounds_.last; }

  /// Leaves nothing of the path to look at.
  void give_up() noexcept { bounds_ = {-1, -1}; }
  /// Looks at a triangle, which must outlive this; counts where whole numbers decide. Fractions are refined
  /// only where bounds do not tell which is smaller.
  void consider(const PreparedTriangle& triangle, std::uint64_t& exact_decisions) noexcept {
    if constexpr (tracing) note_triangle(triangle.index);
    if (found() && triangle.index == triangle_->index) return;
    std::optional<TouchBounds> other = touch_bounds(triangle, sweep_, limit(), exact_decisions);
    if (!other) return;
    if (found() && other->last >= bounds_.first) {
      const double fraction = touch_fraction(triangle, sweep_, *other, exact_decisions);
      refine(exact_decisions);
      if (fraction > bounds_.first || (fraction == bounds_.first && triangle.index > triangle_->index))
        return;
      other = {fraction, fraction};
    }
    triangle_ = &triangle;
    bounds_ = *other;
  }
  /// Returns the triangle found and the fraction at which it is touched.
  const PreparedTriangle& triangle() const noexcept { return *triangle_; }
  double fraction() const noexcept {
    std::uint64_t uncounted = 0;
    return touch_fraction(*triangle_, sweep_, bounds_, uncounted);
  }

 private:
  void refine(std::uint64_t& exact_decisions) noexcept {
    bounds_.first = bounds_.last = touch_fraction(*triangle_, sweep_, bounds_, exact_decisions);
  }

  const Sweep& sweep_;
  const PreparedTriangle* triangle_ = nullptr;
  TouchBounds bounds_{0, 1};
};

/// Ends a search for `first_hit`: returns the impact, or nothing. Of all the triangles that are touched at
/// the start the nearest one counts: nearest(reach) looks for it. Where contact is decided by doubles, these
/// may find it beyond the radius, so that any reach will do.
template <class Nearest>
std::optional<Impact> impact_of(const FirstTouch& first, const TriangleIds& ids, bool decides_exactly,
                                const Nearest& nearest) noexcept {
  if (!first.found()) return std::nullopt;
  const Sweep& sweep = first.sweep();
  const double fraction = first.fraction();
  if (fraction == 0) {
    const double reach = decides_exactly ? sweep.radius : std::numeric_limits<double>::infinity();
    if (const std::optional<Contact> start = nearest(reach)) return Impact{0, *start};
  }
  const PreparedTriangle& triangle = first.triangle();
  return Impact{fraction, contact_on_path(triangle, sweep, fraction, ids[triangle.index])};
}

}  // namespace touchmark

#include "core/geometry/moving_triangle_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/exact/moving_triangle.h"
#include "core/float_limits.h"
#include "core/geometry/distance_error.h"
#include "core/geometry/point_triangle.h"

namespace touchmark {
namespace {

/// No shorter part of a tick is looked at.
constexpr double shortest = 0x1p-22;

/// The triangle as the probe sees it, in a unit in which squares are far from the limits of double.
class SeenTriangle {
 public:
  SeenTriangle(const TriangleCorners& start, const TriangleCorners& end, const Sweep& sweep, double unit)
      : radius_(unit * sweep.radius) {
    for (std::size_t i = 0; i < 3; ++i) {
      start_[i] = unit * start[i] - unit * sweep.from;
      way_[i] = (unit * end[i] - unit * sweep.to) - start_[i];
      size_ = std::max({size_, start_[i].cwiseAbs().maxCoeff(), (start_[i] + way_[i]).cwiseAbs().maxCoeff()});
      speed_ = std::max(speed_, way_[i].norm());
    }
  }
  double size() const noexcept { return size_; }

  /// The place before which planes keep ball and triangle apart, or nothing where they do up to the limit.
  std::optional<double> first_hit(double limit) const noexcept {
    View begin = at(0);
    double time = 0, length = 1;
    while (time <= limit) {
      if (begin.distance <= radius_ + 0x1p-20 * speed_ + error()) return time;
      const double next = std::min(time + length, 1.0);
      const View end = at(next);
      if (are_apart(begin, end)) {
        if (next == 1) return std::nullopt;
        begin = end;
        time = next;
        length *= 2;
      } else if (next - time <= shortest) {
        return time;
      } else {
        length = (next - time) / 2;
      }
    }
    return std::nullopt;
  }

 private:
  struct View {
    TriangleCorners corner;
    Vec3 towards;  ///< unit, from the probe to the nearest place; zero on the triangle
    double distance;
  };

  /// Bounds the rounding of a corner's height in a direction.
  double error() const noexcept { return 64 * unit_roundoff * size_; }
  View at(double time) const noexcept {
    View view;
    for (std::size_t i = 0; i < 3; ++i) view.corner[i] = start_[i] + time * way_[i];
    const Offset offset =
        offset_from(prepare(view.corner[0], view.corner[1], view.corner[2], 0), Vec3::Zero());
    view.distance = std::sqrt(offset.squared);
    view.towards = view.distance > 0 ? Vec3(-offset.vector / view.distance) : Vec3(Vec3::Zero());
    return view;
  }
  /// A corner's height in a direction that goes from one to the other at an even pace has the second degree.
  /// It is above the radius with these three coefficients, and so is the distance of all of the triangle.
  bool are_apart(const View& begin, const View& end) const noexcept {
    const double least = radius_ + error();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &first = begin.corner[i], &last = end.corner[i];
      if (!(begin.towards.dot(first) > least && end.towards.dot(last) > least &&
            begin.towards.dot(last) + end.towards.dot(first) > 2 * least))
        return false;
    }
    return true;
  }

  TriangleCorners start_, way_;
  double radius_;
  double size_ = 0, speed_ = 0;
};

}  // namespace

std::optional<double> moving_sweep_hit(const TriangleCorners& start, const TriangleCorners& end,
                                       const Sweep& sweep, double limit,
                                       std::uint64_t& exact_decisions) noexcept {
  if (!(sweep.radius >= 0) || !sweep.from.allFinite() || !sweep.to.allFinite()) return std::nullopt;
  SeenTriangle seen(start, end, sweep, 1);
  if (!fourth_powers_fit(seen.size())) seen = SeenTriangle(start, end, sweep, unit_for(seen.size()));
  const std::optional<double> hit = seen.first_hit(limit);
  if (!hit || sweep.radius > 0) return hit;
  ++exact_decisions;
  const std::optional<double> met = first_meeting(start, end, sweep.from, sweep.to);
  return met && *met <= limit ? met : std::nullopt;
}

}  // namespace touchmark

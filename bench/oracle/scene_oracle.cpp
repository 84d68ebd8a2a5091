#include "bench/oracle/scene_oracle.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <stdexcept>
#include <string>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/float_limits.h"
#include "bench/oracle/placed_bounds.h"
#include "bench/oracle/triangle.h"
#include "core/probe.h"

namespace touchmark::bench::oracle {
namespace {

// What is true of one triangle of a body, or of a round body, whose surface is so far from its axis. All
// exact: bounds decide where they can, whole numbers where they cannot.

/// True if the point is nearer to a round body's axis than the surface is, by more than this.
bool is_inside_by(const Vec3& point, const PlacedTriangle& round, double margin) {
  return margin < round.radius && compare_distance(point, round, round.radius, -margin) < 0;
}
bool is_outside_by(const Vec3& point, const PlacedTriangle& round, double margin) {
  return compare_distance(point, round, round.radius, margin) > 0;
}

/// True if the surface is within the radius, which is at least 0, of the point.
bool is_within(const Vec3& point, const PlacedTriangle& triangle, double radius) {
  const Interval distance = bounds_of(point, triangle);
  if (distance.hi <= radius) return true;
  if (distance.lo > radius) return false;
  return compare_distance(point, triangle, radius, triangle.radius) <= 0 &&
         !is_inside_by(point, triangle, radius);
}

/// True if it is within the radius of a point of the segment.
bool is_within(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double radius) {
  const Interval distance = bounds_of(from, to, triangle);
  if (distance.hi <= radius) return true;
  if (distance.lo > radius) return false;
  // The distance to the axis is convex along the segment: one inside at both ends is inside all the way.
  return compare_segment_distance(from, to, triangle, radius, triangle.radius) <= 0 &&
         !(is_inside_by(from, triangle, radius) && is_inside_by(to, triangle, radius));
}

/// Returns true if it is nearer than the radius to a point of the segment.
bool is_nearer(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double radius) {
  const Interval distance = bounds_of(from, to, triangle);
  if (distance.hi < radius) return true;
  if (distance.lo >= radius) return false;
  const auto is_far_inside = [&](const Vec3& end) {
    return radius <= triangle.radius && compare_distance(end, triangle, triangle.radius, -radius) <= 0;
  };
  return compare_segment_distance(from, to, triangle, radius, triangle.radius) < 0 &&
         !(is_far_inside(from) && is_far_inside(to));
}

/// True if it is within the radius of the point at that fraction of the path, which is not rounded.
bool is_within_on_path(const Sweep& sweep, double fraction, const PlacedTriangle& triangle, double radius) {
  const auto compare = [&](double more) {
    return compare_distance_on_path(sweep.from, sweep.to, fraction, triangle, triangle.radius, more);
  };
  return compare(radius) <= 0 && (radius >= triangle.radius || compare(-radius) >= 0);
}

/// Reference::touches_before, for this one.
bool is_touched_before(const Sweep& sweep, double fraction, const PlacedTriangle& triangle) {
  const Vec3 &from = sweep.from, &to = sweep.to;
  const double radius = sweep.radius;
  if (is_inside_by(from, triangle, radius))
    return compare_distance_on_path(from, to, fraction, triangle, triangle.radius, -radius) > 0;
  const auto up_to = [&](double part) {
    return compare_part_distance(from, to, part, triangle, radius, triangle.radius);
  };
  const std::strong_ordering order = up_to(fraction);
  if (order != 0) return order < 0;
  // At the very radius: only from here on?
  return compare_distance_on_path(from, to, fraction, triangle, radius, triangle.radius) != 0 ||
         up_to(std::nextafter(fraction, 0)) <= 0;
}

/// A face, which keeps its edges and both ends that far away.
bool is_surely_pierced(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double margin) {
  if (!is_within(from, to, triangle, 0)) return false;
  if (is_within(from, triangle, margin) || is_within(to, triangle, margin)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = triangle.corners[i], &b = triangle.corners[(i + 1) % 3];
    if (is_within(from, to, {{a, b, b}, triangle.pose}, margin)) return false;
  }
  return true;
}

/// Reference::surely_crosses, for this one.
bool is_surely_crossed(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double margin) {
  if (!(triangle.radius > 0)) return is_surely_pierced(from, to, triangle, margin);
  if (is_inside_by(from, triangle, margin)) return is_outside_by(to, triangle, margin);
  if (!is_outside_by(from, triangle, margin)) return false;
  if (is_inside_by(to, triangle, margin)) return true;
  return is_outside_by(to, triangle, margin) && margin < triangle.radius &&
         compare_segment_distance(from, to, triangle, triangle.radius, -margin) < 0;
}

}  // namespace

struct SceneOracle::Structure {
  std::vector<std::shared_ptr<const TriangleMesh>> shapes;
  std::vector<TriangleTree> trees;  ///< a shape each
  std::vector<Seen> bodies;
  std::vector<std::uint32_t> first;  ///< triangle of each body, and the end of the last one
  Box box;
  bool round = false;              ///< some body is
  mutable std::uint32_t hint = 0;  ///< a triangle that was near; any will do

  PlacedTriangle triangle(std::uint32_t number) const {
    const std::uint32_t body = body_of(number);
    const Seen& seen = bodies[body];
    return {triangle_of(*shapes[seen.shape], number - first[body]), &seen.pose, seen.radius};
  }
  std::uint32_t body_of(std::uint32_t number) const {
    return static_cast<std::uint32_t>(std::ranges::upper_bound(first, number) - first.begin() - 1);
  }

  /// Calls visit(number) for every triangle that the segment may come within `limit` of, which may shrink
  /// meanwhile.
  template <class Visit>
  void near(const Vec3& from, const Vec3& to, const double& limit, const Visit& visit) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Seen& body = bodies[i];
      const LocalPoint begin = local(body, from), end = local(body, to);
      const double error = std::max(begin.error, end.error);
      const double shrunk = 1 - body.rigid - 4 * unit_roundoff;
      const auto below = [&](const Box& one) {
        if (!std::isfinite(error) || !begin.point.allFinite() || !end.point.allFinite()) return 0.0;
        const double distance =
            from == to ? distance_below(one, begin.point) : distance_below(one, begin.point, end.point);
        const double to_image = (distance - error) * shrunk;
        return std::max(0.0, to_image - body.radius - 4 * unit_roundoff * (to_image + body.radius));
      };
      trees[body.shape].visit(below, limit, [&](std::uint32_t triangle) { visit(first[i] + triangle); });
    }
  }

  template <class Holds>
  bool any(const Vec3& from, const Vec3& to, double radius, const Holds& holds) const {
    bool found = false;
    double limit = radius;
    near(from, to, limit, [&](std::uint32_t number) {
      if (found || !holds(triangle(number))) return;
      found = true;
      limit = -1;  // nothing more to visit
    });
    return found;
  }

  /// Asks the triangles near to the path up to the fraction, or only to its end.
  template <class Holds>
  bool any_on_path(const Sweep& sweep, double fraction, bool only_end, double radius,
                   const Holds& holds) const {
    if (!sweep.from.allFinite() || !sweep.to.allFinite() || !(radius >= 0)) return false;
    const Vec3 end = (1 - fraction) * sweep.from + fraction * sweep.to;
    const Vec3& begin = only_end ? end : sweep.from;
    // Four roundings a coordinate, of what is no larger than the ends; four times that.
    const double rounding =
        32 * unit_roundoff * (sweep.from.cwiseAbs().maxCoeff() + sweep.to.cwiseAbs().maxCoeff());
    const double reach = (radius + rounding) * (1 + 8 * unit_roundoff);
    return any(begin, end, reach, [&](const PlacedTriangle& one) {
      return bounds_of(begin, end, one).lo <= reach && holds(one);
    });
  }

  /// The triangles that may be nearest, ascending; a nearest one is surely among them.
  std::vector<std::uint32_t> candidates(const Vec3& center) const {
    struct Candidate {
      std::uint32_t number;
      double lo;
    };
    double limit = bounds_of(center, triangle(hint)).hi;
    std::vector<Candidate> found;
    near(center, center, limit, [&](std::uint32_t number) {
      const Interval distance = bounds_of(center, triangle(number));
      if (distance.lo > limit) return;
      limit = std::min(limit, distance.hi);
      found.push_back({number, distance.lo});
    });
    std::vector<std::uint32_t> numbers;
    for (const Candidate& candidate : found)
      if (candidate.lo <= limit) numbers.push_back(candidate.number);
    std::ranges::sort(numbers);
    return numbers;
  }

  GroundTruth truth(const Vec3& center, const std::vector<std::uint32_t>& numbers) const {
    std::vector<PlacedTriangle> triangles;
    for (const std::uint32_t number : numbers) triangles.push_back(triangle(number));
    const ExactNearest exact = nearest_exactly(center, triangles);
    const std::uint32_t nearest = numbers[exact.which];
    return {true,
            nearest,
            exact.high,
            exact.low,
            exact.point,
            exact.direction,
            largest_difference(center, nearest)};
  }

  double largest_difference(const Vec3& center, std::uint32_t number) const {
    double largest = 0;
    const PlacedTriangle one = triangle(number);
    for (const Vec3& v : rounded(one).corners)
      largest = std::max(largest, (v - center).cwiseAbs().maxCoeff());
    return largest + one.radius;
  }
};

SceneOracle::SceneOracle(std::vector<std::shared_ptr<const TriangleMesh>> shapes, std::vector<Body> bodies)
    : structure_(std::make_unique<Structure>()) {
  Structure& s = *structure_;
  s.shapes = std::move(shapes);
  for (const auto& shape : s.shapes) s.trees.emplace_back(*shape);
  std::uint64_t sum = 0;
  s.box = {Vec3::Constant(infinity), Vec3::Constant(-infinity)};
  for (const Body& body : bodies) {
    s.first.push_back(static_cast<std::uint32_t>(sum));
    s.bodies.push_back({body.shape, body.pose, rigidity(body.pose.rotation), body.radius});
    s.round = s.round || body.radius > 0;
    const TriangleMesh& shape = *s.shapes[body.shape];
    sum += shape.size();
    if (sum > std::numeric_limits<std::uint32_t>::max())
      throw std::invalid_argument("the bodies have 2^32 triangles or more together, and cannot be judged");
    for (std::uint32_t i = 0; i < shape.size(); ++i) {
      const Box one = box_of(rounded({triangle_of(shape, i), &body.pose}).corners);
      s.box = {s.box.min.cwiseMin(one.min - Vec3::Constant(body.radius)),
               s.box.max.cwiseMax(one.max + Vec3::Constant(body.radius))};
    }
  }
  s.first.push_back(static_cast<std::uint32_t>(sum));
}
SceneOracle::~SceneOracle() = default;
SceneOracle::SceneOracle(SceneOracle&&) noexcept = default;
SceneOracle& SceneOracle::operator=(SceneOracle&&) noexcept = default;

void SceneOracle::place(std::uint32_t body, const Pose& pose) {
  Seen& seen = structure_->bodies.at(body);
  seen.pose = pose;
  seen.rigid = rigidity(pose.rotation);
}

const Pose& SceneOracle::pose(std::uint32_t body) const { return structure_->bodies.at(body).pose; }

GroundTruth SceneOracle::solve(const Vec3& center) const {
  if (!center.allFinite()) return {};
  GroundTruth truth = structure_->truth(center, structure_->candidates(center));
  structure_->hint = truth.triangle;
  return truth;
}

GroundTruth SceneOracle::solve(const Vec3& center, std::uint32_t triangle) const {
  if (!center.allFinite()) return {};
  return structure_->truth(center, {triangle});
}

bool SceneOracle::within(const GroundTruth& truth, const Vec3& center, double radius) const {
  // The digits are those of a root, and of what a radius leaves of it.
  if (structure_->round) return truth.defined && within(truth.triangle, center, radius);
  const std::optional<bool> told = within_by_digits(truth, radius);
  return told ? *told : compare_distance(center, structure_->triangle(truth.triangle), radius) <= 0;
}

bool SceneOracle::within(std::uint32_t triangle, const Vec3& center, double radius) const {
  return center.allFinite() && radius >= 0 && is_within(center, structure_->triangle(triangle), radius);
}

std::vector<std::uint32_t> SceneOracle::all_within(const Vec3& center, double radius) const {
  std::vector<std::uint32_t> found;
  if (!center.allFinite() || !(radius >= 0)) return found;
  structure_->near(center, center, radius, [&](std::uint32_t number) {
    if (within(number, center, radius)) found.push_back(number);
  });
  std::ranges::sort(found);
  return found;
}

bool SceneOracle::segment_within(const Vec3& from, const Vec3& to, double radius) const {
  if (!from.allFinite() || !to.allFinite() || !(radius >= 0)) return false;
  return structure_->any(from, to, radius,
                         [&](const PlacedTriangle& one) { return is_within(from, to, one, radius); });
}

bool SceneOracle::segment_nearer(const Vec3& from, const Vec3& to, double radius) const {
  if (!from.allFinite() || !to.allFinite() || !(radius >= 0)) return false;
  return structure_->any(from, to, radius,
                         [&](const PlacedTriangle& one) { return is_nearer(from, to, one, radius); });
}

bool SceneOracle::touches_before(const Sweep& sweep, double fraction) const {
  return fraction > 0 &&
         structure_->any_on_path(sweep, fraction, false, sweep.radius, [&](const PlacedTriangle& one) {
           return is_touched_before(sweep, fraction, one);
         });
}

bool SceneOracle::touches_soon_after(const Sweep& sweep, double fraction, double radius) const {
  return structure_->any_on_path(sweep, fraction, true, radius, [&](const PlacedTriangle& one) {
    return is_within_on_path(sweep, fraction, one, radius);
  });
}

bool SceneOracle::surely_crosses(const Vec3& from, const Vec3& to, double margin) const {
  if (!from.allFinite() || !to.allFinite() || !(margin >= 0)) return false;
  return structure_->any(from, to, 0,
                         [&](const PlacedTriangle& one) { return is_surely_crossed(from, to, one, margin); });
}

std::pair<std::size_t, std::size_t> SceneOracle::named_by(const workload::Answer& answer) const {
  const Structure& s = *structure_;
  if (answer.body >= s.bodies.size()) return {0, 0};
  const auto [begin, end] = positions_of(*s.shapes[s.bodies[answer.body].shape], answer.triangle);
  return {s.first[answer.body] + begin, s.first[answer.body] + end};
}

std::pair<std::uint32_t, TriangleId> SceneOracle::name_of(std::uint32_t triangle) const {
  const Structure& s = *structure_;
  const std::uint32_t body = s.body_of(triangle);
  return {body, s.shapes[s.bodies[body].shape]->id(triangle - s.first[body])};
}

bool SceneOracle::names_first(const GroundTruth& truth, const workload::Answer& answer) const {
  return name_of(truth.triangle) == std::pair(answer.body, answer.triangle);
}

double SceneOracle::largest_difference(const Vec3& center, std::uint32_t triangle) const {
  return structure_->largest_difference(center, triangle);
}

Interval SceneOracle::distance_bounds(const Vec3& point, std::uint32_t triangle) const {
  return bounds_of(point, structure_->triangle(triangle));
}

Box SceneOracle::bounds() const { return structure_->box; }

}  // namespace touchmark::bench::oracle

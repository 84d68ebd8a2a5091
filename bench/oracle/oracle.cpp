#include "bench/oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <thread>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/exact/exact_winding.h"
#include "bench/oracle/exact/interval_distance.h"
#include "bench/oracle/float_limits.h"
#include "bench/oracle/parallel.h"
#include "bench/oracle/triangle_tree.h"

namespace touchmark::bench::oracle {
namespace {

struct Candidate {
  std::uint32_t triangle;
  double lo;
};

double largest_difference(const Vec3& point, const Triangle& triangle) noexcept {
  double largest = 0;
  for (const Vec3& v : triangle) largest = std::max(largest, (v - point).cwiseAbs().maxCoeff());
  return largest;
}

/// Returns true if every point x of the triangle is surely farther from `point` than `witness` q is. So it is
/// when (p - q).(x - q) < 0, as |p - x|^2 = |p - q|^2 - 2 (p - q).(x - q) + |x - q|^2. From far away this
/// tells triangles apart by their own size's rounding, where the distances themselves drown in theirs.
bool surely_farther(const Triangle& triangle, const Vec3& witness, const Vec3& point) noexcept {
  constexpr double roundings = 8 * unit_roundoff;  // two differences, three products and sums, two lengths
  const Vec3 to_point = point - witness;
  return std::ranges::all_of(triangle, [&](const Vec3& v) {
    const Vec3 to_corner = v - witness;
    return to_point.dot(to_corner) < -roundings * to_point.norm() * to_corner.norm();
  });
}

/// The corner nearest to the point, as far as double can tell.
Vec3 nearest_corner(std::span<const Triangle> triangles, const Vec3& point) noexcept {
  Vec3 nearest = triangles.front().front();
  for (const Triangle& triangle : triangles)
    for (const Vec3& v : triangle)
      if ((v - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = v;
  return nearest;
}

/// Returns true if the distance between the segment and the triangle is at most `radius`. Exact.
bool segment_is_within(const Vec3& from, const Vec3& to, const Triangle& triangle, double radius) {
  const Interval distance = segment_distance_interval(from, to, triangle);
  if (distance.hi <= radius) return true;
  if (distance.lo > radius) return false;
  return compare_segment_distance(from, to, triangle, radius) <= 0;
}

GroundTruth truth_of(const Vec3& center, std::uint32_t index, const Triangle& triangle,
                     const ExactNearest& nearest) {
  return {true,
          index,
          nearest.high,
          nearest.low,
          nearest.point,
          nearest.direction,
          largest_difference(center, triangle)};
}

/// The box of the corners.
Box box_of(const TriangleMesh& mesh) {
  Box box{mesh.corner(0, 0), mesh.corner(0, 0)};
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const Box one = oracle::box_of(triangle_of(mesh, i));
    box = {box.min.cwiseMin(one.min), box.max.cwiseMax(one.max)};
  }
  return box;
}

}  // namespace

struct Oracle::Structure {
  const TriangleMesh* mesh;
  Box bounds;
  unsigned threads;
  TriangleTree tree;
  mutable std::once_flag sides_asked{};
  mutable std::optional<ExactSides> sides = std::nullopt;  // made when first asked for

  GroundTruth nearest(const Vec3& center, std::optional<std::uint32_t> hint) const;
  std::vector<Candidate> candidates(const Vec3& center, std::optional<std::uint32_t> hint) const;
};

/// Every triangle that the intervals leave in doubt, ascending; a nearest one is surely among them. `hint` is
/// a triangle that may be near.
std::vector<Candidate> Oracle::Structure::candidates(const Vec3& center,
                                                     std::optional<std::uint32_t> hint) const {
  double limit = infinity;
  if (hint) limit = distance_interval(center, triangle_of(*mesh, *hint)).hi;
  std::vector<Candidate> found;
  const auto below = [&](const Box& box) { return distance_below(box, center); };
  tree.visit(below, limit, [&](std::uint32_t index) {
    const Triangle triangle = triangle_of(*mesh, index);
    if (below(box_of(triangle)) > limit) return;  // far cheaper than the interval
    const Interval distance = distance_interval(center, triangle);
    if (distance.lo > limit) return;
    limit = std::min(limit, distance.hi);
    found.push_back({index, distance.lo});
  });
  std::erase_if(found, [&](const Candidate& candidate) { return candidate.lo > limit; });
  std::ranges::sort(found, [](const Candidate& a, const Candidate& b) { return a.triangle < b.triangle; });
  return found;
}

GroundTruth Oracle::Structure::nearest(const Vec3& center, std::optional<std::uint32_t> hint) const {
  if (!center.allFinite()) return {};
  std::vector<std::uint32_t> indices;
  std::vector<Triangle> triangles;
  for (const Candidate& candidate : candidates(center, hint)) {
    indices.push_back(candidate.triangle);
    triangles.push_back(triangle_of(*mesh, candidate.triangle));
  }
  if (triangles.size() > 2) {
    const Vec3 witness = nearest_corner(triangles, center);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (surely_farther(triangles[i], witness, center)) continue;
      indices[kept] = indices[i];
      triangles[kept++] = triangles[i];
    }
    triangles.resize(kept);
  }
  const ExactNearest exact = nearest_exactly(center, triangles);
  return truth_of(center, indices[exact.which], triangles[exact.which], exact);
}

Oracle::Oracle(const TriangleMesh& mesh, unsigned threads)
    : structure_(new Structure{&mesh, box_of(mesh),
                               threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency()),
                               TriangleTree(mesh)}) {}
Oracle::~Oracle() = default;
Oracle::Oracle(Oracle&&) noexcept = default;
Oracle& Oracle::operator=(Oracle&&) noexcept = default;

const TriangleMesh& Oracle::mesh() const noexcept { return *structure_->mesh; }
unsigned Oracle::threads() const noexcept { return structure_->threads; }

std::vector<GroundTruth> Oracle::solve(std::span<const Probe> probes) const {
  std::vector<GroundTruth> truths(probes.size());
  in_parallel(probes.size(), threads(), [&](std::size_t begin, std::size_t end) {
    std::optional<std::uint32_t> hint;
    for (std::size_t i = begin; i < end; ++i) {
      // Several radii about one centre are one question.
      truths[i] = i > begin && probes[i].center == probes[i - 1].center
                      ? truths[i - 1]
                      : structure_->nearest(probes[i].center, hint);
      if (truths[i].defined) hint = truths[i].triangle;
    }
  });
  return truths;
}

std::vector<SweepGroundTruth> Oracle::solve(std::span<const Sweep> sweeps) const {
  std::vector<SweepGroundTruth> truths(sweeps.size());
  in_parallel(sweeps.size(), threads(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) truths[i] = solve(sweeps[i]);
  });
  return truths;
}

GroundTruth Oracle::solve(const Vec3& center) const { return structure_->nearest(center, std::nullopt); }

GroundTruth Oracle::solve(const Vec3& center, std::uint32_t triangle) const {
  if (!center.allFinite()) return {};
  const Triangle corners = triangle_of(mesh(), triangle);
  return truth_of(center, triangle, corners, nearest_exactly(center, {&corners, 1}));
}

SweepGroundTruth Oracle::solve(const Sweep& sweep) const { return truth_of_sweep(*this, sweep); }

bool Oracle::within(const GroundTruth& truth, const Vec3& center, double radius) const {
  const std::optional<bool> told = within_by_digits(truth, radius);
  return told ? *told : compare_distance(center, triangle_of(mesh(), truth.triangle), radius) <= 0;
}

std::pair<std::size_t, std::size_t> Oracle::named_by(const workload::Answer& answer) const {
  return positions_of(mesh(), answer.triangle);
}

double Oracle::largest_difference(const Vec3& center, std::uint32_t triangle) const {
  return oracle::largest_difference(center, triangle_of(mesh(), triangle));
}

Interval Oracle::distance_bounds(const Vec3& point, std::uint32_t triangle) const {
  return distance_interval(point, triangle_of(mesh(), triangle));
}

Box Oracle::bounds() const { return structure_->bounds; }

std::optional<Side> Oracle::side(const Vec3& center) const {
  std::call_once(structure_->sides_asked, [&] { structure_->sides.emplace(mesh()); });
  if (!structure_->sides->closed()) return std::nullopt;
  return structure_->sides->side(center);
}

bool Oracle::within(std::uint32_t triangle, const Vec3& center, double radius) const {
  if (!center.allFinite() || !(radius >= 0)) return false;
  const Triangle corners = triangle_of(mesh(), triangle);
  const Interval distance = distance_interval(center, corners);
  if (distance.hi <= radius) return true;
  if (distance.lo > radius) return false;
  return compare_distance(center, corners, radius) <= 0;
}

/// At most as near as the radius, or nearer.
bool Oracle::segment_comes(const Vec3& from, const Vec3& to, double radius, bool nearer) const {
  if (!from.allFinite() || !to.allFinite() || !(radius >= 0)) return false;
  const auto is_below = [&](double distance) { return nearer ? distance < radius : distance <= radius; };
  bool surely = false;
  double limit = radius;
  std::vector<std::uint32_t> doubtful;
  structure_->tree.visit([&](const Box& box) { return distance_below(box, from, to); }, limit,
                         [&](std::uint32_t triangle) {
                           if (surely) return;
                           const Triangle corners = triangle_of(mesh(), triangle);
                           // This costs far less than the interval.
                           if (distance_of_boxes_below(box_of(corners), from, to) > radius) return;
                           const Interval distance = segment_distance_interval(from, to, corners);
                           if (is_below(distance.hi)) {
                             surely = true;
                             limit = -1;  // nothing more to visit
                           } else if (is_below(distance.lo)) {
                             doubtful.push_back(triangle);
                           }
                         });
  return surely || std::ranges::any_of(doubtful, [&](std::uint32_t triangle) {
           const std::strong_ordering order =
               compare_segment_distance(from, to, triangle_of(mesh(), triangle), radius);
           return nearer ? order < 0 : order <= 0;
         });
}

template <class Holds>
bool Oracle::any_near(const Sweep& sweep, double fraction, const Holds& holds) const {
  if (!sweep.from.allFinite() || !sweep.to.allFinite() || !(sweep.radius >= 0)) return false;
  const Vec3 end = (1 - fraction) * sweep.from + fraction * sweep.to;
  // Four roundings a coordinate, of what is no larger than the ends; twice that.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() *
                          (sweep.from.cwiseAbs().maxCoeff() + sweep.to.cwiseAbs().maxCoeff());
  const double reach = (sweep.radius + rounding) * (1 + 4 * std::numeric_limits<double>::epsilon());
  bool found = false;
  double limit = reach;
  structure_->tree.visit([&](const Box& box) { return distance_below(box, sweep.from, end); }, limit,
                         [&](std::uint32_t index) {
                           if (found) return;
                           const Triangle triangle = triangle_of(mesh(), index);
                           if (segment_distance_interval(sweep.from, end, triangle).lo > reach) return;
                           found = holds(triangle);
                           if (found) limit = -1;  // nothing more to visit
                         });
  return found;
}

bool Oracle::touches_before(const Sweep& sweep, double fraction) const {
  const Vec3 &from = sweep.from, &to = sweep.to;
  const double radius = sweep.radius;
  const auto touched = [&](const Triangle& triangle) {
    const std::strong_ordering order = compare_part_distance(from, to, fraction, triangle, radius);
    if (order != 0) return order < 0;
    // At the very radius: only from here on?
    return compare_distance_on_path(from, to, fraction, triangle, radius) != 0 ||
           compare_part_distance(from, to, std::nextafter(fraction, 0), triangle, radius) <= 0;
  };
  return fraction > 0 && any_near(sweep, fraction, touched);
}

bool Oracle::touches_soon_after(const Sweep& sweep, double fraction, double /*radius*/) const {
  const double end = std::min(fraction + 0x1p-50, 1.0);
  return any_near(sweep, end, [&](const Triangle& triangle) {
    return compare_part_distance(sweep.from, sweep.to, end, triangle, sweep.radius) <= 0;
  });
}

bool Oracle::surely_crosses(const Vec3& from, const Vec3& to, double margin) const {
  if (!from.allFinite() || !to.allFinite() || !(margin >= 0)) return false;
  const auto crosses = [&](const Triangle& t) {
    if (!segment_is_within(from, to, t, 0)) return false;
    if (segment_is_within(from, from, t, margin) || segment_is_within(to, to, t, margin)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = t[i], &b = t[(i + 1) % 3];
      if (segment_is_within(from, to, {a, b, b}, margin)) return false;
    }
    return true;
  };
  bool found = false;
  double limit = 0;
  structure_->tree.visit([&](const Box& box) { return distance_below(box, from, to); }, limit,
                         [&](std::uint32_t triangle) {
                           if (found || !crosses(triangle_of(mesh(), triangle))) return;
                           found = true;
                           limit = -1;  // nothing more to visit
                         });
  return found;
}

std::vector<std::uint32_t> Oracle::all_within(const Vec3& center, double radius) const {
  std::vector<std::uint32_t> found;
  if (!center.allFinite() || !(radius >= 0)) return found;
  structure_->tree.visit([&](const Box& box) { return distance_below(box, center); }, radius,
                         [&](std::uint32_t triangle) {
                           if (within(triangle, center, radius)) found.push_back(triangle);
                         });
  std::ranges::sort(found);
  return found;
}

}  // namespace touchmark::bench::oracle

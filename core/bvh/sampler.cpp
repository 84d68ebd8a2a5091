#include "core/bvh/sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/search.h"  // IWYU pragma: keep
#include "core/search/linear_scan.h"

namespace touchmark::bvh {
namespace {

/// Accepts a triangle that is nearly nearest.
struct RoughVisitor {
  static constexpr double enough = 0.75;  ///< share of the squared distance

  const FilterFrame& frame;
  const Vec3& center;
  float limit;
  Work work{};
  double squared = std::numeric_limits<double>::infinity();
  Vec3 from_mesh = Vec3::Zero();
  std::uint32_t kept_at = std::numeric_limits<std::uint32_t>::max();

  bool accepts(std::uint32_t at) const noexcept { return at != kept_at; }
  void update(std::uint32_t at, const Offset& found) noexcept {
    if (!(found.squared < squared)) return;
    squared = found.squared;
    from_mesh = found.vector;
    kept_at = at;
    limit = std::min(limit, frame.limit(enough * squared));
  }
};

}  // namespace

DistanceField::Interval Sampler::operator()(const Vec3& position, double max_distance) noexcept {
  constexpr DistanceField::Interval unknown{-1, -1};
  if (work_.total() > budget_) return unknown;
  const FilterFrame& frame = bvh_.frame();
  const Vec3 center = frame.from_frame(position);
  const double reach = max_distance / frame.scale();
  RoughVisitor visitor{frame, center, frame.limit(reach * reach)};
  visit(bvh_, near_, visitor);
  const float unseen = traverse(bvh_, frame.point(center), visitor, remaining(budget_, work_.total()));
  work_ += visitor.work;
  if (unseen == exhausted) return unknown;
  near_ = visitor.kept_at;
  to_mesh_ = -frame.scale() * visitor.from_mesh;
  const double found = std::sqrt(visitor.squared) * frame.scale();
  return {std::min<double>(std::sqrt(unseen), found), std::min(found, max_distance)};
}

double Sampler::distance_to(std::uint32_t near, const Vec3& position) noexcept {
  near_ = near;
  const FilterFrame& frame = bvh_.frame();
  const Vec3 center = frame.from_frame(position);
  RoughVisitor visitor{frame, center, farthest};
  visit(bvh_, near, visitor);
  work_ += visitor.work;
  to_mesh_ = -frame.scale() * visitor.from_mesh;
  return std::sqrt(visitor.squared) * frame.scale();
}

}  // namespace touchmark::bvh

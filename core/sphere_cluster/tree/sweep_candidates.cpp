#include "core/sphere_cluster/tree/sweep_candidates.h"

#include <algorithm>

#include "core/sphere_cluster/tree/traversal.h"

namespace touchmark::spheres {
namespace {

/// Tells what was found of the triangle it was shown.
struct OffsetVisitor {
  const Vec3& center;
  Offset found{};

  static constexpr bool accepts(std::uint32_t) noexcept { return true; }
  void update(std::uint32_t, const Offset& offset) noexcept { found = offset; }
};

/// Returns the place on the path that is nearest to a point, rounded.
Vec3 nearest_place(const Sweep& sweep, const Vec3& point) noexcept {
  const Vec3 path = sweep.to - sweep.from;
  const double squared = path.squaredNorm();
  const double part = squared > 0 ? (point - sweep.from).dot(path) / squared : 0;
  return position_at(sweep, std::clamp(part, 0.0, 1.0));
}

}  // namespace

void SweepCandidates::consider(std::uint32_t at, Work& work) noexcept {
  if (last_plane_keeps_apart(at)) return;
  if (!first_.found()) {
    const Vec3 middle = position_at(first_.sweep(), 0.5);
    consider(at, middle, measured(at, middle, work), work);
  } else if (!plane_across_keeps_apart(at, measured(at, end_, work))) {
    decide(at, work);
  }
}

/// Where the first touch is known, it is to be shown that this one does not touch before. Else the place of
/// the path that is nearest to what was found is often about where the triangle is nearest.
void SweepCandidates::consider(std::uint32_t at, const Vec3& place, const Offset& found,
                               Work& work) noexcept {
  if (plane_across_keeps_apart(at, found)) return;
  const Vec3 next = first_.found() ? end_ : nearest_place(first_.sweep(), place - found.vector);
  if (!plane_across_keeps_apart(at, measured(at, next, work))) decide(at, work);
}

void SweepCandidates::decide(std::uint32_t at, Work& work) noexcept {
  first_.consider(tree_.triangles[at], at, work.exact_decisions);
  if (first_.found() && first_.slot() == at) end_ = position_at(first_.sweep(), first_.limit());
}

bool SweepCandidates::plane_across_keeps_apart(std::uint32_t at, const Offset& offset) noexcept {
  const Vec3 normal = direction_of(offset);
  if (!keeps_apart(at, normal)) return false;
  plane_ = normal;
  has_plane_ = true;
  return true;
}

Offset SweepCandidates::measured(std::uint32_t at, const Vec3& place, Work& work) const noexcept {
  ++work.triangles;
  OffsetVisitor visitor{place};
  simd_ == Simd::portable ? portable::visit(tree_, at, visitor) : avx2::visit(tree_, at, visitor);
  return visitor.found;
}

}  // namespace touchmark::spheres

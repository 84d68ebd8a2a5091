#include "core/point_queries/sweep_candidates.h"

#include <algorithm>

#include "core/bvh/search.h"

namespace touchmark::queries {
namespace {

/// Returns the place on the path that is nearest to a point, rounded.
Vec3 nearest_place(const Sweep& sweep, const Vec3& point) noexcept {
  const Vec3 path = sweep.to - sweep.from;
  const double squared = path.squaredNorm();
  const double part = squared > 0 ? (point - sweep.from).dot(path) / squared : 0;
  return position_at(sweep, std::clamp(part, 0.0, 1.0));
}

}  // namespace

void SweepCandidates::consider_waiting(LimitedWork& work) noexcept {
  unsigned apart = 0;
  if (waiting_count_ >= bvh::min_at_once) {
    bvh::EightPlanes planes;
    const bvh::SweptBall ball(first_.sweep(), first_.limit(), bvh_.frame().scale());
    apart = bvh::with_isa(bvh_.simd(), [&](auto isa) {
      return isa.kept_apart(triangles_.data(), waiting_.data(), waiting_count_, ball, planes);
    });
  }
  for (std::uint32_t k = 0; k < waiting_count_; ++k)
    if ((apart >> k & 1) == 0) consider(waiting_[k], work);
  waiting_count_ = 0;
}

void SweepCandidates::look_at(std::uint32_t at, LimitedWork& work) noexcept {
  if (!is_prepared_) prepare(work);
  if (!is_apart_by_known(at) && !is_apart_elsewhere(at, end())) decide(at, work);
  settle(at);
}

/// A first touch that is known is what this one must not touch before. Else the place of the path that is
/// nearest to what was found is often about where the triangle is nearest.
void SweepCandidates::consider(std::uint32_t at, const Vec3& place, const Offset& found,
                               LimitedWork& work) noexcept {
  if (shown_ >= many && !is_prepared_) prepare(work);
  if (!is_apart_across(at, direction_of(found)) && !(is_prepared_ && is_apart_by_known(at))) {
    const Vec3 next = first_.found() ? end() : nearest_place(first_.sweep(), place - found.vector);
    if (!is_apart_elsewhere(at, next)) decide(at, work);
  }
  settle(at);
}

/// A ball that slides along a face or an edge keeps off that plane, and all that is behind it is apart. If it
/// leaves the plane to the other side, that triangle is the first it meets.
void SweepCandidates::prepare(LimitedWork& work) noexcept {
  settled_.fill(0);
  is_prepared_ = true;
  if (near_ >= triangles_.size()) return;
  face_ = face_towards_start(near_);
  across_ = direction_of(measured(near_, first_.sweep().from));
  decide(near_, work);
  settle(near_);
}

Vec3 SweepCandidates::face_towards_start(std::uint32_t at) const noexcept {
  const PreparedTriangle& triangle = triangles_[at];
  const bool is_behind = triangle.normal.dot(first_.sweep().from - triangle.corner[0]) < 0;
  return is_behind ? Vec3(-triangle.normal) : triangle.normal;
}

/// What slides along a face is nearer to it than the direction of an offset is certain by.
bool SweepCandidates::is_apart_by_known(std::uint32_t at) noexcept {
  return is_apart_across(at, face_) || is_apart_across(at, across_) ||
         is_apart_across(at, face_towards_start(at));
}

bool SweepCandidates::is_apart_elsewhere(std::uint32_t at, const Vec3& place) noexcept {
  if (elsewhere_.waits()) return false;
  const bool is_apart = is_apart_across(at, direction_of(measured(at, place)));
  is_apart ? elsewhere_.paid() : elsewhere_.failed();
  return is_apart;
}

/// Remembers the plane where it does.
bool SweepCandidates::is_apart_across(std::uint32_t at, const Vec3& normal) noexcept {
  if (!keeps_apart(at, normal)) return false;
  plane_ = normal;
  return true;
}

Offset SweepCandidates::measured(std::uint32_t at, const Vec3& place) const noexcept {
  return bvh::offset_at(bvh_, at, place);
}

}  // namespace touchmark::queries

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/distance_error.h"
#include "core/geometry/widest_offset.h"
#include "core/scene/near_surface.h"
#include "core/search/plane_filter/listed_plane.h"
#include "core/simd/dispatch.h"  // IWYU pragma: keep
#include "core/simd/lanes.h"
#include "core/simd/wide.h"

namespace touchmark {
namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();

}  // namespace
}  // namespace touchmark

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace touchmark {

/// within, eight at a time: the same bits.
SurfaceList::Bits SurfaceList::within_by_eights(const Move& move, float farthest) const noexcept {
  Bits near{};
  for (std::uint32_t i = 0; i < count_; i += 8) {
    const auto at = [i](const std::array<float, capacity>& of) -> avx2::Wide {
      return _mm256_loadu_ps(&of[i]);
    };
    const avx2::Wide bound =
        at(plane_.bound) + move.x * at(plane_.x) + move.y * at(plane_.y) + move.z * at(plane_.z);
    near[i / 64] |= std::uint64_t{avx2::to_bits(bound <= farthest)} << (i % 64);
  }
  return near;
}

}  // namespace touchmark
TOUCHMARK_END_TARGET
#endif

namespace touchmark {

void SurfaceList::start(const Vec3& center, double covered) noexcept {
  center_ = center;
  covered_ = covered * (1 - 0x1p-40);
  error_ = plane_error_ = 0;
  count_ = 0;
  bodies_count_ = 0;
}

bool SurfaceList::add(std::uint32_t body, const SeenBody& seen, const TriangleMesh& mesh,
                      const ListedTriangles& listed) noexcept {
  const double covered = seen.in_scene(listed.covered, 0).lower;
  if (listed.count == 0) return leave_out(covered), true;
  if (bodies_count_ == max_bodies || count_ + listed.count > capacity) return false;
  // No corner is farther from the place, or from where the list covers, than this.
  const double farthest = 4 * (largest_difference(mesh.bounds(), seen.center()) + covered_);
  if (!(farthest > 0x1p-60 && farthest < 0x1p60)) return false;
  // The kernel, and from the frame to the scene: of a point that may be that much farther from the origin.
  const double error = distance_error(farthest) + 2 * seen.slack(farthest) + 2 * seen.residue();
  if (!(error < 0x1p-20 * farthest)) return false;
  error_ = std::max(error_, error);
  plane_error_ = std::max(plane_error_, 4 * listed.error + error);
  const auto slot = static_cast<std::uint8_t>(bodies_count_);
  bodies_[bodies_count_++] = {body, &mesh, seen.center()};
  for (std::uint32_t i = 0; i < listed.count; ++i, ++count_) {
    body_[count_] = slot;
    triangle_[count_] = listed.triangle[i];
    plane_.bound[count_] = listed.bound[i];
    plane_.x[count_] = listed.x[i];
    plane_.y[count_] = listed.y[i];
    plane_.z[count_] = listed.z[i];
    turn(count_, seen.pose());
  }
  for (std::uint32_t i = count_; i % 8 != 0; ++i) {
    plane_.bound[i] = float_infinity;
    plane_.x[i] = plane_.y[i] = plane_.z[i] = 0;
  }
  leave_out(covered);
  return true;
}

void SurfaceList::leave_out(double lower) noexcept { covered_ = lower < covered_ ? lower : covered_; }

SurfaceList::Move SurfaceList::move_to(const Vec3& point) const noexcept {
  const Vec3 way = point - center_;
  return {way, way.norm() * (1 + 0x1p-40), static_cast<float>(way.x()), static_cast<float>(way.y()),
          static_cast<float>(way.z())};
}

bool SurfaceList::covers(double limit, const Move& move) const noexcept {
  return limit + 4 * error_ + move.length < covered_;
}

/// Planes are off by less than 2^-20 of what they say and of the way, and by plane_error_.
float SurfaceList::padded(double limit, const Move& move) const noexcept {
  const double padded = (limit + 4 * error_ + plane_error_ + 0x1p-18 * move.length) * (1 + 0x1p-18);
  return static_cast<float>(std::min(padded, double{std::numeric_limits<float>::max()}));
}

SurfaceList::Bits SurfaceList::within(const Move& move, double limit) const noexcept {
  const float farthest = padded(limit, move);
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) return within_by_eights(move, farthest);
#endif
  const Lanes x = broadcast(move.x), y = broadcast(move.y), z = broadcast(move.z);
  Bits near{};
  for (std::uint32_t i = 0; i < count_; i += 4) {
    const Lanes bound =
        load(&plane_.bound[i]) + x * load(&plane_.x[i]) + y * load(&plane_.y[i]) + z * load(&plane_.z[i]);
    near[i / 64] |= std::uint64_t{at_most(bound, farthest)} << (i % 64);
  }
  return near;
}

bool SurfaceList::may_be_within(std::uint32_t place, const Move& move, double limit) const noexcept {
  return plane_.bound[place] + move.x * plane_.x[place] + move.y * plane_.y[place] +
             move.z * plane_.z[place] <=
         padded(limit, move);
}

double SurfaceList::clearance(const Move& move) const noexcept {
  const Lanes x = broadcast(move.x), y = broadcast(move.y), z = broadcast(move.z);
  Lanes least = broadcast(float_infinity);
  for (std::uint32_t i = 0; i < count_; i += 4)
    least = simd::min(least, load(&plane_.bound[i]) + x * load(&plane_.x[i]) + y * load(&plane_.y[i]) +
                                 z * load(&plane_.z[i]));
  const double listed =
      double{simd::reduce_min(least)} * (1 - 0x1p-18) - 0x1p-18 * move.length - plane_error_;
  return std::min(listed, covered_ - move.length) - 4 * error_;
}

const Vec3& SurfaceList::InFrames::of(std::uint8_t slot, const Body& body) noexcept {
  const std::uint32_t bit = std::uint32_t{1} << slot;
  if ((known_ & bit) == 0) {
    seen_[slot] = in_frame(pose(body), point_);
    known_ |= bit;
  }
  return seen_[slot];
}

double SurfaceList::measure(std::uint32_t place, double limit, InFrames& point) noexcept {
  const Body& body = body_of(place);
  const PreparedTriangle& triangle = *triangle_[place];
  const Offset found = widest_offset_from(triangle, point.of(body_[place], body));
  const double distance = std::sqrt(found.squared);
  if (distance > limit + 4 * error_ &&
      set_plane_across(plane_, place, triangle, body.center, found, error_, 1))
    turn(place, point.pose(body));
  return distance;
}

/// Takes a plane's normal from the body's frame to the scene's.
void SurfaceList::turn(std::uint32_t place, const Pose& pose) noexcept {
  const Vec3 away =
      pose.rotation * Vec3(double{plane_.x[place]}, double{plane_.y[place]}, double{plane_.z[place]});
  plane_.x[place] = static_cast<float>(away.x());
  plane_.y[place] = static_cast<float>(away.y());
  plane_.z[place] = static_cast<float>(away.z());
}

}  // namespace touchmark

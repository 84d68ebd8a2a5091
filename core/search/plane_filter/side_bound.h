/// Bounds the distance to a triangle from above where its side is nearest: corners say little there, and
/// nothing where they are sharp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"

namespace touchmark {

/// In plane_errors: how far within the other two sides a foot must be, and the pad of the distance to it. See
/// docs/exactness.md, E11.
inline constexpr float foot_margin = 4, foot_pad = 4;

/// Returns at least the distance to the triangle, in the frame, where the foot of the point on one of the
/// sides is surely within the two others; the values are those of its planes. Else infinity. A side that was
/// too short for a plane has zeros for one, and no foot.
inline float side_upper_bound(const TrianglePlanes& planes, Lanes values, const FilterPoint& p) noexcept {
  const auto next = [](Lanes of) { return __builtin_shufflevector(of, of, 0, 2, 3, 1); };
  const auto before = [](Lanes of) { return __builtin_shufflevector(of, of, 0, 3, 1, 2); };
  const Lanes cosine = planes.x * next(planes.x) + planes.y * next(planes.y) + planes.z * next(planes.z);
  const Lanes beyond_next = next(values) - values * cosine,
              beyond_before = before(values) - values * before(cosine);
  const Lanes length = planes.x * planes.x + planes.y * planes.y + planes.z * planes.z;
  const LaneBits has_foot =
      (simd::max(beyond_next, beyond_before) <= -foot_margin * p.plane_error) & (length > 0.5F);
  const Lanes across = has_foot ? values * values : broadcast(std::numeric_limits<float>::infinity());
  const float least = std::min(across[1], std::min(across[2], across[3]));
  return std::sqrt(values[0] * values[0] + least) + foot_pad * p.plane_error;
}

}  // namespace touchmark

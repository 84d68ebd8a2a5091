#include "core/grid_group/direct/group_filter.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/grid_group/direct/wide_rows.h"
#include "core/simd/dispatch.h"
#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <immintrin.h>
#endif

namespace touchmark::grid {
namespace {

constexpr float far = std::numeric_limits<float>::max();

/// What a pass leaves, a lane each.
struct Leaders {
  Lanes least = {far, far, far, far};
  Lanes height = {far, far, far, far};
  LaneBits member = {0, 0, 0, 0};  ///< number of the first member of that height
};

void conclude(const Leaders& leaders, const std::uint32_t* slots, GroupBounds& bounds) noexcept {
  bounds.least = simd::reduce_min(leaders.least);
  bounds.height = simd::reduce_min(leaders.height);
  bounds.over_face = bounds.height < far;
  if (!bounds.over_face) {
    std::size_t i = 0;
    while (bounds.squared[i / 4][i % 4] > bounds.least) ++i;
    bounds.guess = slots[i];
    return;
  }
  int first = std::numeric_limits<int>::max();
  for (unsigned lanes = at_most(leaders.height, bounds.height); lanes != 0; lanes &= lanes - 1)
    first = std::min(first, leaders.member[std::countr_zero(lanes)]);
  bounds.guess = slots[first];
}

#if TOUCHMARK_HAS_AVX2

/// Eight members at a time: two of them share a register, row by row, until the transposition.
[[gnu::target("avx2")]] Leaders pass_avx2(const TrianglePlanes* planes, const std::uint32_t* slots,
                                          std::size_t count, const FilterPoint& point,
                                          GroupBounds& bounds) noexcept {
  const __m256 x = _mm256_set1_ps(point.x), y = _mm256_set1_ps(point.y), z = _mm256_set1_ps(point.z);
  const __m256 plane_error = _mm256_set1_ps(point.plane_error),
               minus_error = _mm256_set1_ps(-point.plane_error);
  const __m256 sign = _mm256_set1_ps(-0.0f), zero = _mm256_setzero_ps();
  __m256 least = _mm256_set1_ps(far), height = least;
  __m256i member = _mm256_setzero_si256(), now = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  for (std::size_t at = 0; at < count; at += 8) {
    __m256 values[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const TrianglePlanes& low = planes[slots[at + k]];
      const TrianglePlanes& high = planes[slots[at + k + 4]];
      const __m256 nx = _mm256_set_m128(high.x, low.x), ny = _mm256_set_m128(high.y, low.y);
      const __m256 nz = _mm256_set_m128(high.z, low.z), offset = _mm256_set_m128(high.offset, low.offset);
      const __m256 across = _mm256_add_ps(_mm256_mul_ps(nx, x), _mm256_mul_ps(ny, y));
      values[k] = _mm256_add_ps(_mm256_add_ps(across, _mm256_mul_ps(nz, z)), offset);
    }
    const auto [signed_face, side1, side2, side3] = avx2::columns(values[0], values[1], values[2], values[3]);
    const __m256 face = _mm256_max_ps(signed_face, _mm256_xor_ps(signed_face, sign));
    const __m256 side_excess = _mm256_max_ps(side1, _mm256_max_ps(side2, side3));

    const __m256 h = _mm256_max_ps(_mm256_sub_ps(face, plane_error), zero);
    const __m256 e = _mm256_max_ps(_mm256_sub_ps(side_excess, plane_error), zero);
    const __m256 squared = _mm256_add_ps(_mm256_mul_ps(h, h), _mm256_mul_ps(e, e));
    bounds.squared[at / 4] = _mm256_castps256_ps128(squared);
    bounds.squared[at / 4 + 1] = _mm256_extractf128_ps(squared, 1);
    least = _mm256_min_ps(squared, least);
    const __m256 lower = _mm256_and_ps(_mm256_cmp_ps(side_excess, minus_error, _CMP_LT_OQ),
                                       _mm256_cmp_ps(face, height, _CMP_LT_OQ));
    height = _mm256_blendv_ps(height, face, lower);
    member = _mm256_blendv_epi8(member, now, _mm256_castps_si256(lower));
    now = _mm256_add_epi32(now, _mm256_set1_epi32(8));
  }
  // Fold the upper lanes into the lower; of equal heights the first member's counts.
  Leaders leaders;
  leaders.least = _mm_min_ps(_mm256_castps256_ps128(least), _mm256_extractf128_ps(least, 1));
  const Lanes low = _mm256_castps256_ps128(height), high = _mm256_extractf128_ps(height, 1);
  const auto member_low = reinterpret_cast<LaneBits>(_mm256_castsi256_si128(member));
  const auto member_high = reinterpret_cast<LaneBits>(_mm256_extracti128_si256(member, 1));
  const LaneBits use_high = (high < low) | ((high == low) & (member_high < member_low));
  leaders.height = use_high ? high : low;
  leaders.member = use_high ? member_high : member_low;
  return leaders;
}

#endif

Leaders pass(const TrianglePlanes* planes, const std::uint32_t* slots, std::size_t count,
             const FilterPoint& point, GroupBounds& bounds) noexcept {
  const PointLanes p(point);
  Leaders leaders;
  LaneBits now = {0, 1, 2, 3};
  for (std::size_t at = 0; at < count; at += 4) {
    const PlaneLanes values = plane_lanes(planes[slots[at]], planes[slots[at + 1]], planes[slots[at + 2]],
                                          planes[slots[at + 3]], p);
    const Lanes squared = lower_bounds(values, p);
    bounds.squared[at / 4] = squared;
    leaders.least = squared < leaders.least ? squared : leaders.least;
    const LaneBits lower = (values.side_excess < -p.plane_error) & (values.height < leaders.height);
    leaders.height = lower ? values.height : leaders.height;
    leaders.member = lower ? now : leaders.member;
    now += 4;
  }
  return leaders;
}

}  // namespace

GroupBounds filter_group(const TrianglePlanes* planes, const std::uint32_t* slots, std::size_t count,
                         const FilterPoint& point) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) {
    GroupBounds bounds;
    conclude(pass_avx2(planes, slots, count, point, bounds), slots, bounds);
    return bounds;
  }
#endif
  return filter_group_portably(planes, slots, count, point);
}

GroupBounds filter_group_portably(const TrianglePlanes* planes, const std::uint32_t* slots, std::size_t count,
                                  const FilterPoint& point) noexcept {
  GroupBounds bounds;
  conclude(pass(planes, slots, count, point, bounds), slots, bounds);
  return bounds;
}

}  // namespace touchmark::grid

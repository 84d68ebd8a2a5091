/// The search of the hierarchy, for the portable instruction set and AVX2, chosen at run time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/point_triangle_avx2.h"
#include "core/search/plane_filter.h"
#include "core/search/tracing.h"
#include "core/simd/lanes.h"
#include "core/simd/prefetch.h"
#include "core/simd/target.h"
#include "core/simd/wide.h"
#include "core/sphere_cluster/tree/binned_sah.h"
#include "core/sphere_cluster/tree/lazy_builder.h"
#include "core/sphere_cluster/tree/leaf_cache.h"
#include "core/sphere_cluster/tree/near_triangles.h"
#include "core/sphere_cluster/tree/neighborhood.h"
#include "core/sphere_cluster/tree/node.h"
#include "core/sphere_cluster/tree/swept_ball.h"

namespace touchmark::spheres {

struct StackEntry {
  float bound;
  TreeRef ref;
};
/// Seven siblings wait at each level.
inline constexpr std::size_t max_stack = TriangleSplitter::deepest * tree_width;

/// The path of a ball's centre, in the tree's frame.
struct Path {
  FilterPoint from;
  float direction_x, direction_y, direction_z;  ///< unit
  float reach;                                  ///< what the ball touches, and the error
  float error;                                  ///< more than all rounding on the path
};

/// Returned in place of a bound by a search whose work budget was exhausted.
inline constexpr float exhausted = -1;

/// A bound above all of what is there.
inline constexpr float farthest = std::numeric_limits<float>::max();

/// |v|^2 - (n.v)^2 may come out too large by 16 roundings of |v|^2: three for v and its square, two sums, the
/// same for n.v, twice, and n's own length.
inline constexpr float difference_pad = 1 - 16 * 0x1p-24F;

/// A bound above this part of the limit may be that of a triangle as far as the nearest.
inline constexpr float nearly = 1 - 0x1p-5F;

/// Rounding of a corner's bound, of which no term is negative: the cosine is off by 10 u at most, so its
/// square by 20 u; what is past the tip by less than 8 plane errors: docs/exactness.md, E10.
inline constexpr float sine_error = 0x1p-18F, tip_margin = 8, corner_factor = 1 - 32 * 0x1p-24F;

/// Notes eight children, of a node or cached, from `first` on; those of `near` are entered.
template <class Children>
void note_children(bool boxes, const Children& node, std::size_t first, unsigned near) {
  if (visits == nullptr) return;
  for (std::size_t k = 0; k < tree_width; ++k) {
    const std::size_t i = first + k;
    if (!(node.half[i] >= 0)) continue;  // nothing is there
    const Vec3 center(double{node.x[i]}, double{node.y[i]}, double{node.z[i]});
    const bool entered = (near >> k & 1) != 0;
    if (boxes) {
      const Vec3 half(double{node.half[i]}, double{node.radius[i]}, double{node.normal_x[i]});
      visits->note_in_frame(center - half, center + half, entered);
    } else {
      const FilterFrame& frame = *visits->frame;
      visits->cylinders.push_back(
          {frame.from_frame(center),
           {double{node.normal_x[i]}, double{node.normal_y[i]}, double{node.normal_z[i]}},
           double{node.radius[i]} * frame.unit(),
           double{node.half[i]} * frame.unit(),
           entered});
    }
  }
}

namespace portable {

inline Offset kernel(const PreparedTriangle& triangle, const Vec3& point) noexcept {
  return offset_from(triangle, point);
}

inline constexpr std::size_t lanes = 4;
using Wide = Lanes;
using WideBits = LaneBits;

inline Wide square_root(Wide x) noexcept { return simd::sqrt(x); }
using touchmark::to_bits;
/// Writes those of eight words whose bits are set, one after the other. Eight may be written.
template <class Word>
inline void compress(Word* to, const Word* from, unsigned chosen) noexcept {
  for (; chosen != 0; chosen &= chosen - 1) *to++ = from[std::countr_zero(chosen)];
}
#include "core/sphere_cluster/tree/traversal.inl"

}  // namespace portable

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace avx2 {

inline Offset kernel(const PreparedTriangle& triangle, const Vec3& point) noexcept {
  return touchmark::avx2::offset_from(triangle, point);
}

inline constexpr std::size_t lanes = 8;
using touchmark::avx2::Wide, touchmark::avx2::WideBits, touchmark::avx2::square_root,
    touchmark::avx2::to_bits;
template <class Word>
inline void compress(Word* to, const Word* from, unsigned chosen) noexcept {
  static_assert(sizeof(Word) == 4);
  const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                      _mm256_permutevar8x32_epi32(words, touchmark::avx2::order_of_kept(chosen)));
}
#include "core/sphere_cluster/tree/traversal.inl"

}  // namespace avx2
TOUCHMARK_END_TARGET
#else
namespace avx2 = portable;
#endif

}  // namespace touchmark::spheres

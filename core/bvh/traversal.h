/// The search of the hierarchy, for the portable instruction set and AVX2, chosen at run time.
///
/// What a search is for is a visitor. It has
///   center      where the search is from
///   limit       squared, in the tree's frame: only triangles within it need to be shown; may fall meanwhile
///   work        counts
///   accepts(slot)   true if it wants to see the triangle in that slot
///   update(slot, offset)   takes the offset to a triangle that it wanted
/// and may have
///   update_within(slot), enough   the first triangle surely no farther than `enough` ends the search
///   takes_as_far(slot)   true if that triangle is known to be as far as the nearest
///   left   takes a bound, squared, of what `traverse` had not shown when the budget was exhausted
/// A sweep's visitor has until(), the length of the path that is left, work and consider(slot).
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

#include "core/bvh/build/binned_sah.h"
#include "core/bvh/build/lazy_builder.h"
#include "core/bvh/kept_nearest.h"
#include "core/bvh/leaf_list.h"
#include "core/bvh/limited_point.h"
#include "core/bvh/node.h"
#include "core/bvh/plane_list.h"
#include "core/bvh/swept_ball.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/point_triangle_avx2.h"
#include "core/search/plane_filter/listed_plane.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/search/tracing.h"
#include "core/simd/dispatch.h"
#include "core/simd/lanes.h"
#include "core/simd/prefetch.h"
#include "core/simd/target.h"
#include "core/simd/wide.h"

namespace touchmark::bvh {

struct StackEntry {
  float bound;
  ChildRef ref;
};
/// Seven siblings wait at each level.
inline constexpr std::size_t max_stack = TriangleSplitter::deepest * width;

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

/// Notes eight children, of a node or listed, from `first` on; those of `near` are entered.
template <class Volumes>
void note_children(bool boxes, const Volumes& node, std::size_t first, unsigned near) {
  if (visits == nullptr) return;
  for (std::size_t k = 0; k < width; ++k) {
    const std::size_t i = first + k;
    if (node.is_empty(i)) continue;
    const Vec3 center(double{node.x()[i]}, double{node.y()[i]}, double{node.z()[i]});
    const bool entered = (near >> k & 1) != 0;
    if (boxes) {
      const Vec3 half(double{node.half_x()[i]}, double{node.half_y()[i]}, double{node.half_z()[i]});
      visits->note_in_frame(center - half, center + half, entered);
    } else {
      const FilterFrame& frame = *visits->frame;
      visits->cylinders.push_back(
          {frame.from_frame(center),
           {double{node.normal_x()[i]}, double{node.normal_y()[i]}, double{node.normal_z()[i]}},
           double{node.radius()[i]} * frame.unit(),
           double{node.half_height()[i]} * frame.unit(),
           entered});
    }
  }
}

/// Four lanes, of instructions that every processor has.
struct Portable {
  static constexpr std::size_t lanes = 4;
  using Wide = Lanes;
  using WideBits = LaneBits;

  static Offset kernel(const PreparedTriangle& triangle, const Vec3& point) noexcept {
    return offset_from(triangle, point);
  }
  static Wide square_root(Wide x) noexcept { return simd::sqrt(x); }
  static unsigned to_bits(WideBits bits) noexcept { return touchmark::to_bits(bits); }
  /// Writes those of eight words whose bits are set, one after the other. Eight may be written.
  template <class Word>
  static void compress(Word* to, const Word* from, unsigned chosen) noexcept {
    for (; chosen != 0; chosen &= chosen - 1) *to++ = from[std::countr_zero(chosen)];
  }
#include "core/bvh/traversal.inl"
};

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
/// Eight lanes.
struct Avx2 {
  static constexpr std::size_t lanes = 8;
  using Wide = touchmark::avx2::Wide;
  using WideBits = touchmark::avx2::WideBits;

  static Offset kernel(const PreparedTriangle& triangle, const Vec3& point) noexcept {
    return touchmark::avx2::offset_from(triangle, point);
  }
  static Wide square_root(Wide x) noexcept { return touchmark::avx2::square_root(x); }
  static unsigned to_bits(WideBits bits) noexcept { return touchmark::avx2::to_bits(bits); }
  template <class Word>
  static void compress(Word* to, const Word* from, unsigned chosen) noexcept {
    static_assert(sizeof(Word) == 4);
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_permutevar8x32_epi32(words, touchmark::avx2::order_of_kept(chosen)));
  }
#include "core/bvh/traversal.inl"
};
TOUCHMARK_END_TARGET
#else
using Avx2 = Portable;
#endif

/// Calls f with the kernels of an instruction set, and returns what f does.
template <class F>
[[gnu::always_inline]] inline auto with_isa(Simd simd, const F& f) noexcept {
  return simd == Simd::portable ? f(Portable{}) : f(Avx2{});
}

}  // namespace touchmark::bvh

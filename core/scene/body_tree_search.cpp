// The search of the tree of bodies' boxes, and what single precision costs it.
#include <array>
#include <bit>  // IWYU pragma: keep
#include <cmath>
#include <cstring>
#include <span>

#include "core/scene/body_tree.h"
#include "core/simd/lanes.h"
#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <immintrin.h>
#endif

namespace touchmark {
namespace body_tree {
namespace {

/// A region in the boxes' frame, and what rounding it may cost. In single precision, as the boxes are.
struct Region {
  std::array<float, 3> min, max;
  double pad;

  Region(const Aabb& region, const Vec3& origin) noexcept {
    const Vec3 low = region.min - origin, high = region.max - origin;
    // The differences are off by a double's rounding, and as floats by one of theirs, which is the greater.
    pad = 0x1p-22 * (low.cwiseAbs().sum() + high.cwiseAbs().sum()) + 0x1p-120;
    for (int k = 0; k < 3; ++k) {
      min[static_cast<std::size_t>(k)] = static_cast<float>(low[k]);
      max[static_cast<std::size_t>(k)] = static_cast<float>(high[k]);
    }
  }
  /// Returns what a squared distance of a box within the limit cannot exceed: each excess is off by a
  /// rounding and its square, relatively, by six.
  float squared_limit(double limit) const noexcept {
    const double padded = (limit + pad) * (1 + 0x1p-20);
    const double squared = padded * padded + 0x1p-120;
    if (!(limit >= 0)) return -1;
    return squared < 0x1p127 ? static_cast<float>(squared * (1 + 0x1p-23))
                             : std::numeric_limits<float>::infinity();
  }
};

namespace portable {

inline constexpr std::uint32_t lanes = 4;
using Wide = Lanes;
#include "core/scene/body_tree_search.inl"

}  // namespace portable

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace avx2 {

inline constexpr std::uint32_t lanes = 8;
using Wide [[gnu::vector_size(32)]] = float;
using WideBits [[gnu::vector_size(32)]] = int;

inline unsigned to_bits(WideBits mask) noexcept {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
}
#include "core/scene/body_tree_search.inl"

}  // namespace avx2
TOUCHMARK_END_TARGET
#else
namespace avx2 = portable;
#endif

}  // namespace
}  // namespace body_tree

std::uint64_t BodyTree::walk(const Aabb& region, double limit, const body_tree::Visit& visit) const noexcept {
  if (root_ == none) return 0;
  const body_tree::Region seen(region, *origin_);
  return is_wide_ ? body_tree::avx2::walk(nodes_, root_, seen, limit, visit)
                  : body_tree::portable::walk(nodes_, root_, seen, limit, visit);
}

}  // namespace touchmark

#include "core/grid_group/direct/near_balls.h"

#include <algorithm>  // IWYU pragma: keep
#include <cstring>

#include "core/geometry/float_rounding.h"
#include "core/grid_group/direct/wide_rows.h"
#include "core/simd/dispatch.h"

namespace touchmark::grid {

FloatBounds::FloatBounds(const Aabb& box) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    min[k] = rounded_up(box.min[static_cast<int>(k)]);
    max[k] = rounded_down(box.max[static_cast<int>(k)]);
  }
}

namespace {

/// Which of eight children have boxes that are not apart from another, and which of these lie in it.
struct ChildrenIn {
  unsigned reaching, within;
};

/// Returns what is left of eight, by the bits of those apart from the other box and of those that reach
/// beyond it.
ChildrenIn left_of_eight(unsigned apart, unsigned beyond) noexcept {
  return {~apart & 0xffU, ~(apart | beyond) & 0xffU};
}

}  // namespace

namespace portable {
namespace {
constexpr Slots first_slots = {0, 1, 2, 3};
#include "core/grid_group/direct/near_balls.inl"
}  // namespace
}  // namespace portable

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace avx2 {
namespace {
constexpr Slots first_slots = {0, 1, 2, 3, 4, 5, 6, 7};
#include "core/grid_group/direct/near_balls.inl"
}  // namespace
}  // namespace avx2
TOUCHMARK_END_TARGET
#endif

bool NearBalls::gather(const TriangleStore& store, const BoxTree& tree, const FloatBounds& box,
                       const Most& most, std::uint64_t& boxes_seen) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) return avx2::gather(*this, store, tree, box, most, boxes_seen);
#endif
  return portable::gather(*this, store, tree, box, most, boxes_seen);
}

std::size_t open_by_balls(const NearBalls& near, const std::array<BallLimit, 6>& corners,
                          const TriangleBall& own, OpenSlots& open) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) return avx2::open_by_balls(near, corners, own, open);
#endif
  return portable::open_by_balls(near, corners, own, open);
}

}  // namespace touchmark::grid

// The search of the tree of bodies' boxes, and what single precision costs it.
#include <array>
#include <bit>  // IWYU pragma: keep
#include <cmath>
#include <cstring>
#include <span>

#include "core/scene/body_tree/body_tree.h"
#include "core/simd/lanes.h"
#include "core/simd/target.h"
#include "core/simd/wide.h"

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
  /// Equals that of a box that is the point.
  Region(const Vec3& point, const Vec3& origin) noexcept {
    const Vec3 way = point - origin;
    pad = 0x1p-21 * way.cwiseAbs().sum() + 0x1p-120;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      min[i] = max[i] = static_cast<float>(way[k]);
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
#include "core/scene/body_tree/body_tree_search.inl"

}  // namespace portable

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace avx2 {

inline constexpr std::uint32_t lanes = 8;
using touchmark::avx2::Wide, touchmark::avx2::to_bits;
#include "core/scene/body_tree/body_tree_search.inl"

}  // namespace avx2
TOUCHMARK_END_TARGET
#else
namespace avx2 = portable;
#endif

std::uint64_t walk(bool is_wide, std::span<const Node> nodes, Ref root, const Region& region, double limit,
                   const Visit& visit) noexcept {
  return is_wide ? avx2::walk(nodes, root, region, limit, visit)
                 : portable::walk(nodes, root, region, limit, visit);
}

}  // namespace
}  // namespace body_tree

std::uint64_t BodyTree::walk(const Aabb& region, double limit, const body_tree::Visit& visit) const noexcept {
  if (root_ == none) return 0;
  return body_tree::walk(is_wide_, nodes_, root_, body_tree::Region(region, *origin_), limit, visit);
}

std::uint64_t BodyTree::walk(const Vec3& point, double limit, const body_tree::Visit& visit) const noexcept {
  if (root_ == none) return 0;
  return body_tree::walk(is_wide_, nodes_, root_, body_tree::Region(point, *origin_), limit, visit);
}

}  // namespace touchmark

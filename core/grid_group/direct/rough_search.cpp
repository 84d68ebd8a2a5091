#include "core/grid_group/direct/rough_search.h"

#include <array>  // IWYU pragma: keep
#include <cstring>

#include "core/grid_group/direct/wide_rows.h"  // IWYU pragma: keep
#include "core/simd/dispatch.h"

namespace touchmark::grid {

namespace portable {
namespace {
#include "core/grid_group/direct/rough_search.inl"
}  // namespace
}  // namespace portable

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace avx2 {
namespace {
#include "core/grid_group/direct/rough_search.inl"
}  // namespace
}  // namespace avx2
TOUCHMARK_END_TARGET
#endif

bool RoughSearch::consider_tree(const BoxTree& tree, std::uint64_t budget) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (has_avx2) return avx2::descend(*this, tree, budget);
#endif
  return portable::descend(*this, tree, budget);
}

}  // namespace touchmark::grid

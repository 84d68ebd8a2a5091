/// Searches of a hierarchy with the instructions that it was made for. Always inline: what they call is a
/// function for each instruction set, and no more call is wanted before it.
#pragma once

#include <cstdint>

#include "core/bvh/traversal.h"
#include "core/bvh/wide_bvh.h"

namespace touchmark::bvh {

/// Shows the visitor the triangle in a slot, if it accepts that one.
template <class Visitor>
[[gnu::always_inline]] inline void visit(const WideBvh& bvh, std::uint32_t slot, Visitor& visitor) noexcept {
  ++visitor.work.triangles;
  with_isa(bvh.simd(), [&](auto isa) { isa.visit(bvh.parts(), slot, visitor); });
}

/// Returns the offset of a point from the triangle in a slot. Counts nothing.
inline Offset offset_at(const WideBvh& bvh, std::uint32_t slot, const Vec3& point) noexcept {
  return with_isa(bvh.simd(), [&](auto isa) { return isa.offset_at(bvh.parts(), slot, point); });
}

/// See Portable::traverse (traversal.inl).
template <class Visitor>
[[gnu::always_inline]] inline float traverse(const WideBvh& bvh, const FilterPoint& point, Visitor& visitor,
                                             std::uint64_t budget) noexcept {
  return with_isa(bvh.simd(), [&](auto isa) { return isa.traverse(bvh.parts(), point, budget, visitor); });
}

/// Lists what is within the limit of the point, squared. Returns false where there is too much of it, or
/// where `work` comes to more than the budget.
template <class List>
bool list_near(const WideBvh& bvh, const FilterPoint& point, float limit, std::uint64_t budget, List& list,
               Work& work) noexcept {
  return with_isa(bvh.simd(),
                  [&](auto isa) { return isa.list_near(bvh.parts(), point, limit, budget, list, work); });
}

}  // namespace touchmark::bvh

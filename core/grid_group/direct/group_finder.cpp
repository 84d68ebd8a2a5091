#include "core/grid_group/direct/group_finder.h"

#include <algorithm>
#include <span>

#include "core/bvh/traversal.h"
#include "core/search/linear_scan.h"

namespace touchmark::grid {
namespace {

/// Beyond the sides by this part of the inradius: more keeps a sliding probe longer with one group, and makes
/// the groups larger.
constexpr double growth_of_sides = 0.3;
/// Over and under the triangle by this part of its size at first, and by less where the groups would be too
/// large.
constexpr double first_height = 1.0, min_height = 0.2, shrinking = 0.6;

// In a ball about the incenter the grown triangle is within 1.3 radii, its size below 1.65, so the highest
// prism within 2.1; and no point of that is farther than 2.9 from a witness on the triangle.
static_assert(growth_of_sides <= 0.3 && first_height <= 1 && GroupFinder::reach_in_radii >= 2.1 + 2.9);

}  // namespace

/// Tries lower and lower prisms, from one step above the last one's on, for neighbours are alike.
FoundGroup GroupFinder::find(std::uint32_t slot) noexcept {
  const FilterFrame& frame = bvh_.frame();
  const FaceFrame face_frame(bvh_.parts().triangles[slot], frame);
  // A margin that single precision does not see would cover no point.
  const bool visible =
      growth_of_sides * face_frame.inradius > static_cast<double>(frame.plane_error(face_frame.incenter));
  if (face_frame.normal.isZero(0) || !visible) return {};
  for (double height = std::min(first_height, height_ / shrinking);; height *= shrinking) {
    height_ = height;
    const Prism prism(face_frame, growth_of_sides, height * face_frame.size, exclusion_margin_, frame);
    const bool is_listed =
        list_around(face_frame.incenter, prism.radius() + prism.farthest() + exclusion_margin_);
    const bool is_last = shrinking * height < min_height;
    if (is_listed && select_blocks(slot, prism) && (is_last || block_count_ <= Groups::many_blocks)) {
      // Rounded down, so that single precision covers no point outside.
      constexpr double down = 1 - 0x1p-22;
      return {std::span(blocks_).first(block_count_), static_cast<float>(height * face_frame.size * down),
              static_cast<float>(growth_of_sides * face_frame.inradius * down)};
    }
    if (is_last) return {};
  }
}

/// Makes near_ hold all leaves within this radius, or says that they are too many. Neighbours follow one
/// another: what is listed is to serve some of them, too.
bool GroupFinder::list_around(const Vec3& center, double radius) noexcept {
  const std::uint64_t left = remaining(budget_, work_.triangles + max_look);
  if (work_.spheres > left) return false;
  if ((center - listed_center_).norm() + radius * (1 + 0x1p-20) <= double{near_.covered_radius}) return true;
  const FilterFrame& frame = bvh_.frame();
  listed_center_ = center;
  const FilterPoint point{static_cast<float>(center.x()), static_cast<float>(center.y()),
                          static_cast<float>(center.z()), frame.plane_error(center)};
  for (const double larger : {2.0, 1.0}) {
    near_.start(center, static_cast<float>(larger * radius * (1 + 0x1p-18)) + 8 * point.plane_error);
    if (bvh::with_isa(bvh_.simd(),
                      [&](auto isa) { return isa.list_leaves(bvh_.parts(), point, left, near_, work_); }))
      return true;
  }
  near_.forget();
  return false;
}

/// Finds the blocks that the prism cannot do without, first that of the slot. Returns false where they are
/// too many.
bool GroupFinder::select_blocks(std::uint32_t slot, const Prism& prism) noexcept {
  const bvh::Parts& parts = bvh_.parts();
  const std::uint32_t own = slot / bvh::width;
  const std::size_t open = bvh::with_isa(
      bvh_.simd(), [&](auto isa) { return isa.leaves_within(parts, near_, prism.corners(), open_.data()); });
  work_.spheres += near_.count;
  blocks_[0] = {bvh::ChildRef::block_bit | own};
  block_count_ = 1;
  for (const bvh::ChildRef block : std::span(open_).first(open)) {
    if (block.index() == own) continue;
    work_.triangles += bvh::width;
    if (!bvh::with_isa(bvh_.simd(), [&](auto isa) { return isa.comes_within(parts, block, prism.points()); }))
      continue;
    if (block_count_ == blocks_.size()) return false;
    blocks_[block_count_++] = block;
  }
  return true;
}

}  // namespace touchmark::grid

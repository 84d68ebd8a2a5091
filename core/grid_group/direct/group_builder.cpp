#include "core/grid_group/direct/group_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/grid_group/direct/group_finder.h"
#include "core/grid_group/direct/prism.h"
#include "core/search/linear_scan.h"
#include "core/search/memory/backoff.h"
#include "core/search/threads/parallel.h"

namespace touchmark::grid {
namespace {

/// Groups of slots that follow one another, found but not stored yet.
struct Piece {
  struct Kept {
    std::uint32_t slot;
    std::size_t count;  ///< blocks
    float height, margin;
  };
  std::vector<Kept> groups;
  std::vector<bvh::ChildRef> blocks;

  void add(std::uint32_t slot, const FoundGroup& found) {
    if (found.blocks.empty()) return;
    groups.push_back({slot, found.blocks.size(), found.height, found.margin});
    blocks.insert(blocks.end(), found.blocks.begin(), found.blocks.end());
  }
  /// Returns false where there is no room for all.
  bool put(const Groups& into) const noexcept {
    const bvh::ChildRef* first = blocks.data();
    for (const Kept& kept : groups) {
      if (!into.put(kept.slot, {{first, kept.count}, kept.height, kept.margin})) return false;
      first += kept.count;
    }
    return true;
  }
};

/// Pieces are made by any thread and stored in their order, as long as there is room: of each slot what
/// kept(slot) returns, or what is found where that is null.
template <class KeptOf>
Groups make(const WideBvh& bvh, const GroupOptions& options, const KeptOf& kept) {
  // As many slots as let neighbours share what they list, and as many pieces as take little memory.
  constexpr std::size_t slots_a_piece = 256, pieces_a_wave = 64;
  const std::size_t slots = bvh.parts().triangles.size();
  Groups groups(slots, options.max_bytes, false);
  bool fits = !groups.empty();
  const double margin = exclusion_margin_for(bvh);
  for (std::size_t begin = 0; begin < slots && fits; begin += slots_a_piece * pieces_a_wave) {
    const std::size_t size = std::min(slots - begin, slots_a_piece * pieces_a_wave);
    std::vector<Piece> wave(pieces_a_wave);
    in_ranges(size, slots_a_piece, options.threads, [&](std::size_t first, std::size_t end) {
      GroupFinder finder(bvh, margin, any_work);
      // Slots next to those without groups probably have none either.
      Backoff<std::uint16_t, 4 * bvh::width> backoff;
      for (auto slot = static_cast<std::uint32_t>(begin + first); slot < begin + end; ++slot) {
        FoundGroup found;
        if (!kept(slot, found)) {
          if (backoff.waits()) continue;
          found = finder.find(slot);
          found.blocks.empty() ? backoff.failed() : backoff.paid();
        }
        wave[first / slots_a_piece].add(slot, found);
      }
    });
    for (const Piece& piece : wave) fits = fits && piece.put(groups);
  }
  groups.shrink();
  return groups;
}

/// True if what moved may have been in the group of this slot, or may be in it now.
bool changes(const WideBvh& bvh, std::uint32_t slot, std::span<const Aabb> moved) noexcept {
  const FaceFrame face_frame(bvh.parts().triangles[slot], bvh.frame());
  double radius = 0;
  for (const Vec3& corner : face_frame.corner)
    radius = std::max(radius, (corner - face_frame.incenter).norm());
  return any_within(moved, face_frame.incenter,
                    GroupFinder::reach_in_radii * radius + 2 * exclusion_margin_for(bvh));
}

}  // namespace

/// The kernel's error twice, and for sweeps the rounding of the position on the path, which goes with the
/// coordinates. Sixteen times that.
double exclusion_margin_for(const WideBvh& bvh) noexcept {
  const Aabb& box = bvh.bounds();
  const double coordinates = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return 16 * (culling_pad(4) + 4 * epsilon * bvh.frame().scale() * coordinates);
}

Groups build_groups(const WideBvh& bvh, const GroupOptions& options) {
  if (options.lazy) return {bvh.parts().triangles.size(), options.max_bytes, true};
  return make(bvh, options, [](std::uint32_t, FoundGroup&) { return false; });
}

/// What can be nearest in a prism is within its farthest() of it: triangles whose prism what moved does not
/// come so near to keep their groups.
Groups rebuild_groups(const WideBvh& bvh, const Groups& before, std::span<const Aabb> moved,
                      const GroupOptions& options) {
  if (before.empty()) return {};
  if (!options.lazy)
    return make(bvh, options, [&](std::uint32_t slot, FoundGroup& found) {
      const bool keeps = !changes(bvh, slot, moved);
      if (keeps) found = before.found(slot);
      return keeps;
    });
  Groups groups = build_groups(bvh, options);
  for (std::uint32_t slot = 0; slot < bvh.parts().triangles.size() && !groups.empty(); ++slot)
    if (!before.is_unbuilt(slot) && !changes(bvh, slot, moved)) groups.put(slot, before.found(slot));
  return groups;
}

}  // namespace touchmark::grid

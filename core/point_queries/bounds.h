/// Bounds that several queries use: of distances, with their rounding, and of the work that a query may take.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/bvh/build/lazy_builder.h"
#include "core/bvh/wide_bvh.h"
#include "core/search/linear_scan.h"
#include "core/search/ties/certified_nearest.h"

namespace touchmark::queries {

/// Bounds what the kernel's rounding may do, here and wherever the clearance is going to be used: it grows
/// with the path there, which is at most the clearance itself, so a relative 2^-40 of that does for the rest.
inline double clearance_pad(const WideBvh& bvh, const FilterPoint& point) noexcept {
  return 0.5 * bvh.frame().kernel_error(point.plane_error);
}
/// Returns a bound that no triangle is nearer than: neither those shown, the nearest of which is at `shown`,
/// nor those unseen.
inline double clearance_from(const WideBvh& bvh, float unseen, double shown, double pad) noexcept {
  return std::min(std::sqrt(bvh.frame().squared(unseen)), shown * (1 - 0x1p-40)) - pad;
}
/// Returns a lower bound of the distance by what was sampled, in mesh units.
inline double sampled_clearance(const WideBvh& bvh, const FilterPoint& point) noexcept {
  return static_cast<double>(bvh.distances().lower_bound(point)) * bvh.frame().unit();
}
inline double tight_sampled_clearance(const WideBvh& bvh, const FilterPoint& point) noexcept {
  return static_cast<double>(bvh.distances().tight_lower_bound(point)) * bvh.frame().unit();
}
/// Returns an upper bound likewise.
inline double sampled_distance(const WideBvh& bvh, const FilterPoint& point) noexcept {
  return static_cast<double>(bvh.distances().upper_bound(point)) * bvh.frame().unit();
}

inline std::uint64_t max_work(const WideBvh& bvh) noexcept {
  return work_budget(bvh.parts().triangles.size());
}
/// Bounds what a query for the nearest takes. A descent looks at each node and block once at most, and so at
/// no more than this, since a node has two children at least; a list is no longer than that. What it leaves
/// is for a refill before it.
inline std::uint64_t max_nearest_work(const WideBvh& bvh) noexcept {
  return bvh.parts().triangles.size() + max_work(bvh);
}
inline std::uint64_t max_refill_work(const WideBvh& bvh) noexcept {
  return remaining(max_nearest_work(bvh),
                   bvh::width * (bvh.parts().nodes.size() + bvh.parts().blocks.size()));
}

/// Returns true if a look at every triangle is more than what is left. The query ends undecided then.
inline bool must_end(const WideBvh& bvh, LimitedWork& work) noexcept {
  return work.exceeds_limit(bvh.parts().triangles.size());
}
/// Returns a look at every triangle. All must be there for that.
[[gnu::noinline, gnu::cold]] inline LinearScan scan_of(const WideBvh& bvh, bool certified,
                                                       Work& work) noexcept {
  bvh::build_rest(bvh.parts(), work);
  return {bvh.parts().triangles, bvh.bounds(), bvh.ids(), certified};
}
/// Looks at every triangle, where the hierarchy cannot be searched.
inline std::optional<Contact> nearest_of_every(const WideBvh& bvh, const Vec3& center, double reach,
                                               Work& work) noexcept {
  bvh::build_rest(bvh.parts(), work);
  return nearest_of_all(bvh.parts().triangles, bvh.bounds(), center, reach, bvh.ids(), work);
}

}  // namespace touchmark::queries

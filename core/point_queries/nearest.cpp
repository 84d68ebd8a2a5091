#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/point_queries/nearest_search.h"
#include "core/search/around.h"

namespace touchmark::queries {
namespace {

/// A search that ends with the triangles that may be nearest.
struct CloseEnds {
  const WideBvh& bvh;
  double reach, slack;
  CloseTriangles& into;

  static constexpr bool names_all = true;
  bool nothing() const noexcept {
    into.count = 0;
    return true;
  }
  static bool without() noexcept { return false; }
  static bool exhausted() noexcept { return false; }
  bool found(const NearestVisitor& visitor, double error, double distance) const noexcept {
    into.count = 0;
    if (distance > reach + error) return true;
    // The search was shown what is farther by at most the error, as computed: half of it is rounding's.
    if (!(2 * slack <= error)) return false;
    into.least = distance;
    into.error = error;
    bool fits = true;
    const auto add = [&](std::uint32_t at) {
      fits = fits && into.count < into.triangle.size();
      if (fits) into.triangle[into.count++] = bvh.parts().triangles[at].index;
    };
    return visitor.candidates.visit_close(add) && fits;
  }
};

}  // namespace

std::optional<Contact> nearest(const Surface& surface, const Vec3& center, double reach, PointMemory& memory,
                               Work& work) noexcept {
  return nearest_over(surface, center, reach, memory, work);
}

bool close_triangles(const Surface& surface, const Vec3& center, double reach, double slack,
                     PointMemory& memory, CloseTriangles& into, Work& work) noexcept {
  return search_nearest(surface, center, reach, memory, work, max_nearest_work(surface.bvh),
                        CloseEnds{surface.bvh, reach, slack, into});
}

WithinBudget nearest_within_budget(const Surface& surface, const Vec3& center, double reach,
                                   PointMemory& memory, LimitedWork& work) noexcept {
  bool is_exhausted = false;
  const auto exhausted = [&](const Surface&, const Vec3&, double, Work&) -> std::optional<Contact> {
    is_exhausted = true;
    return std::nullopt;
  };
  std::optional<Contact> contact = nearest_of(surface, center, reach, memory, work,
                                              std::min(max_work(surface.bvh), work.left()), exhausted);
  return {std::move(contact), is_exhausted};
}

}  // namespace touchmark::queries

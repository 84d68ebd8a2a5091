/// What a query looks at, for pictures of single steps. Only a core that is compiled with TOUCHMARK_TRACING
/// 1, as that of the program touchmark-tracer is, has it. In any other `tracing` is false, and queries are
/// compiled as if no note stood in them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/probe.h"
#include "core/search/plane_filter/plane_filter.h"

#ifndef TOUCHMARK_TRACING
#define TOUCHMARK_TRACING 0
#endif

namespace touchmark {

inline constexpr bool tracing = TOUCHMARK_TRACING != 0;

/// What one query looked at, in the mesh's frame and in the order in which it did. `entered` says whether
/// what is inside was looked at, too, or was within the limit and would have been.
struct Visits {
  struct Box {
    Aabb box;
    bool entered;
  };
  struct Cylinder {
    Vec3 center, normal;
    double radius, half;  ///< half of the height
    bool entered;
  };
  struct Group {
    Aabb box;  ///< around its triangles
    std::uint32_t members;
    bool entered;  ///< it covers the probe's centre
  };
  std::vector<Aabb> cells;  ///< those of a grid that held the probe's centre
  std::vector<Group> groups;
  std::vector<Box> boxes;
  std::vector<Cylinder> cylinders;
  std::vector<std::uint32_t> triangles;  ///< indices of those whose distance was computed in double

  const FilterFrame* frame = nullptr;  ///< the running query's: notes in it are told in the mesh's

  void note(const Aabb& box, bool entered) { boxes.push_back({box, entered}); }
  void note_in_frame(const Vec3& min, const Vec3& max, bool entered) {
    note({frame->from_frame(min), frame->from_frame(max)}, entered);
  }
};

/// What this thread's queries look at is noted here; null while nobody asks.
inline thread_local Visits* visits = nullptr;

[[maybe_unused]] inline void note_triangle(std::uint32_t index) {
  if (visits != nullptr) visits->triangles.push_back(index);
}

}  // namespace touchmark

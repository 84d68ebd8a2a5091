/// The queries of a haptic point over a hierarchy, each in a file of its name. All look, even where it is
/// known to be clear (memory.h). A radius or reach must be at least 0. What is remembered changes the cost of
/// an answer, never the answer. `work` counts.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/point_queries/memory.h"
#include "core/point_queries/surface.h"
#include "core/search/around.h"
#include "core/search/memory/last_question.h"

namespace touchmark::queries {

/// What one haptic point remembers between ticks.
struct Session {
  LimitedWork work;
  LastQuestion question;
  PointMemory memory;

  /// Forgets all but the counters.
  void forget() noexcept {
    question = {};
    memory.start_anew();
  }
};

bool touches(const Surface& surface, const Probe& probe, PointMemory& memory, LimitedWork& work) noexcept;
std::optional<Contact> nearest(const Surface& surface, const Vec3& center, double reach, PointMemory& memory,
                               Work& work) noexcept;
/// Answers for one of many points, of which little is remembered (followed.cpp).
std::optional<Contact> nearest(const Surface& surface, const Vec3& center, double reach,
                               bvh::FollowedPoint& point, Work& work) noexcept;
std::optional<Impact> first_hit(const Surface& surface, const Sweep& sweep, PointMemory& memory,
                                LimitedWork& work) noexcept;
std::size_t contacts(const Surface& surface, const Vec3& center, double reach, PointMemory& memory,
                     std::span<Contact> into, bool counts_all, LimitedWork& work) noexcept;
/// See the concept TellsCloseTriangles (nearest.cpp).
bool close_triangles(const Surface& surface, const Vec3& center, double reach, double slack,
                     PointMemory& memory, CloseTriangles& into, Work& work) noexcept;
/// See the concept ListsTriangles (listing.cpp).
bool list_triangles(const Surface& surface, const Vec3& center, double radius, ListedTriangles& into,
                    LimitedWork& work) noexcept;
/// Refills the list of leaves for the next query where the point is near, and asks the question ahead, where
/// the point will be if it goes on as it moved, unless that is known to be clear.
void prepare(const Surface& surface, const LastQuestion& question, PointMemory& memory,
             LimitedWork& work) noexcept;

/// The answer of `nearest`, or that `max_work` was exhausted before there was one.
struct WithinBudget {
  std::optional<Contact> contact;
  bool exhausted;
};
WithinBudget nearest_within_budget(const Surface& surface, const Vec3& center, double reach,
                                   PointMemory& memory, LimitedWork& work) noexcept;

}  // namespace touchmark::queries

/// The queries of a haptic point over a hierarchy. What is remembered changes the cost of an answer, never
/// the answer. Those that take a session answer any radius and reach, and at once where memory.h can. Those
/// that take `memory` are each in a file of its name: all look, even where it is known to be clear, a radius
/// or reach must be at least 0, and `work` counts.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/mesh_motion.h"
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
/// See the concept AnswersMovingSweep (moving_sweep.cpp).
std::optional<Impact> first_hit_moving(const Surface& surface, const Sweep& sweep, const MeshMotion& motion,
                                       LimitedWork& work) noexcept;
std::size_t contacts(const Surface& surface, const Vec3& center, double reach, PointMemory& memory,
                     std::span<Contact> into, bool counts_all, LimitedWork& work) noexcept;
/// See the concept TellsCloseTriangles (nearest.cpp).
bool close_triangles(const Surface& surface, const Vec3& center, double reach, double slack,
                     PointMemory& memory, CloseTriangles& into, Work& work) noexcept;
/// See the concept ListsTriangles (listing.cpp).
bool list_triangles(const Surface& surface, const Vec3& center, double radius, ListedTriangles& into,
                    LimitedWork& work) noexcept;
/// See the concept AnswersWithinBudget (bracket/bracket.cpp).
Bracket nearest_bracket(const Surface& surface, const Probe& probe, double reach, std::uint64_t budget,
                        Session& session) noexcept;
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

// Inline as far as what is known without a look: there a query is a few comparisons, less than a call.
[[gnu::always_inline]] inline bool touches(const Surface& surface, const Probe& probe,
                                           Session& session) noexcept {
  if (is_clear_at_once(surface.bvh, probe.center, probe.radius, session.memory)) return false;
  if (is_touching(surface.bvh, probe.center, probe.radius, session.memory)) return true;
  if (!(probe.radius >= 0)) return false;
  session.question = {LastQuestion::Query::touches, probe.radius};
  return touches(surface, probe, session.memory, session.work);
}
/// True if a query for the nearest must look; then it is what is asked.
[[gnu::always_inline]] inline bool asks_nearest(const Surface& surface, const Probe& probe, double reach,
                                                Session& session) noexcept {
  if (is_clear_at_once(surface.bvh, probe.center, reach, session.memory) || !(reach >= 0)) return false;
  session.question = {LastQuestion::Query::nearest, reach};
  return true;
}
inline std::optional<Contact> nearest(const Surface& surface, const Probe& probe, double reach,
                                      Session& session) noexcept {
  if (!asks_nearest(surface, probe, reach, session)) return std::nullopt;
  return nearest(surface, probe.center, reach, session.memory, session.work);
}
/// A ball that holds both ends of a path holds all of it.
inline std::optional<Impact> first_hit(const Surface& surface, const Sweep& sweep,
                                       Session& session) noexcept {
  if (is_clear_at_once(surface.bvh, sweep, session.memory) || !(sweep.radius >= 0)) return std::nullopt;
  session.question = {LastQuestion::Query::sweep, sweep.radius};
  return first_hit(surface, sweep, session.memory, session.work);
}
inline std::size_t contacts(const Surface& surface, const Probe& probe, double reach, Session& session,
                            std::span<Contact> into, bool counts_all = true) noexcept {
  if (is_clear_at_once(surface.bvh, probe.center, reach, session.memory) || !(reach >= 0)) return 0;
  session.question = {LastQuestion::Query::contacts, reach};
  return contacts(surface, probe.center, reach, session.memory, into, counts_all, session.work);
}
inline void prepare(const Surface& surface, Session& session) noexcept {
  prepare(surface, session.question, session.memory, session.work);
}

}  // namespace touchmark::queries

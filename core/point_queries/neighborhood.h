/// What a session that asks for contacts remembers of the triangles around: those in a ball, each behind a
/// plane that bounds its distance all around, so that sweeps and contacts in that ball look at few of them.
#pragma once

#include <array>
#include <cstdint>

#include "core/bvh/plane_list.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/search/memory/backoff.h"

namespace touchmark {

class ContactsWithin;
class FirstTouch;
class WideBvh;

namespace queries {

struct PointMemory;

/// Forgetting it changes the cost of the next answer, never the answer.
struct Neighborhood {
  static constexpr float first_margin = 0.2F;
  static constexpr std::uint32_t answers_that_pay = 3;

  bvh::PlaneList<256> list;     ///< about `center`
  Vec3 center = Vec3::Zero();   ///< in the mesh's frame
  double covered = -1;          ///< no triangle that is not listed is nearer to the centre; below 0: no list
  double contacts_reach = -1;   ///< about the largest of the contacts asked for last; below 0: none were
  double max_path = 0;          ///< about the longest of the sweeps asked for last
  float margin = first_margin;  ///< how far beyond what is asked to list next, in mean radii of the leaves
  Backoff<std::uint16_t, 63> backoff;
  /// Questions that the last list has answered. One that answers fewer than those that pay has cost more than
  /// it has saved.
  std::uint32_t answered = answers_that_pay;

  /// What was found of those within the reach at the last contacts, in the order of their places in the list.
  struct Measured {
    std::uint32_t place;
    Offset offset;
  };
  Vec3 measured_at = Vec3::Zero();
  std::uint32_t measured_count = 0;
  std::array<Measured, 16> measured;

  /// Becomes as a new one is, for which the arrays need not be cleared.
  void start_anew() noexcept {
    list.start_anew();
    center = measured_at = Vec3::Zero();
    covered = contacts_reach = -1;
    max_path = 0;
    margin = first_margin;
    backoff = {};
    answered = answers_that_pay;
    measured_count = 0;
  }
};

/// Looks for the first touch among the listed triangles, within the limit of work; `budget` is for a list.
/// Returns false where they may not be all that the ball may reach.
bool sweep_listed(const WideBvh& bvh, const Sweep& sweep, double reach, std::uint64_t budget,
                  FirstTouch& first, PointMemory& memory, LimitedWork& work) noexcept;
/// True if everything within the reach of the way between two points is listed.
bool is_listed(const Vec3& from, const Vec3& to, double reach, const Neighborhood& near) noexcept;
/// Adds all listed triangles within the reach to `found`, or those that the limit of work allows; `error` is
/// the kernel's. Returns false where they
/// may not be all there are.
bool contacts_listed(const WideBvh& bvh, const Vec3& center, double reach, double error,
                     ContactsWithin& found, PointMemory& memory, LimitedWork& work) noexcept;

}  // namespace queries
}  // namespace touchmark

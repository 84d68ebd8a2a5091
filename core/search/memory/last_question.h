/// What a haptic point asked last, and how it is asked again: between two ticks others use the caches, and a
/// query that was asked just before brings back its data and its code.
#pragma once

#include <cstdint>

#include "core/detector.h"
#include "core/search/memory/last_distance.h"

namespace touchmark {

/// The last of the queries that had to look.
struct LastQuestion {
  enum class Query : std::uint8_t { none, touches, nearest, sweep, contacts };

  Query query = Query::none;
  double reach = 0;  ///< how far it looked: the reach, or the probe's radius
};

/// Asks the question at this center; a sweep goes from there along `move`, and contacts are asked for where
/// the point is, too, since what is measured there serves a proxy's sweep from there. What is remembered of
/// the distance stays as it was. `structure` has the four queries, with `memory` and `work` in place of a
/// session.
template <class Structure, class Memory>
void ask_again(const Structure& structure, const LastQuestion& question, const Vec3& center, const Vec3& move,
               Memory& memory, LimitedWork& work) noexcept {
  const LastDistance kept = memory;
  switch (question.query) {
    case LastQuestion::Query::none:
      break;
    case LastQuestion::Query::touches:
      structure.touches({center, question.reach}, memory, work);
      break;
    case LastQuestion::Query::nearest:
      structure.nearest(center, question.reach, memory, work);
      break;
    case LastQuestion::Query::sweep:
      structure.first_hit({center, center + move, question.reach}, memory, work);
      break;
    case LastQuestion::Query::contacts:
      structure.contacts(center, question.reach, memory, work);
      structure.contacts(kept.center, question.reach, memory, work);
      break;
  }
  static_cast<LastDistance&>(memory) = kept;
}

}  // namespace touchmark

/// What a contestant is asked and what it answered, in a form that crosses process borders as bytes.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "core/probe.h"

namespace touchmark::bench::workload {

/// `moving` is a sweep among bodies that go from where they were a step before.
enum class Query : std::uint32_t { touches, nearest, sweep, moving };

/// Returns true if it asks about the way from the step before.
constexpr bool is_of_a_way(Query query) noexcept { return query >= Query::sweep; }

/// One step's answer. For `touches` only `found` counts. Plain bytes: no pointer, no padding, no Eigen.
struct Answer {
  std::uint32_t found = 0;  ///< touches: true. nearest: within reach. sweep: a hit on the way.
  TriangleId triangle = 0;  ///< the rest is zero unless found
  double fraction = 0;      ///< sweep; nearest, unfinished: no triangle is nearer than this
  double distance = 0;
  double point[3] = {0, 0, 0};
  double normal[3] = {0, 0, 0};
  Side side = Side::unasked;
  std::uint8_t unfinished = 0;  ///< nearest within a budget: a nearer triangle is left open
  std::uint8_t unused[2] = {0, 0};
  std::uint32_t body = 0;  ///< which of a scene's; 0 where there is one mesh

  static Answer of(const Contact& contact, double fraction = 0) {
    return {1,
            contact.triangle,
            fraction,
            contact.distance,
            {contact.point.x(), contact.point.y(), contact.point.z()},
            {contact.normal.x(), contact.normal.y(), contact.normal.z()},
            contact.side,
            0,
            {0, 0},
            0};
  }
};
static_assert(std::is_trivially_copyable_v<Answer> && sizeof(Answer) == 80);

/// Folds answers, in order, into the number that ties timed answers to verified ones. A few integer
/// operations, the same for every contestant, so that a timed loop cannot be optimised away and cannot answer
/// differently unseen.
class Checksum {
 public:
  void add(const Answer& answer) noexcept {
    const std::uint64_t said = answer.found + 2 * static_cast<std::uint64_t>(answer.side);
    const std::uint64_t named = (std::uint64_t{answer.body} << 32) + answer.triangle;
    value_ = std::rotl(value_, 7) ^ (said * 0x9e3779b97f4a7c15ULL + named) ^
             std::bit_cast<std::uint64_t>(answer.distance) ^ std::bit_cast<std::uint64_t>(answer.fraction);
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace touchmark::bench::workload

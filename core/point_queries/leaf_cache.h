/// What a haptic point remembers of the hierarchy: the blocks of triangles near it, so that the next ticks
/// need not start from the root.
#pragma once

#include <cstdint>

#include "core/bvh/leaf_list.h"
#include "core/search/memory/backoff.h"

namespace touchmark::queries {

/// Whether lists of leaves pay. Costs are in spheres of a list; 0: nothing is known.
///
/// Measured on scenes of the suite: a sphere of a descent, which waits for its node, costs four times as much
/// as one of a list or of a refill, and a triangle twenty times.
class LeafAccount {
 public:
  static constexpr std::uint32_t max_cooldown = 255;
  static constexpr float first_horizon_ticks = 16;

  float horizon_ticks = first_horizon_ticks;  ///< how many ticks ahead the next refill is to cover
  Backoff<std::uint32_t, max_cooldown> backoff;

  /// True if the cache may be refilled: not where the last refills have cost more than descents would have.
  bool may_refill() noexcept {
    if (backoff.waits()) return false;
    if (spent_ > 0) {
      // Lists go on where both cost about the same, since what comes next may be slower.
      const bool saved = 5 * spent_ <= 6 * (searches_ * descent_cost_);
      if (!saved) {
        spent_ = searches_ = 0;
        backoff.failed();
        return false;
      }
      // Half of the account stays, so that lists that saved make up for one that is left too soon.
      spent_ /= 2;
      searches_ /= 2;
      backoff.paid();
    }
    if (descent_cost_ > 0 && ++refills_ < refills_a_descent) return true;
    refills_ = 0;
    return false;
  }
  void count_descent(std::uint64_t spheres, std::uint64_t triangles) noexcept {
    const std::uint64_t cost = cost_of(4 * spheres, triangles);
    descent_cost_ = descent_cost_ > 0 ? (3 * descent_cost_ + cost) / 4 : cost;
  }
  void count_refill(std::uint64_t spheres) noexcept { spent_ += cost_of(spheres, 0); }
  void count_search(std::uint64_t spheres, std::uint64_t triangles) noexcept {
    ++searches_;
    spent_ += cost_of(spheres, triangles);
  }

 private:
  /// After so many refills a descent measures its cost anew.
  static constexpr std::uint32_t refills_a_descent = 32;
  static std::uint64_t cost_of(std::uint64_t spheres, std::uint64_t triangles) noexcept {
    return spheres + 20 * triangles;
  }

  /// What a descent near the surface costs, about, and what the last refills and their searches have cost,
  /// the later the more.
  std::uint64_t descent_cost_ = 0, spent_ = 0;
  std::uint64_t searches_ = 0;  ///< what `spent_` was spent on
  std::uint32_t refills_ = 0;   ///< since a descent measured its cost
};

struct LeafCache : LeafAccount, bvh::LeafList {
  /// With no more leaves than this the next refill is for more ticks.
  static constexpr std::uint32_t few = 40;

  /// Becomes as a new one is, for which the arrays need not be cleared.
  void start_anew() noexcept {
    static_cast<LeafAccount&>(*this) = {};
    start(Vec3::Zero(), -1);
  }
};

}  // namespace touchmark::queries

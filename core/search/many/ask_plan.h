/// In which order many points are asked, and which of them share a session.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/probe.h"
#include "core/search/many/curve_order.h"
#include "core/search/many/many_options.h"

namespace touchmark {

/// A plan is made anew for each call, of what is known of the last one. The order is cut into stretches, each
/// with a session of its own, as many for any number of threads.
class AskPlan {
 public:
  AskPlan() = default;
  // The indices are those of curve_'s memory, which moves along.
  AskPlan(AskPlan&&) noexcept = default;
  AskPlan& operator=(AskPlan&&) noexcept = default;
  AskPlan(const AskPlan&) = delete;
  AskPlan& operator=(const AskPlan&) = delete;
  ~AskPlan() = default;

  /// Takes at most 2^32 - 1 points, else throws std::invalid_argument. Points are followed from call to
  /// call where there are no more of them than `max_followed`: if they are nearer to where they were in the
  /// last call than to their neighbours in the order, each has a memory of its own.
  void make(std::span<const Vec3> points, AskOrder order, std::size_t max_followed);
  /// Knows nothing of the last call.
  void forget() noexcept { last_count_ = 0; }

  /// Returns the indices of the points in the order in which they are asked; empty: as they are given.
  std::span<const std::uint32_t> indices() const noexcept { return indices_; }
  /// Does each point have a memory of its own, that of its place in the order?
  bool is_followed() const noexcept { return followed_; }
  /// Returns how many consecutive points share a session where they do: enough to make up for the first of
  /// them, which knows nothing, and so many that there are few sessions.
  static std::size_t stretch_length(std::size_t points) noexcept {
    constexpr std::size_t least = 256, max_stretches = 256;
    return std::max(least, (points + max_stretches - 1) / max_stretches);
  }

 private:
  CurveOrder curve_;
  std::span<const std::uint32_t> indices_;
  AskOrder asked_ = AskOrder::automatic;  ///< in the last call
  double made_step_ = 0;                  ///< the mean step along the order when it was made
  bool followed_ = false;
  std::size_t last_count_ = 0;  ///< how many points the last call had, if they can be followed
  std::vector<Vec3> last_;      ///< a sample of those points
};

}  // namespace touchmark

#include "core/search/many/ask_plan.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace touchmark {

void AskPlan::make(std::span<const Vec3> points, AskOrder order, std::size_t max_followed) {
  if (points.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("nearest_many: " + std::to_string(points.size()) +
                                " points, of at most 4294967295");
  const bool can_follow = points.size() <= max_followed;
  const bool knows_last = can_follow && !points.empty() && last_count_ == points.size();
  const double step = knows_last ? mean_step(points, indices_) : 0;
  followed_ = knows_last && mean_move(last_, points) < step;
  // Steps along the order of the last call are as short as when it was made, or nearly so, where the points
  // are those of a rigid body.
  constexpr double growth = 1.5;
  if (!(knows_last && order == asked_ && step <= growth * made_step_)) {
    indices_ = {};
    if (order == AskOrder::curve || (order == AskOrder::automatic && !is_coherent(points))) {
      curve_.sort(points);
      indices_ = curve_.indices();
    }
    made_step_ = can_follow ? mean_step(points, indices_) : 0;
  }
  asked_ = order;
  take_sample(can_follow ? points : points.first(0), last_);
  last_count_ = can_follow ? points.size() : 0;
}

}  // namespace touchmark

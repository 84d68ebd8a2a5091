#include "core/search/ties/closest_candidates.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/search/ties/nearest_of_ties.h"
#include "core/search/ties/shared_nearest.h"

namespace touchmark {

/// Keeps only the exactly nearest where there are more than fit, the first where several are.
void ClosestCandidates::compact() noexcept {
  exact_decisions_ |= was_full;
  if (closeness_ == 0) {
    tie_count_ = 0;
    return;
  }
  NearestOfTies ties(*center_);
  pass_to(ties);
  exact_decisions_ += static_cast<std::uint32_t>(ties.exact_decisions());
  const auto is_nearest = [&](const Tie& tie) { return &triangles_[tie.at] == ties.nearest(); };
  const auto nearest = std::find_if(ties_.begin(), ties_.end(), is_nearest);
  tie_count_ = nearest == ties_.end() ? 0 : 1;
  if (tie_count_ == 1) ties_[0] = *nearest;
}

/// First the tie that was the nearest when there was no more room.
void ClosestCandidates::pass_to(NearestOfTies& ties) const noexcept {
  for (const Tie& tie : std::span(ties_).first(tie_count_)) ties.consider(triangles_[tie.at]);
  if (found()) ties.consider(triangles_[at_]);
}

bool ClosestCandidates::beats_ties(double error) const noexcept {
  const PreparedTriangle& first = triangles_[at_];
  const double limit = std::sqrt(best_.squared_distance) + error;
  for (const Tie& tie : std::span(ties_).first(tie_count_)) {
    if (tie.squared_distance == best_.squared_distance) {
      // The first of the two was kept: that is right if their distances are equal.
      if (!surely_share_nearest(first, triangles_[tie.at], *center_)) return false;
    } else if (std::sqrt(tie.squared_distance) <= limit) {
      return false;
    }
  }
  return true;
}

}  // namespace touchmark

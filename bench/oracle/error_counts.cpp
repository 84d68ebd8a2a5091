#include "bench/oracle/error_counts.h"

#include <algorithm>

namespace touchmark::bench::oracle {

ErrorCounts& ErrorCounts::operator+=(const ErrorCounts& other) noexcept {
  judged += other.judged;
  missed += other.missed;
  false_contacts += other.false_contacts;
  wrong_triangle += other.wrong_triangle;
  beyond_bound += other.beyond_bound;
  beyond_tolerance += other.beyond_tolerance;
  rounding += other.rounding;
  wrong_point += other.wrong_point;
  wrong_normal += other.wrong_normal;
  malformed += other.malformed;
  wrong_side += other.wrong_side;
  unresolved += other.unresolved;
  max_distance_error = std::max(max_distance_error, other.max_distance_error);
  max_distance_error_of_diagonal =
      std::max(max_distance_error_of_diagonal, other.max_distance_error_of_diagonal);
  max_distance_error_ulp = std::max(max_distance_error_ulp, other.max_distance_error_ulp);
  max_normal_angle_deg = std::max(max_normal_angle_deg, other.max_normal_angle_deg);
  max_point_error = std::max(max_point_error, other.max_point_error);
  return *this;
}

void Charges::merge(const Charges& others, std::size_t first_step) {
  for (const Charge& one : others.kept_) kept_.push_back({first_step + one.step, one.counts});
  std::ranges::sort(kept_, [](const Charge& a, const Charge& b) { return a.step < b.step; });
  if (kept_.size() > max_) kept_.resize(max_);
}

bool meets_guarantee(const ErrorCounts& counts, const Accuracy& accuracy) noexcept {
  if (counts.malformed + counts.wrong_side > 0) return false;
  if (accuracy.guarantee == Guarantee::approximate) return true;
  if (counts.missed > 0) return false;
  if (accuracy.guarantee == Guarantee::conservative) return true;
  return counts.false_contacts + counts.wrong_triangle + counts.beyond_bound + counts.wrong_point +
             counts.wrong_normal ==
         0;
}

}  // namespace touchmark::bench::oracle

/// Errors in a contestant's answers, counted by kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/detector.h"

namespace touchmark::bench::oracle {

/// What nobody feels or measures, of the diagonal of the mesh's box: a distance that is off by more is wrong
/// for any use, one that is off by less only rounded. On an object of 20 cm it is 0.2 micrometres, where
/// haptic devices resolve 1 to 55 and fingertips feel ridges of about 1; at 1 N/mm it is 0.2 mN.
inline constexpr double physical_tolerance = 1e-6;

/// An answer is charged under the first heading that fits: an undecided threshold is `unresolved` and never
/// missed or false; the fields of a missed, false or malformed answer are not judged further.
struct ErrorCounts {
  std::uint64_t judged = 0;          ///< answers looked at
  std::uint64_t missed = 0;          ///< contact not reported, or (sweep) reported after it had been made
  std::uint64_t false_contacts = 0;  ///< contact reported where there is none (sweep: not yet)
  std::uint64_t wrong_triangle = 0;  ///< not one of the nearest within the accuracy, no triangle of the mesh,
                                     ///< or not the very one that a contestant claims to name
  std::uint64_t beyond_bound = 0;    ///< distance off by more than the accuracy allows
  /// The distance by itself, whatever is claimed, against what arithmetic in double must be off by: 48
  /// roundings of the largest coordinate difference (kernel_relative_error), and one of the result.
  std::uint64_t beyond_tolerance = 0;  ///< off by more than that and than physical_tolerance
  std::uint64_t rounding = 0;          ///< off by more than that, within physical_tolerance
  std::uint64_t wrong_point = 0;   ///< point off its triangle, or not the one nearest to the centre, likewise
  std::uint64_t wrong_normal = 0;  ///< normal not unit, or turned by more than the accuracy can explain
  std::uint64_t malformed = 0;  ///< NaN or infinity in a field, a negative distance, a fraction outside [0,
                                ///< 1], or a bracket of the distance that does not hold the true one
  std::uint64_t wrong_side =
      0;  ///< nearest only: inside, outside or on the surface where that is not so; not to say is not wrong
  std::uint64_t unresolved = 0;  ///< differs from the truth, but within the accuracy of the threshold

  double max_distance_error = 0;              ///< mesh units
  double max_distance_error_of_diagonal = 0;  ///< max_distance_error over the diagonal of the mesh's box
  double max_distance_error_ulp = 0;  ///< in ulp of the true distance, where that exceeds its own rounding
  double max_normal_angle_deg = 0;    ///< over distances so large that the direction has a meaning
  double max_point_error = 0;  ///< mesh units, from the reported point to the triangle it should lie on

  /// Returns true if any answer is charged with what breaks a claim of exactness.
  bool charged() const noexcept {
    return missed + false_contacts + wrong_triangle + beyond_bound + wrong_point + wrong_normal + malformed +
               wrong_side >
           0;
  }

  ErrorCounts& operator+=(const ErrorCounts& other) noexcept;
  bool operator==(const ErrorCounts&) const = default;
};

/// Returns true if the counts agree with what the contestant claims. exact: no error of any kind.
/// conservative: nothing missed or malformed. approximate: nothing malformed. Whoever tells a side must tell
/// the right one.
bool meets_guarantee(const ErrorCounts& counts, const Accuracy& accuracy) noexcept;

/// One answer that was charged.
struct Charge {
  std::size_t step = 0;  ///< its place in the lists
  ErrorCounts counts;    ///< this answer's alone
};

/// The first ones of those that were charged, in the order of the steps.
class Charges {
 public:
  explicit Charges(std::size_t most = 3) : max_(most) {}
  /// In ascending order of the steps.
  void add(std::size_t step, const ErrorCounts& counts) {
    if (kept_.size() < max_) kept_.push_back({step, counts});
  }
  /// Adds the charges of another list of the same answers, whose steps are counted from `first_step`.
  void merge(const Charges& others, std::size_t first_step = 0);
  /// Returns how many are kept at most.
  std::size_t max() const noexcept { return max_; }
  const std::vector<Charge>& kept() const noexcept { return kept_; }

 private:
  std::size_t max_;
  std::vector<Charge> kept_;
};

}  // namespace touchmark::bench::oracle

/// The judge: each of a contestant's answers against the truth, errors counted by kind.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bench/oracle/oracle.h"
#include "bench/workload/answer.h"
#include "core/detector.h"

namespace touchmark::bench {

/// What a contestant that cannot tell the triangle reports; it is not charged for it. No mesh has this id
/// unless its file gave it.
inline constexpr TriangleId no_triangle = std::numeric_limits<TriangleId>::max();

/// What nobody feels or measures, of the diagonal of the mesh's box: a distance that is off by more is wrong
/// for any use, one that is off by less only rounded. On an object of 20 cm it is 0.2 micrometres, where
/// haptic devices resolve 1 to 55 and fingertips feel ridges of about 1; at 1 N/mm it is 0.2 mN.
inline constexpr double physical_tolerance = 1e-6;

/// Which fields of an answer a contestant fills in. Those it does not are not judged.
struct Reported {
  bool triangle = true;
  bool distance = true;
  bool point = true;
  bool normal = true;
};

/// An answer is charged under the first heading that fits: an undecided threshold is `unresolved` and never
/// missed or false; the fields of a missed, false or malformed answer are not judged further.
struct Tally {
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
  std::uint64_t malformed =
      0;  ///< NaN or infinity in a field, a negative distance, a fraction outside [0, 1]
  std::uint64_t wrong_side =
      0;  ///< nearest only: inside, outside or on the surface where that is not so; not to say is not wrong
  std::uint64_t unresolved = 0;  ///< differs from the truth, but within the accuracy of the threshold

  double max_distance_error = 0;              ///< mesh units
  double max_distance_error_of_diagonal = 0;  ///< the same over the diagonal of the mesh's box
  double max_distance_error_ulp = 0;  ///< in ulp of the true distance, where that exceeds its own rounding
  double max_normal_angle_deg = 0;    ///< where the distance is so large that the direction has a meaning
  double max_point_error = 0;  ///< mesh units, from the reported point to the triangle it should lie on

  /// Is any answer charged with what breaks a claim of exactness?
  bool charged() const noexcept {
    return missed + false_contacts + wrong_triangle + beyond_bound + wrong_point + wrong_normal + malformed +
               wrong_side >
           0;
  }

  Tally& operator+=(const Tally& other) noexcept;
  bool operator==(const Tally&) const = default;
};

/// Does the tally agree with what the contestant claims? exact: no error of any kind. conservative: nothing
/// missed or malformed. approximate: nothing malformed. Whoever tells a side must tell the right one.
bool keeps_its_word(const Tally& tally, const Accuracy& accuracy) noexcept;

/// One answer that was charged.
struct Charge {
  std::size_t step = 0;  ///< its place in the lists
  Tally tally;           ///< of this answer alone
};

/// The first ones of those that were charged, in the order of the steps.
class Charges {
 public:
  explicit Charges(std::size_t most = 3) : most_(most) {}
  /// In ascending order of the steps.
  void add(std::size_t step, const Tally& tally) {
    if (kept_.size() < most_) kept_.push_back({step, tally});
  }
  /// Those of another list of the same answers, whose steps are counted from `first_step`.
  void merge(const Charges& others, std::size_t first_step = 0);
  const std::vector<Charge>& kept() const noexcept { return kept_; }

 private:
  std::size_t most_;
  std::vector<Charge> kept_;
};

/// Judges `touches` (against each probe's radius) or `nearest` (against `reach`; infinite is allowed). Step i
/// of each list belongs together; the shorter of `probes` and `answers` decides how many are judged.
///
/// The accuracy allowed at a step is relative * M + absolute, M the largest coordinate difference between the
/// centre and the corners of the nearest (and of the reported, if tied) triangle, plus the rounding of the
/// result itself. Where it is infinite or NaN nothing is excused at a threshold, and fields are wrong beyond
/// physical_tolerance. Where it decides exactly nothing is excused at a threshold either.
///
/// An id stands for every triangle that carries it (a polygon's pieces).
Tally judge(const Oracle& oracle, std::span<const Truth> truths, Query query, std::span<const Probe> probes,
            double reach, std::span<const Answer> answers, const Accuracy& accuracy,
            const Reported& reported = {}, Charges* charges = nullptr);

/// Judges `sweep`. Of a contestant that decides exactly whether it hits is judged without tolerance: the way
/// comes within the radius or it does not; at fraction 0 it has to touch at the start, at another one it may
/// not touch before (missed, being late), and there it may be off the radius by no more than max_early_gap
/// (core/geometry/sphere_triangle_sweep.h) of the triangle named. All of these are decided in whole numbers,
/// on the way itself and not on positions rounded to points.
///
/// Of others a hit is right when the sweep hits, the centre at the reported fraction is the radius away
/// from the mesh (at fraction 0: at most that), and was not nearer before; all within the accuracy plus the
/// rounding of a position on the way. Of all the contact is judged as `nearest` there. The accuracy's
/// relative part is kernel_relative_error at least, and max_early_gap of those who claim exactness: no sweep
/// claims better.
Tally judge(const Oracle& oracle, std::span<const SweepTruth> truths, std::span<const Sweep> sweeps,
            std::span<const Answer> answers, const Accuracy& accuracy, const Reported& reported = {},
            Charges* charges = nullptr);

}  // namespace touchmark::bench

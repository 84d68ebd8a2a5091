/// The judge of one answer. judge.h is what others use.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bench/oracle/float_limits.h"
#include "bench/oracle/judge.h"

namespace touchmark::bench::oracle {

inline double raised(double x) noexcept { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
inline double lowered(double x) noexcept {
  return std::nextafter(x, -std::numeric_limits<double>::infinity());
}

/// Returns true if the reported fields are finite numbers in their range.
bool well_formed(const workload::Answer& answer, const Reported& reported) noexcept;

enum class Verdict { right, unresolved, wrong };

/// Bounds the error of a distance on a path: 384 u S, as E17 allows thrice.
inline double max_path_error(double start_difference, double largest_path) noexcept {
  return 192 * std::numeric_limits<double>::epsilon() * (start_difference + largest_path);
}

/// Charges single answers about one mesh or scene by one contestant's declared accuracy.
class AnswerJudge {
 public:
  AnswerJudge(const Reference& oracle, const Accuracy& accuracy, const Reported& reported)
      : oracle_(oracle),
        accuracy_(accuracy),
        reported_(reported),
        known_(std::isfinite(accuracy.relative) && std::isfinite(accuracy.absolute)),
        low_(oracle.bounds().min),
        high_(oracle.bounds().max),
        diagonal_((high_ - low_).norm()) {
    tolerance_ = std::isfinite(diagonal_) ? physical_tolerance * diagonal_ : 0;
  }

  /// Judges an answer to `touches` or `nearest`.
  void position(const GroundTruth& truth, workload::Query query, const Probe& probe, double reach,
                const workload::Answer& answer, ErrorCounts& counts) const;
  /// Judges an answer to `sweep`.
  void sweep(const SweepGroundTruth& truth, const Sweep& sweep, const workload::Answer& answer,
             ErrorCounts& counts) const;

 private:
  /// What a contestant may be off by; if it does not say, what double arithmetic cannot avoid.
  double allowed(double largest_difference) const noexcept {
    return known_ ? accuracy_.relative * largest_difference + accuracy_.absolute
                  : kernel_relative_error * largest_difference;
  }
  /// Returns what is allowed in the fields of an answer. Whoever declares nothing is not held to what others
  /// declare.
  double allowed_in_fields(double largest_difference) const noexcept {
    return known_ ? allowed(largest_difference) : std::max(allowed(largest_difference), tolerance_);
  }
  /// Returns true if the path touches the mesh beyond all excuse. A radius below the tolerance leaves no
  /// depth to tell by, only that the path goes through.
  bool surely_touches(const Vec3& from, const Vec3& to, double radius, double tolerance) const {
    return oracle_.segment_within(from, to, lowered(radius - tolerance)) ||
           (radius >= 0 && radius <= tolerance && oracle_.surely_crosses(from, to, tolerance));
  }
  double sweep_gap(const Sweep& sweep, const workload::Answer& answer) const;
  void exact_sweep(const SweepGroundTruth& truth, const Sweep& sweep, const workload::Answer& answer,
                   ErrorCounts& counts) const;
  Verdict threshold(const GroundTruth& truth, const Vec3& center, double limit, bool found) const;
  void contact(const GroundTruth& truth, const Vec3& center, const workload::Answer& answer,
               double position_error, ErrorCounts& counts) const;
  std::vector<GroundTruth> with_id(const GroundTruth& truth, const Vec3& center,
                                   const workload::Answer& answer, double position_error) const;
  std::vector<GroundTruth> tied(const GroundTruth& truth, const Vec3& center, double position_error) const;
  /// Judges an answer that leaves open whether a triangle is nearer than the one it names.
  void bracket(const GroundTruth& truth, const Vec3& center, const workload::Answer& answer,
               ErrorCounts& counts) const;
  void note_distance_error(double error, ErrorCounts& counts) const;
  /// Returns true if it names another triangle than the first of the nearest, and claims not to.
  bool is_misnamed(const GroundTruth& truth, const workload::Answer& answer) const {
    if (!accuracy_.names_exactly || !reported_.triangle || !std::isfinite(truth.high)) return false;
    return !oracle_.names_first(truth, answer);
  }
  bool is_wrong(Side said, const Vec3& center) const {
    if (said == Side::unasked || said == Side::undecided) return false;
    const std::optional<Side> side = oracle_.side(center);
    return side && *side != said;
  }

  const Reference& oracle_;
  const Accuracy& accuracy_;
  const Reported& reported_;
  bool known_;
  Vec3 low_, high_;
  double diagonal_;
  double tolerance_ = 0;  ///< physical_tolerance in mesh units; 0 where the diagonal is beyond doubles
};

}  // namespace touchmark::bench::oracle

/// The judge: each of a contestant's answers against the truth, errors counted by kind.
#pragma once

#include <limits>
#include <span>

#include "bench/oracle/error_counts.h"
#include "bench/oracle/oracle.h"
#include "bench/workload/answer.h"
#include "core/detector.h"

namespace touchmark::bench::oracle {

/// What a contestant that cannot tell the triangle reports; it is not charged for it. No mesh has this id
/// unless its file gave it.
inline constexpr TriangleId no_triangle = std::numeric_limits<TriangleId>::max();

/// Which fields of an answer a contestant fills in. Those it does not are not judged.
struct Reported {
  bool triangle = true;
  bool distance = true;
  bool point = true;
  bool normal = true;
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
ErrorCounts judge(const Oracle& oracle, std::span<const GroundTruth> truths, workload::Query query,
                  std::span<const Probe> probes, double reach, std::span<const workload::Answer> answers,
                  const Accuracy& accuracy, const Reported& reported = {}, Charges* charges = nullptr);

/// Judges one answer to `touches` or `nearest`, or to `sweep`, as the lists are judged.
ErrorCounts judge_one(const Reference& reference, const GroundTruth& truth, workload::Query query,
                      const Probe& probe, double reach, const workload::Answer& answer,
                      const Accuracy& accuracy, const Reported& reported = {});
ErrorCounts judge_one(const Reference& reference, const SweepGroundTruth& truth, const Sweep& sweep,
                      const workload::Answer& answer, const Accuracy& accuracy,
                      const Reported& reported = {});

/// Judges `sweep`. Of a contestant that decides exactly whether it hits is judged without tolerance: the path
/// comes within the radius or it does not; at fraction 0 it has to touch at the start, at another one it may
/// not touch before (missed, being late), and it has to touch at most 2^-50 of its path later. All of these
/// are decided in whole numbers, on the path itself and not on positions rounded to points. In a scene it may
/// be off the radius there by no more than max_path_error of the triangle named.
///
/// The hit of any other contestant is right when the sweep hits, the centre at the reported fraction is the
/// radius away from the mesh (at fraction 0: at most that), and was not nearer before; all within the
/// accuracy plus the rounding of a position on the path. For all contestants the contact is judged as
/// `nearest` there. The accuracy's relative part is kernel_relative_error at least, and max_path_error of
/// those who claim exactness: no sweep claims better.
ErrorCounts judge(const Oracle& oracle, std::span<const SweepGroundTruth> truths,
                  std::span<const Sweep> sweeps, std::span<const workload::Answer> answers,
                  const Accuracy& accuracy, const Reported& reported = {}, Charges* charges = nullptr);

}  // namespace touchmark::bench::oracle

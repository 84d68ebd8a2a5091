/// The truth about the steps of one trace, computed once, when first needed, for all contestants and
/// queries.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/ground_truth/wrong_answer.h"
#include "bench/oracle/judge.h"
#include "bench/oracle/oracle.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"

namespace touchmark::bench {

class GroundTruths {
 public:
  /// The oracle must outlive it.
  GroundTruths(const Oracle& oracle, std::span<const Step> steps);

  /// `answers` to the query are those of the ranges' steps, one after the other. The first of them that are
  /// charged become `wrong`, unless that is null. Throws Interrupted on Ctrl-C.
  ErrorCounts judge(Query query, const std::vector<StepRange>& ranges, std::span<const Answer> answers,
                    const Accuracy& accuracy, const Reported& reported = {},
                    std::vector<WrongAnswer>* wrong = nullptr);

  /// How far these steps, ascending, are from the surface; infinite where a coordinate is not finite.
  std::vector<double> distances(const std::vector<std::size_t>& steps);

 private:
  /// One of each a step.
  template <class Question, class TruthType>
  struct Asked {
    std::vector<Question> questions;
    std::vector<TruthType> truths;
    std::vector<bool> known;

    void solve(const Oracle& oracle, const std::vector<StepRange>& ranges);
  };
  /// The charges' steps are counted from the range's begin.
  ErrorCounts judge(Query query, StepRange range, std::span<const Answer> answers, const Accuracy& accuracy,
                    const Reported& reported, Charges& charges) const;
  WrongAnswer wrong_answer(Query query, std::size_t step, const Answer& got,
                           const ErrorCounts& charged) const;

  const Oracle& oracle_;
  std::vector<double> reaches_;
  Asked<Probe, GroundTruth> probes_;  // touches and nearest ask about the same
  Asked<Sweep, SweepGroundTruth> sweeps_;
};

}  // namespace touchmark::bench

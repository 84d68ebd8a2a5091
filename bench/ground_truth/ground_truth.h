/// The truth about the steps of one course, computed once, when first needed, for all contestants and
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

class Truths {
 public:
  /// The oracle must outlive it.
  Truths(const Oracle& oracle, std::span<const Step> steps);

  /// `answers` to the query are those of the windows' steps, one after the other. The first of them that are
  /// charged become `wrong`, unless that is null. Throws Interrupted on Ctrl-C.
  Tally judge(Query query, const std::vector<Window>& windows, std::span<const Answer> answers,
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

    void solve(const Oracle& oracle, const std::vector<Window>& windows);
  };
  /// The charges' steps are counted from the window's begin.
  Tally judge(Query query, Window window, std::span<const Answer> answers, const Accuracy& accuracy,
              const Reported& reported, Charges& charges) const;
  WrongAnswer wrong_answer(Query query, std::size_t step, const Answer& got, const Tally& charged) const;

  const Oracle& oracle_;
  std::vector<double> reaches_;
  Asked<Probe, Truth> probes_;  // touches and nearest ask about the same
  Asked<Sweep, SweepTruth> sweeps_;
};

}  // namespace touchmark::bench

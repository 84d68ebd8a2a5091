/// The ground truth about the steps of one trace, computed once, when first needed, for all contestants and
/// queries.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/ground_truth/step_truth.h"
#include "bench/ground_truth/wrong_answer.h"
#include "bench/oracle/judge.h"
#include "bench/oracle/oracle.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"

namespace touchmark::bench::ground_truth {

/// What is known of a trace, whatever stands or moves there.
class TraceTruths {
 public:
  TraceTruths() = default;
  TraceTruths(const TraceTruths&) = default;
  TraceTruths(TraceTruths&&) = default;
  TraceTruths& operator=(const TraceTruths&) = delete;
  TraceTruths& operator=(TraceTruths&&) = delete;
  virtual ~TraceTruths() = default;

  /// `answers` to the query are those of the ranges' steps, one after the other. The first of them that are
  /// charged become `wrong`, and all of them `charges`, by their places among the answers, unless these are
  /// null. Throws Interrupted on Ctrl-C.
  virtual oracle::ErrorCounts judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                                    std::span<const workload::Answer> answers, const Accuracy& accuracy,
                                    const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                                    std::vector<oracle::Charge>* charges) = 0;
  oracle::ErrorCounts judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                            std::span<const workload::Answer> answers, const Accuracy& accuracy,
                            const oracle::Reported& reported = {},
                            std::vector<WrongAnswer>* wrong = nullptr) {
    return judge(query, ranges, answers, accuracy, reported, wrong, nullptr);
  }

  /// Returns what is known so far, a step each.
  virtual std::vector<StepTruth> known(workload::Query query) const = 0;

  /// How far these steps, ascending, are from the surface; infinite where a coordinate is not finite.
  virtual std::vector<double> distances(const std::vector<std::size_t>& steps) = 0;
};

/// Truths about one mesh.
class GroundTruths final : public TraceTruths {
 public:
  /// The oracle must outlive it.
  GroundTruths(const oracle::Oracle& oracle, std::span<const workload::Step> steps);

  using TraceTruths::judge;
  oracle::ErrorCounts judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                            std::span<const workload::Answer> answers, const Accuracy& accuracy,
                            const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                            std::vector<oracle::Charge>* charges) override;
  std::vector<StepTruth> known(workload::Query query) const override;
  std::vector<double> distances(const std::vector<std::size_t>& steps) override;

 private:
  /// One of each a step.
  template <class Question, class TruthType>
  struct Asked {
    std::vector<Question> questions;
    std::vector<TruthType> truths;
    std::vector<bool> known;

    void solve(const oracle::Oracle& oracle, const std::vector<workload::StepRange>& ranges);
  };
  /// The charges' steps are counted from the range's begin.
  oracle::ErrorCounts judge(workload::Query query, workload::StepRange range,
                            std::span<const workload::Answer> answers, const Accuracy& accuracy,
                            const oracle::Reported& reported, oracle::Charges& charges) const;
  WrongAnswer wrong_answer(workload::Query query, std::size_t step, const workload::Answer& got,
                           const oracle::ErrorCounts& charged) const;

  const oracle::Oracle& oracle_;
  std::vector<double> reaches_;
  Asked<Probe, oracle::GroundTruth> probes_;  // touches and nearest ask about the same
  Asked<Sweep, oracle::SweepGroundTruth> sweeps_;
};

}  // namespace touchmark::bench::ground_truth

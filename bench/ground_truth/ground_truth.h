/// The ground truth about the steps of one trace, computed once, when first needed, for all contestants and
/// queries.
#pragma once

#include <cstddef>
#include <cstdint>
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
  std::vector<StepTruth> known(workload::Query query) const;

  /// The one of the box around mesh or bodies.
  double diagonal() const { return (reference().bounds().max - reference().bounds().min).norm(); }
  /// How far these steps, ascending, are from the surface; infinite where a coordinate is not finite.
  virtual std::vector<double> distances(const std::vector<std::size_t>& steps) = 0;

 protected:
  /// One of each a step.
  template <class Truth>
  struct Solved {
    std::vector<Truth> truths;  ///< empty until one is known
    std::vector<bool> known;

    void set(std::size_t step, const Truth& truth) {
      truths.resize(known.size());
      truths[step] = truth;
      known[step] = true;
    }
  };

  explicit TraceTruths(std::span<const workload::Step> steps) : steps_(steps.begin(), steps.end()) {
    positions_.known.resize(steps.size());
    sweeps_.known.resize(steps.size());
  }
  Sweep sweep_of(std::size_t step) const;
  static double distance_of(const oracle::GroundTruth& truth) noexcept;
  /// The truth about the step must be known.
  WrongAnswer wrong_answer(workload::Query query, std::size_t step, const workload::Answer& got,
                           const oracle::ErrorCounts& charged) const;

  std::vector<workload::Step> steps_;
  Solved<oracle::GroundTruth> positions_;  // touches and nearest ask about the same
  Solved<oracle::SweepGroundTruth> sweeps_;

 private:
  virtual const oracle::Reference& reference() const = 0;
  /// Returns the id that the file of its mesh gave it.
  virtual TriangleId id_of(std::uint32_t triangle) const = 0;
  bool is_found(workload::Query query, std::size_t step) const;
};

/// Truths about one mesh.
class GroundTruths final : public TraceTruths {
 public:
  /// The oracle must outlive it.
  GroundTruths(const oracle::Oracle& oracle, std::span<const workload::Step> steps)
      : TraceTruths(steps), oracle_(oracle) {}

  using TraceTruths::judge;
  oracle::ErrorCounts judge(workload::Query query, const std::vector<workload::StepRange>& ranges,
                            std::span<const workload::Answer> answers, const Accuracy& accuracy,
                            const oracle::Reported& reported, std::vector<WrongAnswer>* wrong,
                            std::vector<oracle::Charge>* charges) override;
  std::vector<double> distances(const std::vector<std::size_t>& steps) override;

 private:
  const oracle::Reference& reference() const override { return oracle_; }
  TriangleId id_of(std::uint32_t triangle) const override { return oracle_.mesh().id(triangle); }
  /// Solves what `question` asks about each step of the ranges, as far as it is not known.
  template <class Truth, class Question>
  void solve(const std::vector<workload::StepRange>& ranges, Solved<Truth>& solved, const Question& question);
  void solve_positions(const std::vector<workload::StepRange>& ranges);
  /// The charges' steps are counted from the range's begin.
  oracle::ErrorCounts judge(workload::Query query, workload::StepRange range,
                            std::span<const workload::Answer> answers, const Accuracy& accuracy,
                            const oracle::Reported& reported, oracle::Charges& charges) const;

  const oracle::Oracle& oracle_;
};

}  // namespace touchmark::bench::ground_truth

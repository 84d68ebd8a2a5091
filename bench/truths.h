/// The truth about the steps of one course, computed once, when first needed, for all contestants.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/answer.h"
#include "bench/contestant.h"
#include "bench/oracle/oracle.h"
#include "bench/verify.h"

namespace touchmark::bench {

class Truths {
 public:
  /// Both must outlive it.
  Truths(const Oracle& oracle, const Course& course);

  /// `answers` are those of the windows' steps, one after the other. Throws Interrupted on Ctrl-C.
  Tally judge(const std::vector<Window>& windows, std::span<const Answer> answers, const Accuracy& accuracy,
              const Reported& reported = {});

 private:
  void solve(const std::vector<Window>& windows);
  Tally judge(Window window, std::span<const Answer> answers, const Accuracy& accuracy,
              const Reported& reported) const;

  const Oracle& oracle_;
  Query query_;
  std::vector<Probe> probes_;
  std::vector<double> reaches_;
  std::vector<Sweep> sweeps_;  // of query sweep only
  std::vector<bool> known_;
  // One a step, for one kind of query or the other.
  std::vector<Truth> truths_;
  std::vector<SweepTruth> sweep_truths_;
};

}  // namespace touchmark::bench

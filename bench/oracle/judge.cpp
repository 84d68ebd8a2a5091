#include "bench/oracle/judge.h"

#include <algorithm>
#include <mutex>

#include "bench/oracle/answer_judge.h"
#include "bench/oracle/parallel.h"
#include "core/geometry/sphere_triangle_sweep.h"

namespace touchmark::bench::oracle {
namespace {

/// Adds up judge_one(i, counts) for i < size.
template <class JudgeOne>
ErrorCounts total(std::size_t size, unsigned threads, Charges* charges, const JudgeOne& judge_one) {
  ErrorCounts sum;
  std::mutex mutex;
  in_parallel(size, threads, [&](std::size_t begin, std::size_t end) {
    ErrorCounts piece;
    Charges of_piece(charges != nullptr ? charges->max() : 0);
    for (std::size_t i = begin; i < end; ++i) {
      ErrorCounts one;
      judge_one(i, one);
      if (one.charged()) of_piece.add(i, one);
      piece += one;
    }
    const std::lock_guard lock(mutex);
    sum += piece;
    if (charges != nullptr) charges->merge(of_piece);
  });
  return sum;
}

Accuracy of_sweeps(Accuracy accuracy) {
  // The path's start is within M of the triangle, and the path's coordinates are within 2 M.
  const double least = accuracy.guarantee == Guarantee::exact ? max_path_error(1, 2) : kernel_relative_error;
  accuracy.relative = std::max(accuracy.relative, least);
  return accuracy;
}

}  // namespace

ErrorCounts judge(const Oracle& oracle, std::span<const GroundTruth> truths, workload::Query query,
                  std::span<const Probe> probes, double reach, std::span<const workload::Answer> answers,
                  const Accuracy& accuracy, const Reported& reported, Charges* charges) {
  const AnswerJudge judge(oracle, accuracy, reported);
  return total(std::min({truths.size(), probes.size(), answers.size()}), oracle.threads(), charges,
               [&](std::size_t i, ErrorCounts& counts) {
                 judge.position(truths[i], query, probes[i], reach, answers[i], counts);
               });
}

ErrorCounts judge(const Oracle& oracle, std::span<const SweepGroundTruth> truths,
                  std::span<const Sweep> sweeps, std::span<const workload::Answer> answers,
                  const Accuracy& accuracy, const Reported& reported, Charges* charges) {
  const Accuracy claimed = of_sweeps(accuracy);
  const AnswerJudge judge(oracle, claimed, reported);
  return total(
      std::min({truths.size(), sweeps.size(), answers.size()}), oracle.threads(), charges,
      [&](std::size_t i, ErrorCounts& counts) { judge.sweep(truths[i], sweeps[i], answers[i], counts); });
}

ErrorCounts judge_one(const Reference& reference, const GroundTruth& truth, workload::Query query,
                      const Probe& probe, double reach, const workload::Answer& answer,
                      const Accuracy& accuracy, const Reported& reported) {
  ErrorCounts counts;
  AnswerJudge(reference, accuracy, reported).position(truth, query, probe, reach, answer, counts);
  return counts;
}

ErrorCounts judge_one(const Reference& reference, const SweepGroundTruth& truth, const Sweep& sweep,
                      const workload::Answer& answer, const Accuracy& accuracy, const Reported& reported) {
  ErrorCounts counts;
  const Accuracy claimed = of_sweeps(accuracy);
  AnswerJudge(reference, claimed, reported).sweep(truth, sweep, answer, counts);
  return counts;
}

}  // namespace touchmark::bench::oracle

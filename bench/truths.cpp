#include "bench/truths.h"

#include <algorithm>

#include "bench/interrupt.h"

namespace touchmark::bench {
namespace {

/// Often enough for Ctrl-C, seldom enough for threads to be worth starting.
constexpr std::size_t solved_at_once = 2048;

/// Asks the oracle about the `wanted` ones of `questions` and puts the truths into their places.
template <class Question, class TruthType>
void solve_some(const Oracle& oracle, const std::vector<Question>& questions,
                std::span<const std::size_t> wanted, std::vector<TruthType>& truths) {
  std::vector<Question> some;
  for (const std::size_t i : wanted) some.push_back(questions[i]);
  const std::vector<TruthType> solved = oracle.solve(std::span<const Question>(some));
  for (std::size_t i = 0; i < wanted.size(); ++i) truths[wanted[i]] = solved[i];
}

}  // namespace

Truths::Truths(const Oracle& oracle, const Course& course)
    : oracle_(oracle), query_(course.query), known_(course.steps.size()) {
  for (std::size_t i = 0; i < course.steps.size(); ++i) {
    const Probe& now = course.steps[i].probe;
    probes_.push_back(now);
    reaches_.push_back(course.steps[i].reach);
    if (query_ != Query::sweep) continue;
    sweeps_.push_back({course.steps[i > 0 ? i - 1 : 0].probe.center, now.center, now.radius});
  }
  if (query_ == Query::sweep) {
    sweep_truths_.resize(sweeps_.size());
  } else {
    truths_.resize(probes_.size());
  }
}

void Truths::solve(const std::vector<Window>& windows) {
  std::vector<std::size_t> unknown;
  for (const Window& window : windows) {
    for (std::size_t i = window.begin; i < window.end; ++i) {
      if (!known_[i]) unknown.push_back(i);
    }
  }
  for (std::size_t begin = 0; begin < unknown.size(); begin += solved_at_once) {
    check_for_interrupt();
    const std::span<const std::size_t> some =
        std::span(unknown).subspan(begin, std::min(solved_at_once, unknown.size() - begin));
    if (query_ == Query::sweep) {
      solve_some(oracle_, sweeps_, some, sweep_truths_);
    } else {
      solve_some(oracle_, probes_, some, truths_);
    }
    for (const std::size_t i : some) known_[i] = true;
  }
}

Tally Truths::judge(const std::vector<Window>& windows, std::span<const Answer> answers,
                    const Accuracy& accuracy, const Reported& reported) {
  solve(windows);
  Tally tally;
  std::size_t done = 0;
  for (const Window& window : windows) {
    check_for_interrupt();
    tally += judge(window, answers.subspan(done, window.size()), accuracy, reported);
    done += window.size();
  }
  return tally;
}

Tally Truths::judge(Window window, std::span<const Answer> answers, const Accuracy& accuracy,
                    const Reported& reported) const {
  if (query_ == Query::sweep) {
    return bench::judge(oracle_, std::span(sweep_truths_).subspan(window.begin, window.size()),
                        std::span(sweeps_).subspan(window.begin, window.size()), answers, accuracy, reported);
  }
  // The judge takes one reach; recorded trajectories may change theirs from step to step.
  Tally tally;
  for (std::size_t begin = window.begin, end = begin; begin < window.end; begin = end) {
    while (end < window.end && reaches_[end] == reaches_[begin]) ++end;
    if (end == begin) ++end;  // a reach that is not a number equals nothing
    tally += bench::judge(oracle_, std::span(truths_).subspan(begin, end - begin), query_,
                          std::span(probes_).subspan(begin, end - begin), reaches_[begin],
                          answers.subspan(begin - window.begin, end - begin), accuracy, reported);
  }
  return tally;
}

}  // namespace touchmark::bench

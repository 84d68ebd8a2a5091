#include "bench/regression/gate/judge.h"

#include <array>
#include <cmath>

#include "bench/support/names.h"

namespace touchmark::bench::regression::gate {

constexpr std::array<support::Name<Verdict>, 4> verdicts{{{Verdict::pass, "pass"},
                                                          {Verdict::faster, "faster"},
                                                          {Verdict::slower, "SLOWER"},
                                                          {Verdict::inconclusive, "inconclusive"}}};

std::string_view name_of(Verdict verdict) noexcept { return support::name_in(verdicts, verdict); }

bool control_holds(const Batch& batch, double tolerance) noexcept {
  return batch.control.low >= 1 / (1 + tolerance) && batch.control.high <= 1 + tolerance;
}

Judgement judge(double baseline, double tolerance, const std::function<Batch()>& next_batch) {
  constexpr int agreeing = 2;
  const double limit = baseline * (1 + tolerance);
  const double half_way = baseline * std::sqrt(1 + tolerance);
  Judgement judgement;
  int slower = 0, in_doubt = 0;
  while (judgement.batches < max_batches) {
    judgement.batch = next_batch();
    ++judgement.batches;
    if (!control_holds(judgement.batch, tolerance)) continue;
    const RatioInterval& ratio = judgement.batch.ratio;
    if (ratio.low > limit) {
      if (++slower < agreeing) continue;
      judgement.verdict = Verdict::slower;
      return judgement;
    }
    if (ratio.ratio > half_way && ++in_doubt < agreeing) continue;
    judgement.verdict = ratio.high < baseline / (1 + tolerance) ? Verdict::faster : Verdict::pass;
    return judgement;
  }
  return judgement;
}

}  // namespace touchmark::bench::regression::gate

#include "bench/gate/judge.h"

namespace touchmark::bench {

std::string_view name_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::faster:
      return "faster";
    case Verdict::slower:
      return "SLOWER";
    case Verdict::inconclusive:
      return "inconclusive";
  }
  return "";
}

bool control_holds(const Batch& batch, double tolerance) noexcept {
  return batch.control.low >= 1 / (1 + tolerance) && batch.control.high <= 1 + tolerance;
}

Judgement judge(double baseline, double tolerance, const std::function<Batch()>& next_batch) {
  Judgement judgement;
  bool slower_before = false;
  while (judgement.batches < most_batches) {
    judgement.batch = next_batch();
    ++judgement.batches;
    if (!control_holds(judgement.batch, tolerance)) continue;
    const RatioInterval& ratio = judgement.batch.ratio;
    if (ratio.low <= baseline * (1 + tolerance)) {
      judgement.verdict = ratio.high < baseline / (1 + tolerance) ? Verdict::faster : Verdict::pass;
      return judgement;
    }
    if (slower_before) {
      judgement.verdict = Verdict::slower;
      return judgement;
    }
    slower_before = true;
  }
  return judgement;
}

}  // namespace touchmark::bench

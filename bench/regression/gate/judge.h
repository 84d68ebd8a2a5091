/// The verdict of the gate, from batches of measured ratios. No clock in here.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "bench/regression/gate/bootstrap.h"

namespace touchmark::bench::regression::gate {

/// A batch: the detector against the reference, and the reference against itself (another process of it) in
/// the same rounds. What is equal must measure equal, or the batch tells nothing.
struct Batch {
  RatioInterval ratio;
  RatioInterval control;
};

enum class Verdict {
  pass,
  faster,        ///< by more than the tolerance
  slower,        ///< two batches agree on it
  inconclusive,  ///< too few batches had a control that measured equal
};

std::string_view name_of(Verdict verdict) noexcept;

/// Returns true if the whole interval of the control lies within the tolerance of 1.
bool control_holds(const Batch& batch, double tolerance) noexcept;

struct Judgement {
  Verdict verdict = Verdict::inconclusive;
  Batch batch;  ///< the one that decided, or the last
  int batches = 0;
};

/// Asks for one batch after the other, at most `max_batches`, and counts those whose control holds. One
/// whose ratio is nearer to the baseline than to the limit, baseline * (1 + tolerance), is enough to pass.
/// Else, since where memory lies moves the times of a process, two must agree: slower, their ratios' lower
/// ends above the limit, or no slower.
Judgement judge(double baseline, double tolerance, const std::function<Batch()>& next_batch);

inline constexpr int max_batches = 4;

}  // namespace touchmark::bench::regression::gate

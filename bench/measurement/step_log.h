/// What one contestant did at each step of one trace: for whoever wants steps, not sums over them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/oracle/error_counts.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"

namespace touchmark::bench::measurement {

/// What an answer was charged with: a bit each.
enum ChargeKind : std::uint8_t {
  charged_missed = 1,
  charged_false_contact = 2,
  charged_triangle = 4,
  charged_distance = 8,
  charged_point = 16,
  charged_normal = 32,
  charged_malformed = 64,
  charged_side = 128
};

/// The lists hold the ranges' steps one after the other.
struct StepLog {
  std::vector<workload::StepRange> ranges;  ///< ascending
  std::vector<workload::Answer> answers;
  std::vector<std::uint64_t> work;
  std::vector<std::uint8_t> charged;  ///< ChargeKind bits; 0: right, or within what is claimed
  std::vector<double> ns;             ///< as the percentiles of the row see them; empty until it was timed
};

/// Returns the log of a contestant that was verified and not yet timed. `charges` are by their places among
/// the answers.
StepLog log_of(const std::vector<workload::StepRange>& ranges, std::span<const workload::Answer> answers,
               std::span<const std::uint64_t> work, const std::vector<oracle::Charge>& charges);

}  // namespace touchmark::bench::measurement

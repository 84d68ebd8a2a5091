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

/// Returns the bits of what one answer is charged with.
inline std::uint8_t kinds_of(const oracle::ErrorCounts& one) noexcept {
  const auto bit = [](std::uint64_t count, ChargeKind kind) { return count > 0 ? kind : 0; };
  return static_cast<std::uint8_t>(
      bit(one.missed, charged_missed) | bit(one.false_contacts, charged_false_contact) |
      bit(one.wrong_triangle, charged_triangle) | bit(one.beyond_bound, charged_distance) |
      bit(one.wrong_point, charged_point) | bit(one.wrong_normal, charged_normal) |
      bit(one.malformed, charged_malformed) | bit(one.wrong_side, charged_side));
}

/// The lists hold the ranges' steps one after the other.
struct StepLog {
  std::vector<workload::StepRange> ranges;  ///< ascending
  std::vector<workload::Answer> answers;
  std::vector<std::uint64_t> work;
  std::vector<std::uint8_t> charged;  ///< ChargeKind bits; 0: right, or within what is claimed
  std::vector<double> ns;             ///< as the percentiles of the row see them; empty until it was timed
};

}  // namespace touchmark::bench::measurement

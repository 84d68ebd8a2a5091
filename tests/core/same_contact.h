/// Compares contacts of two detectors.
#pragma once

#include <cstring>
#include <optional>

#include "bench/workload/answer.h"
#include "core/probe.h"

namespace touchmark::test {

/// Compares everything that an answer records.
inline bool same_bits(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  using bench::workload::Answer;
  const Answer left = a ? Answer::of(*a) : Answer{}, right = b ? Answer::of(*b) : Answer{};
  return std::memcmp(&left, &right, sizeof left) == 0;
}

}  // namespace touchmark::test

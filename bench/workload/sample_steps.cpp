#include "bench/workload/sample_steps.h"

#include <algorithm>

namespace touchmark::bench::workload {
namespace {

/// Long enough for a session to profit from coherence, short enough to see several parts of the way.
constexpr std::size_t max_range = 64;
constexpr std::size_t min_ranges = 8;

}  // namespace

std::vector<StepRange> sample_steps(std::size_t total, std::size_t wanted) {
  if (wanted >= total) return {{0, total}};
  const std::size_t length = std::clamp<std::size_t>(wanted / min_ranges, 1, max_range);
  const std::size_t count = std::max<std::size_t>(wanted / length, 1);
  std::vector<StepRange> ranges;
  for (std::size_t i = 0; i < count; ++i) {
    // The i-th of `count` equal parts of the way begins here; length * count <= total keeps them disjoint.
    const std::size_t begin = i * (total / count) + std::min(i, total % count);
    ranges.push_back({begin, begin + length});
  }
  return ranges;
}

std::size_t place_in(const std::vector<StepRange>& ranges, std::size_t step) {
  std::size_t before = 0;
  for (const StepRange& range : ranges) {
    if (step >= range.begin && step < range.end) return before + step - range.begin;
    before += range.size();
  }
  return before;
}

std::size_t step_at(const std::vector<StepRange>& ranges, std::size_t place) {
  for (const StepRange& range : ranges) {
    if (place < range.size()) return range.begin + place;
    place -= range.size();
  }
  return ranges.back().end - 1;
}

std::vector<StepRange> joined(const std::vector<StepRange>& ranges) {
  std::vector<StepRange> result;
  for (const StepRange& range : ranges) {
    if (!result.empty() && result.back().end == range.begin) {
      result.back().end = range.end;
    } else {
      result.push_back(range);
    }
  }
  return result;
}

std::vector<StepRange> split(StepRange range, std::size_t parts) {
  parts = std::clamp<std::size_t>(parts, 1, std::max<std::size_t>(range.size(), 1));
  std::vector<StepRange> result;
  std::size_t begin = range.begin;
  for (std::size_t i = 1; i <= parts; ++i) {
    const std::size_t end = range.begin + range.size() * i / parts;
    result.push_back({begin, end});
    begin = end;
  }
  return result;
}

std::size_t steps_in(const std::vector<StepRange>& ranges) noexcept {
  std::size_t steps = 0;
  for (const StepRange& range : ranges) steps += range.size();
  return steps;
}

}  // namespace touchmark::bench::workload

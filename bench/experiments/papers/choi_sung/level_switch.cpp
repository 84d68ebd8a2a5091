#include "bench/experiments/papers/choi_sung/level_switch.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace touchmark::bench::experiments::papers {

LevelSwitch::LevelSwitch(std::vector<double> expected_ns, double period_ns)
    : expected_ns_(std::move(expected_ns)), period_ns_(period_ns) {
  assert(!expected_ns_.empty() && std::ranges::is_sorted(expected_ns_));
}

/// The second largest of the recent ratios.
double LevelSwitch::slowness() const noexcept {
  double largest = 0, second = 0;
  for (const double ratio : ratios_) {
    second = std::max(second, std::min(ratio, largest));
    largest = std::max(largest, ratio);
  }
  return second;
}

void LevelSwitch::go_to(std::size_t level) noexcept {
  level_ = level;
  calm_ = 0;
  ++switches_;
}

void LevelSwitch::took(double ns) noexcept {
  ratios_[next_] = ns / expected_ns_[level_];
  next_ = (next_ + 1) % recent;
  const double slow = slowness();
  std::size_t in_time = level_;
  while (in_time > 0 && expected_ns_[in_time] * slow > period_ns_) --in_time;
  if (in_time < level_) return go_to(in_time);
  if (level_ + 1 == expected_ns_.size()) return;
  calm_ = expected_ns_[level_ + 1] * slow <= room * period_ns_ ? calm_ + 1 : 0;
  if (calm_ >= calm) go_to(level_ + 1);
}

}  // namespace touchmark::bench::experiments::papers

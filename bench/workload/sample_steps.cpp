#include "bench/workload/sample_steps.h"

#include <algorithm>

namespace touchmark::bench {
namespace {

/// Long enough for a session to profit from coherence, short enough to see several parts of the way.
constexpr std::size_t longest_window = 64;
constexpr std::size_t fewest_windows = 8;

}  // namespace

std::vector<Window> plan_windows(std::size_t total, std::size_t wanted) {
  if (wanted >= total) return {{0, total}};
  const std::size_t length = std::clamp<std::size_t>(wanted / fewest_windows, 1, longest_window);
  const std::size_t count = std::max<std::size_t>(wanted / length, 1);
  std::vector<Window> windows;
  for (std::size_t i = 0; i < count; ++i) {
    // The i-th of `count` equal parts of the way begins here; length * count <= total keeps them disjoint.
    const std::size_t begin = i * (total / count) + std::min(i, total % count);
    windows.push_back({begin, begin + length});
  }
  return windows;
}

std::vector<Window> joined(const std::vector<Window>& windows) {
  std::vector<Window> result;
  for (const Window& window : windows) {
    if (!result.empty() && result.back().end == window.begin) {
      result.back().end = window.end;
    } else {
      result.push_back(window);
    }
  }
  return result;
}

std::vector<Window> split(Window window, std::size_t parts) {
  parts = std::clamp<std::size_t>(parts, 1, std::max<std::size_t>(window.size(), 1));
  std::vector<Window> result;
  std::size_t begin = window.begin;
  for (std::size_t i = 1; i <= parts; ++i) {
    const std::size_t end = window.begin + window.size() * i / parts;
    result.push_back({begin, end});
    begin = end;
  }
  return result;
}

std::size_t steps_in(const std::vector<Window>& windows) noexcept {
  std::size_t steps = 0;
  for (const Window& window : windows) steps += window.size();
  return steps;
}

}  // namespace touchmark::bench

#include "bench/workload/sample_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/support/random.h"

namespace touchmark::bench::workload {
namespace {

/// As many blocks at least, cut shorter where that is more steps than are wanted.
constexpr std::size_t min_blocks = 16;
/// Blocks drawn of each phase that has as many: one tells nothing of how blocks differ.
constexpr std::size_t min_of_a_phase = 2;
constexpr double nearness = 0.02;  // diagonals
constexpr std::size_t telling_of_a_block = 3;

struct Drawn {
  double key;
  std::size_t block;
};

/// The blocks of one phase in random order, with keys spread evenly over [0, 1), or -1 for those that come
/// first.
void draw(std::vector<std::size_t> blocks, support::Random& random, std::vector<Drawn>& drawn) {
  random.shuffle(blocks);
  const double offset = random.unit();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double key = (static_cast<double>(i) + offset) / static_cast<double>(blocks.size());
    drawn.push_back({i < min_of_a_phase ? -1 : key, blocks[i]});
  }
}

Phase phase_at(double distance, double radius, double diagonal) noexcept {
  if (distance <= radius) return Phase::contact;
  return distance <= radius + nearness * diagonal ? Phase::near : Phase::free;
}

}  // namespace

SamplePlan::SamplePlan(std::size_t total, std::vector<Phase> phases, std::uint64_t seed)
    : total_(total), phases_(std::move(phases)) {
  std::array<std::vector<std::size_t>, phase_count> blocks;
  for (std::size_t block = 0; block < phases_.size(); ++block) {
    const auto phase = static_cast<std::size_t>(phases_[block]);
    blocks[phase].push_back(block);
    steps_[phase] += std::min(block_steps, total_ - block * block_steps);
  }
  support::Random random(seed);
  std::vector<Drawn> drawn;
  for (std::vector<std::size_t>& some : blocks) draw(std::move(some), random, drawn);
  std::ranges::stable_sort(drawn, [](const Drawn& a, const Drawn& b) { return a.key < b.key; });
  for (const Drawn& one : drawn) {
    order_.push_back(one.block);
    min_ += one.key < 0 ? 1 : 0;
  }
}

std::vector<StepRange> SamplePlan::ranges(std::size_t wanted) const {
  if (wanted >= total_) return {{0, total_}};
  const std::size_t length = std::clamp<std::size_t>(wanted / min_blocks, 1, block_steps);
  const std::size_t count = std::min(std::max(wanted / length, min_), order_.size());
  std::vector<StepRange> ranges;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = order_[i] * block_steps;
    ranges.push_back({begin, std::min(begin + length, total_)});
  }
  std::ranges::sort(ranges, [](StepRange a, StepRange b) { return a.begin < b.begin; });
  return ranges;
}

std::vector<std::size_t> telling_steps(std::size_t total) {
  std::vector<std::size_t> steps;
  for (std::size_t begin = 0; begin < total; begin += SamplePlan::block_steps) {
    const std::size_t last = std::min(begin + SamplePlan::block_steps, total) - 1;
    steps.insert(steps.end(), {begin, begin + (last - begin) / 2, last});
  }
  return steps;
}

std::vector<Phase> phases_of(std::span<const Step> steps, std::span<const double> telling_distances,
                             double diagonal) {
  const std::vector<std::size_t> telling = telling_steps(steps.size());
  std::vector<Phase> phases(SamplePlan::blocks_in(steps.size()), Phase::free);
  for (std::size_t i = 0; i < telling.size(); ++i) {
    Phase& phase = phases[i / telling_of_a_block];
    phase = std::min(phase, phase_at(telling_distances[i], steps[telling[i]].probe.radius, diagonal));
  }
  return phases;
}

}  // namespace touchmark::bench::workload

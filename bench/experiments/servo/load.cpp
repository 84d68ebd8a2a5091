#include "bench/experiments/servo/load.h"

#include <algorithm>
#include <array>

#include <sched.h>
#include <unistd.h>

#include "bench/support/names.h"
#include "bench/support/system/available_memory.h"

namespace touchmark::bench::experiments::servo {
namespace {

constexpr std::array<support::Name<Load>, 3> names{
    {{Load::none, "none"}, {Load::memory, "memory"}, {Load::cpu, "cpu"}}};
constexpr std::size_t words_a_line = 64 / sizeof(std::uint64_t);

void stay_on(int core) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<unsigned>(core), &cores);
  sched_setaffinity(0, sizeof cores, &cores);  // if refused, it runs anywhere
}

/// Reads and writes a word of every line.
void walk_over(std::vector<std::uint64_t>& words) {
  for (std::size_t i = 0; i < words.size(); i += words_a_line) words[i] += i;
}

void compute(std::uint64_t& state) {
  for (int i = 0; i < 100'000; ++i) state = state * 6364136223846793005ULL + 1442695040888963407ULL;
}

}  // namespace

std::string_view name_of(Load load) noexcept { return support::name_in(names, load); }

std::optional<Load> load_named(std::string_view name) noexcept {
  return support::value_in<Load>(names, name);
}

std::vector<int> other_cores(int own) {
  std::vector<int> cores;
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (core != own && CPU_ISSET(static_cast<std::size_t>(core), &allowed)) cores.push_back(core);
  }
  return cores;
}

std::size_t bytes_to_walk_over(std::size_t generators) {
  constexpr std::size_t least = 64UL << 20U;
  const long cache = sysconf(_SC_LEVEL3_CACHE_SIZE);
  std::size_t bytes = std::max(least, 4 * static_cast<std::size_t>(std::max(cache, 0L)));
  if (const auto available = support::available_memory())
    bytes = std::min(bytes, static_cast<std::size_t>(*available / 8 / std::max<std::size_t>(generators, 1)));
  return bytes;
}

LoadGenerators::LoadGenerators(Load load, const std::vector<int>& cores, std::size_t bytes) {
  if (load == Load::none) return;
  if (load == Load::memory) buffers_.resize(cores.size());
  for (std::vector<std::uint64_t>& buffer : buffers_) buffer.resize(bytes / sizeof(std::uint64_t));
  for (std::size_t i = 0; i < cores.size(); ++i) {
    threads_.emplace_back([this, load, core = cores[i], i](const std::stop_token& stop) {
      stay_on(core);
      std::uint64_t state = i;
      while (!stop.stop_requested()) {
        load == Load::memory ? walk_over(buffers_[i]) : compute(state);
        last_ = state;  // so that the arithmetic is not left out
        ++rounds_;
      }
    });
  }
}

}  // namespace touchmark::bench::experiments::servo

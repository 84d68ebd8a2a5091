#include "bench/support/system/available_memory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bench/support/failures.h"

namespace touchmark::bench::support {
namespace {

std::optional<std::uint64_t> free_memory() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string line; std::getline(meminfo, line);) {
    constexpr std::string_view label = "MemAvailable:";
    if (line.starts_with(label)) return std::strtoull(line.c_str() + label.size(), nullptr, 10) * 1024;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> room_within_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur - std::min<std::uint64_t>(address_space(), limit.rlim_cur);
}

}  // namespace

std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::optional<std::uint64_t> available_memory() {
  const std::optional<std::uint64_t> free = free_memory(), room = room_within_limit();
  if (!free || !room) return free ? free : room;
  return std::min(*free, *room);
}

void require_memory(std::string_view what, double bytes) {
  const std::optional<std::uint64_t> available = available_memory();
  if (!available || bytes <= static_cast<double>(*available)) return;
  constexpr double megabyte = 1 << 20;
  throw ResourceError(fmt::format("{} need about {:.0f} MB of memory, and {} MB are available", what,
                                  bytes / megabyte, *available >> 20U));
}

void require_memory_for_triangles(std::size_t count, double bytes_each) {
  require_memory(fmt::format("{} triangles at {} bytes each", count, bytes_each),
                 bytes_each * static_cast<double>(count));
}

}  // namespace touchmark::bench::support

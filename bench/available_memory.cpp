#include "bench/available_memory.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace touchmark::bench {

std::optional<std::uint64_t> available_memory() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string line; std::getline(meminfo, line);) {
    constexpr std::string_view label = "MemAvailable:";
    if (line.starts_with(label)) return std::strtoull(line.c_str() + label.size(), nullptr, 10) * 1024;
  }
  return std::nullopt;
}

}  // namespace touchmark::bench

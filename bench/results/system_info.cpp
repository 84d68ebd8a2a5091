#include "bench/results/system_info.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sched.h>

#include "bench/support/numbers.h"
#include "bench/workload/content_hash.h"

namespace touchmark::bench::results {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string governor() {
  std::ifstream file("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  std::string name;
  return std::getline(file, name) ? name : "unknown";
}

std::optional<cpu_set_t> allowed_cores() {
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) return std::nullopt;
  return cores;
}

}  // namespace

SystemInfo system_info() {
  SystemInfo info;
  info.cpu_model = cpu_model();
  const std::optional<cpu_set_t> cores = allowed_cores();
  info.cores = cores ? CPU_COUNT(&*cores) : 1;
  info.governor = governor();
  getloadavg(info.load_average.data(), static_cast<int>(info.load_average.size()));
  info.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return info;
}

std::string machine_fingerprint() {
  std::ifstream file("/etc/machine-id");
  std::string id;
  std::getline(file, id);
  const SystemInfo info = system_info();
  workload::ContentHash hash;
  hash.add(std::string_view("touchmark"));
  hash.add(std::string_view(id));
  hash.add(std::string_view(info.cpu_model));
  hash.add(static_cast<double>(info.cores));
  return support::hex(hash.value());
}

std::optional<int> core_for_workers() {
  const std::optional<cpu_set_t> cores = allowed_cores();
  if (!cores || CPU_COUNT(&*cores) < 2) return std::nullopt;
  for (int core = CPU_SETSIZE - 1; core >= 0; --core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &*cores)) return core;
  return std::nullopt;
}

std::string without_directories(const std::string& text) {
  const std::size_t equals = text.starts_with("--") ? text.find('=') : std::string::npos;
  const std::size_t value = equals == std::string::npos ? 0 : equals + 1;
  if (value >= text.size() || text[value] != '/') return text;
  const std::size_t end = text.find_last_not_of('/');
  if (end == std::string::npos || end < value) return text.substr(0, value) + "/";
  return text.substr(0, value) + text.substr(text.rfind('/', end) + 1);
}

}  // namespace touchmark::bench::results

#include "bench/experiments/servo/real_time_host.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "bench/support/numbers.h"

namespace touchmark::bench::experiments::servo {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> line_of(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!file) return std::nullopt;
  std::getline(file, line);
  return line;
}

/// True if "0,2-5" names the core.
bool names_core(const std::string& list, int core) {
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    char* after = nullptr;
    const long first = std::strtol(list.c_str() + begin, &after, 10);
    const long last = *after == '-' ? std::strtol(after + 1, nullptr, 10) : first;
    if (core >= first && core <= last) return true;
    begin = end + 1;
  }
  return false;
}

void read_idle_states(const std::string& folder, RealTimeHost& host) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  host.deepest_idle_state = "none";
  for (const fs::directory_entry& state : fs::directory_iterator(folder, error)) {
    const std::string path = state.path().string();
    if (line_of(path + "/disable").value_or("0") != "0") continue;
    const auto latency = support::parse_number(line_of(path + "/latency").value_or(""));
    if (!latency || (host.wake_up_us && *latency <= *host.wake_up_us)) continue;
    host.wake_up_us = latency;
    host.deepest_idle_state = line_of(path + "/name").value_or("unknown");
  }
}

std::optional<bool> is_preempt_rt(const std::string& root) {
  if (const auto flag = line_of(root + "/sys/kernel/realtime")) return *flag == "1";
  utsname kernel{};
  if (!root.empty() || uname(&kernel) != 0) return std::nullopt;
  return std::string(kernel.version).find("PREEMPT_RT") != std::string::npos;
}

/// "always [madvise] never" has the choice in brackets.
std::string chosen(const std::string& line) {
  const std::size_t begin = line.find('['), end = line.find(']');
  return begin < end && end != std::string::npos ? line.substr(begin + 1, end - begin - 1) : line;
}

}  // namespace

RealTimeHost read_real_time_host(int core, const std::string& root) {
  RealTimeHost host;
  const std::string all = root + "/sys/devices/system/cpu", own = all + fmt::format("/cpu{}", core);
  if (const auto governor = line_of(own + "/cpufreq/scaling_governor")) host.governor = *governor;
  read_idle_states(own + "/cpuidle", host);
  if (const auto siblings = line_of(own + "/topology/thread_siblings_list"))
    host.smt = siblings->find_first_of(",-") != std::string::npos;
  if (const auto isolated = line_of(all + "/isolated")) {
    host.isolated_cores = *isolated;
    host.core_is_isolated = names_core(*isolated, core);
  }
  host.preempt_rt = is_preempt_rt(root);
  if (const auto pages = line_of(root + "/sys/kernel/mm/transparent_hugepage/enabled"))
    host.huge_pages = chosen(*pages);
  const auto share = line_of(root + "/proc/sys/kernel/sched_rt_runtime_us");
  if (share && !share->empty()) host.real_time_share_us = std::strtol(share->c_str(), nullptr, 10);
  host.cpu_quota = support::cpu_quota(root);
  return host;
}

std::vector<std::string> warnings_about(const RealTimeHost& host) {
  std::vector<std::string> lines;
  if (host.governor != "performance" && host.governor != "unknown")
    lines.push_back(fmt::format("the governor is {}: the core changes its frequency (performance does not)",
                                host.governor));
  constexpr double deep_us = 10;
  if (host.wake_up_us && *host.wake_up_us > deep_us)
    lines.push_back(fmt::format(
        "the core sleeps as deep as {}, from where it takes {:g} us to wake up (/dev/cpu_dma_latency)",
        host.deepest_idle_state, *host.wake_up_us));
  if (host.smt.value_or(false)) lines.emplace_back("another hardware thread shares the core (SMT)");
  if (const auto& quota = host.cpu_quota)
    lines.push_back(
        fmt::format("a CPU quota is in force: {:g} of each {:g} ms of processor time, for all threads "
                    "together ({}); late ticks may come from it",
                    quota->quota_us / 1e3, quota->period_us / 1e3, quota->file));
  if (!host.core_is_isolated)
    lines.emplace_back("other processes may use the core (isolcpus keeps them off)");
  if (!host.preempt_rt.value_or(false)) lines.emplace_back("the kernel is not PREEMPT_RT");
  if (host.huge_pages == "always")
    lines.emplace_back("huge pages are put together in the background (transparent_hugepage: always)");
  return lines;
}

}  // namespace touchmark::bench::experiments::servo

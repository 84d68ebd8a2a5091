/// What a machine is set to that spoils real time or helps it, as far as it can be read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/support/system/cpu_quota.h"

namespace touchmark::bench::experiments::servo {

/// "unknown" where the system does not say.
struct RealTimeHost {
  std::string governor = "unknown";  ///< the core's, of frequency scaling
  std::string deepest_idle_state =
      "unknown";                           ///< the deepest that is switched on; "none" where there are none
  std::optional<double> wake_up_us;        ///< from that state, as the kernel has it
  std::optional<bool> smt;                 ///< another thread shares the core
  std::string isolated_cores = "unknown";  ///< isolcpus; empty: none
  bool core_is_isolated = false;
  std::optional<bool> preempt_rt;          ///< a kernel that can be interrupted nearly anywhere
  std::string huge_pages = "unknown";      ///< always, madvise or never
  std::optional<long> real_time_share_us;  ///< what real-time threads may have of each second; -1: all
  std::optional<support::CpuQuota> cpu_quota;
};

/// Reads below `root`, which is "" but for tests.
RealTimeHost read_real_time_host(int core, const std::string& root = "");

/// A line for each thing that makes ticks late, and what helps.
std::vector<std::string> warnings_about(const RealTimeHost& host);

}  // namespace touchmark::bench::experiments::servo

/// The processor time that a control group lets this process have: a container's limit, or a batch system's.
#pragma once

#include <optional>
#include <string>

namespace touchmark::bench::support {

/// In each period the group gets so much time, all its threads together. Then they wait for the next period.
struct CpuQuota {
  double quota_us = 0, period_us = 0;
  std::string file;  ///< that sets it

  double cores() const noexcept { return quota_us / period_us; }
};

/// Returns the smallest quota in force, of this process's group and the groups above it, by cpu.max (version
/// 2) and cpu.cfs_quota_us (version 1). Reads below `root`, which is "" but for tests.
std::optional<CpuQuota> cpu_quota(const std::string& root = "");

}  // namespace touchmark::bench::support

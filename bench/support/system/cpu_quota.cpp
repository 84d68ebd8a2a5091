#include "bench/support/system/cpu_quota.h"

#include <filesystem>
#include <fstream>

namespace touchmark::bench::support {
namespace {

/// "max 100000" has no quota, and so has -1 of version 1.
std::optional<CpuQuota> quota_in(const std::string& folder, bool unified) {
  CpuQuota quota{0, 100'000, folder + (unified ? "/cpu.max" : "/cpu.cfs_quota_us")};
  std::ifstream file(quota.file);
  if (!(file >> quota.quota_us) || quota.quota_us <= 0) return std::nullopt;
  std::ifstream period(folder + "/cpu.cfs_period_us");
  (unified ? file : period) >> quota.period_us;
  if (!(quota.period_us > 0)) return std::nullopt;
  return quota;
}

/// A container may see its own group as the mount's root, though /proc has the machine's path: a folder that
/// is not there is passed over.
void add_quotas(const std::string& mount, std::filesystem::path group, bool unified,
                std::optional<CpuQuota>& least) {
  for (;; group = group.parent_path()) {
    const bool is_root = !group.has_relative_path();
    const std::optional<CpuQuota> found = quota_in(is_root ? mount : mount + group.string(), unified);
    if (found && (!least || found->cores() < least->cores())) least = found;
    if (is_root) return;
  }
}

}  // namespace

std::optional<CpuQuota> cpu_quota(const std::string& root) {
  const std::string mounts = root + "/sys/fs/cgroup";
  std::optional<CpuQuota> least;
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "0::/path", or "4:cpu,cpuacct:/path" of version 1
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
    const std::filesystem::path group = line.substr(second + 1);
    if (controllers == ",,") {
      add_quotas(mounts, group, true, least);
      add_quotas(mounts + "/unified", group, true, least);
    } else if (controllers.find(",cpu,") != std::string::npos) {
      add_quotas(mounts + "/cpu", group, false, least);
    }
  }
  return least;
}

}  // namespace touchmark::bench::support

/// Quotas of processor time, read from made-up control groups.
#include "bench/support/system/cpu_quota.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace touchmark::bench::support {
namespace {

class CpuQuotaOf : public testing::Test {
 protected:
  void write(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(folder_.file(path)).parent_path());
    folder_.file(path, text + "\n");
  }
  double cores() const {
    const auto quota = cpu_quota(folder_.path());
    return quota ? quota->cores() : 0;
  }
  TemporaryFolder folder_;
};

TEST_F(CpuQuotaOf, NoGroupAtAllIsNone) { EXPECT_EQ(cores(), 0); }

TEST_F(CpuQuotaOf, MaxOrMinusOneIsNone) {
  write("proc/self/cgroup", "4:cpu,cpuacct:/job\n0::/job");
  write("sys/fs/cgroup/job/cpu.max", "max 100000");
  write("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "-1");
  EXPECT_EQ(cores(), 0);
}

TEST_F(CpuQuotaOf, TheOwnGroupAndTheOnesAboveTheSmallestCounts) {
  write("proc/self/cgroup", "0::/a.slice/job");
  write("sys/fs/cgroup/a.slice/job/cpu.max", "200000 100000");
  EXPECT_EQ(cores(), 2);
  write("sys/fs/cgroup/a.slice/cpu.max", "75000 50000");
  EXPECT_EQ(cores(), 1.5);
  EXPECT_TRUE(cpu_quota(folder_.path())->file.ends_with("/sys/fs/cgroup/a.slice/cpu.max"));
  write("sys/fs/cgroup/cpu.max", "50000 100000");
  EXPECT_EQ(cores(), 0.5);
  write("sys/fs/cgroup/elsewhere/cpu.max", "1000 100000");
  EXPECT_EQ(cores(), 0.5) << "another group's";
}

TEST_F(CpuQuotaOf, AContainerWithAMachinesPathHasTheRoots) {
  write("proc/self/cgroup", "0::/docker/0123/not/mounted/here");
  write("sys/fs/cgroup/cpu.max", "50000 100000");
  EXPECT_EQ(cores(), 0.5);
}

TEST_F(CpuQuotaOf, Version1AloneAndBesideVersion2) {
  write("proc/self/cgroup", "12:cpuset:/x\n4:cpu,cpuacct:/job\n0::/job");
  write("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "25000");
  write("sys/fs/cgroup/cpu/job/cpu.cfs_period_us", "50000");
  EXPECT_EQ(cores(), 0.5);
  write("sys/fs/cgroup/unified/job/cpu.max", "10000 100000");
  EXPECT_EQ(cores(), 0.1);
}

TEST_F(CpuQuotaOf, WhatIsNoNumberIsNone) {
  write("proc/self/cgroup", "nonsense\n0::/job\n1:cpu");
  write("sys/fs/cgroup/job/cpu.max", "");
  write("sys/fs/cgroup/cpu.max", "10000 0");
  EXPECT_EQ(cores(), 0);
}

}  // namespace
}  // namespace touchmark::bench::support

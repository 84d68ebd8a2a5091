// Several threads build on the cores that the program has, and what follows runs on the worker's core again.
#include "bench/workers/build_cores.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include "bench/contestants/built_in.h"

namespace touchmark::bench::workers {
namespace {

int cores_of(pid_t process) {
  cpu_set_t cores;
  return sched_getaffinity(process, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 0;
}

/// Keeps this process on one of its cores, as a worker is kept.
void stay_on_one_core() {
  cpu_set_t cores;
  ASSERT_EQ(sched_getaffinity(0, sizeof cores, &cores), 0);
  int core = 0;
  while (!CPU_ISSET(static_cast<unsigned>(core), &cores)) ++core;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<unsigned>(core), &cores);
  ASSERT_EQ(sched_setaffinity(0, sizeof cores, &cores), 0);
}

int cores_while_building(const char* contestant) {
  const BuildCores cores(contestants::roster().parse(contestant));
  return cores_of(0);
}

TEST(BuildCores, AreThoseOfTheProgramForSeveralThreadsAndOneForOne) {
  stay_on_one_core();
  ASSERT_EQ(cores_of(0), 1);
  EXPECT_EQ(cores_while_building("sphere-cluster:threads=2"), cores_of(getppid()));
  EXPECT_EQ(cores_of(0), 1);
  EXPECT_EQ(cores_while_building("grid-group:threads=0"), cores_of(getppid()));
  EXPECT_EQ(cores_of(0), 1);
  EXPECT_EQ(cores_while_building("sphere-cluster"), 1);
  EXPECT_EQ(cores_while_building("brute-force"), 1);
}

}  // namespace
}  // namespace touchmark::bench::workers

/// What a query must not do in a real-time thread: make a system call, or cause a page fault. Without system
/// calls there is no lock that waits, either.
#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/core/query_pass.h"
#include "tests/own_forms.h"

namespace touchmark {
namespace {

/// Runs it in a process that the kernel kills at any system call but read, write and exit. True if it lived.
template <class Action>
bool makes_no_system_call(const Action& action) {
  const pid_t child = fork();
  if (child == 0) {
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT) != 0) _exit(2);
    action();
    syscall(SYS_exit, 0);  // _exit would be exit_group
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << "the kernel has no seccomp";
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

long page_faults() {
  rusage used{};
  getrusage(RUSAGE_THREAD, &used);
  return used.ru_minflt + used.ru_majflt;
}

/// The least of a few passes: the kernel itself may take a page away now and then, a query would in each of
/// them.
template <class Action>
long min_page_faults(const Action& action) {
  long least = page_faults();
  for (int pass = 0; pass < 5; ++pass) {
    const long before = page_faults();
    action();
    least = std::min(least, page_faults() - before);
  }
  return least;
}

void expect_real_time(const bench::contestants::ContestantSpec& spec) {
  const auto detector = own_roster().build(spec, test::sheet(20));
  test::QueryPass pass;
  // From the first query on, with those that lazy construction makes.
  EXPECT_TRUE(makes_no_system_call([&] { pass.ask(*detector); })) << spec.text();
  EXPECT_GT(pass.ask(*detector), 199u) << spec.text();
  EXPECT_EQ(min_page_faults([&] { pass.ask(*detector); }), 0) << spec.text();
}

TEST(RealTime, ASystemCallWouldBeSeen) {
  EXPECT_TRUE(makes_no_system_call([] {}));
  EXPECT_FALSE(makes_no_system_call([] { syscall(SYS_getpid); }));
}

TEST(RealTime, APageFaultWouldBeSeen) {
  EXPECT_GE(min_page_faults([] {
              constexpr std::size_t page = 4096;
              void* fresh = mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
              *static_cast<volatile char*>(fresh) = 1;
              munmap(fresh, page);
            }),
            1);
}

TEST(RealTime, InAnyFormOfOurDetectors) {
  for (const bench::contestants::ContestantSpec& spec : own_forms()) expect_real_time(spec);
}

TEST(RealTime, WhereTheSideIsAsked) {
  for (const bench::contestants::ContestantSpec& spec : own_forms_with_side()) expect_real_time(spec);
}

}  // namespace
}  // namespace touchmark

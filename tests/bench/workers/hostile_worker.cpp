/// A worker program that has nothing but bad contestants.
#include <ctime>

#include <sys/syscall.h>
#include <unistd.h>

#include "bench/workers/worker.h"
#include "tests/bench/workers/hostile_roster.h"

// AddressSanitizer would turn the signals that the tests are about into an exit status of its own.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "handle_abort=0:handle_sigfpe=0:handle_segv=0"; }

/// Stands before libc's: this process has had so much of the processor as its contestants claim.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  if (clock != CLOCK_PROCESS_CPUTIME_ID) {
    return static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  }
  const std::int64_t ns = touchmark::bench::workers::hostile_ns();
  *time = {ns / 1'000'000'000, ns % 1'000'000'000};
  return 0;
}

int main(int argc, char** argv) {
  return touchmark::bench::workers::run_worker(argc, argv, touchmark::bench::workers::hostile_roster());
}

/// A worker program that has nothing but bad contestants.
#include "bench/worker.h"
#include "tests/bench/hostile_roster.h"

// AddressSanitizer would turn the signals that the tests are about into an exit status of its own.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "handle_abort=0:handle_sigfpe=0:handle_segv=0"; }

int main(int argc, char** argv) {
  return touchmark::bench::run_worker(argc, argv, touchmark::bench::hostile_roster());
}

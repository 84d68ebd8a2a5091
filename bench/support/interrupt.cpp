#include "bench/support/interrupt.h"

#include <csignal>

#include "bench/support/failures.h"

namespace touchmark::bench::support {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int /*signal*/) { interrupted = 1; }

}  // namespace

void watch_for_interrupts() {
  interrupted = 0;
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void check_for_interrupt() {
  if (interrupted != 0) throw Interrupted();
}

}  // namespace touchmark::bench::support

#include "bench/support/system/interrupt.h"

#include <atomic>
#include <csignal>

namespace touchmark::bench::support {
namespace {

volatile std::sig_atomic_t interrupted = 0;
std::atomic<Deadline> watched_deadline = Deadline::max();

void remember(int /*signal*/) { interrupted = 1; }

}  // namespace

void watch_for_interrupts(Deadline deadline) {
  interrupted = 0;
  watched_deadline = deadline;
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void check_for_interrupt() {
  if (interrupted != 0) throw Interrupted();
  if (Deadline::clock::now() >= watched_deadline.load()) throw OutOfTime();
}

}  // namespace touchmark::bench::support

/// Signals and deadlines, as a command asks for them between two requests.
#include "bench/support/system/interrupt.h"

#include <chrono>
#include <csignal>

#include <gtest/gtest.h>

namespace touchmark::bench::support {
namespace {

using namespace std::chrono_literals;

TEST(Interrupts, ADeadlineThatIsOverThrowsAndOneToComeDoesNot) {
  watch_for_interrupts(Deadline::clock::now() + 1h);
  EXPECT_NO_THROW(check_for_interrupt());
  watch_for_interrupts(Deadline::clock::now() - 1ns);
  EXPECT_THROW(check_for_interrupt(), OutOfTime);
  watch_for_interrupts();
  EXPECT_NO_THROW(check_for_interrupt());
}

TEST(Interrupts, ASignalIsNoDeadlineAlsoWhereBothCame) {
  watch_for_interrupts(Deadline::clock::now() - 1ns);
  std::raise(SIGINT);
  try {
    check_for_interrupt();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const OutOfTime&) {
    ADD_FAILURE() << "the signal came by hand, and ends the command";
  } catch (const Interrupted&) {
  }
}

}  // namespace
}  // namespace touchmark::bench::support

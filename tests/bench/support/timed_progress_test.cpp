/// What a command with a time limit says where stderr is no terminal.
#include "bench/support/timed_progress.h"

#include <chrono>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace touchmark::bench::support {
namespace {

using namespace std::chrono_literals;

std::string lines_of(std::chrono::milliseconds interval, std::chrono::milliseconds work) {
  testing::internal::CaptureStderr();
  {
    const auto start = TimedProgress::Clock::now();
    TimedProgress progress("choose", start, start + 90s, interval);
    progress.show("slide: some");
    std::this_thread::sleep_for(work);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(TimedProgress, PrintsALineInEachIntervalThatSaysWhatIsDoneAndHowLongItMayTake) {
  const std::string lines = lines_of(20ms, 200ms),
                    line = "touchmark: choose: slide: some; 0 s of at most 90 s\n";
  EXPECT_TRUE(lines.starts_with(line + line)) << lines;
}

TEST(TimedProgress, PrintsNothingBeforeTheFirstIntervalIsOverAndEndsAtOnce) {
  const auto start = TimedProgress::Clock::now();
  EXPECT_EQ(lines_of(60s, 0ms), "");
  EXPECT_LT(TimedProgress::Clock::now() - start, 30s);
}

}  // namespace
}  // namespace touchmark::bench::support

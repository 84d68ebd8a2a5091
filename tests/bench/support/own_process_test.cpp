#include "bench/support/system/own_process.h"

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/system/interrupt.h"

namespace touchmark::bench::support {
namespace {

using namespace std::chrono_literals;

constexpr ProcessLimits plenty{2'000'000'000, 30s};

void write_much(std::FILE* to) {
  for (int i = 0; i < 1'000'000; ++i) std::fputs("four", to);
}

std::string failure_of(const std::function<void(std::FILE*)>& work, const ProcessLimits& limits = plenty) {
  try {
    in_own_process(work, limits);
  } catch (const ProcessFailure& failure) {
    return failure.what();
  }
  return "none";
}

TEST(OwnProcess, GivesWhatTheWorkWrites) {
  EXPECT_EQ(in_own_process([](std::FILE*) {}, plenty), "");
  const std::optional<std::string> much = in_own_process(write_much, plenty);
  ASSERT_TRUE(much);
  EXPECT_EQ(much->size(), 4'000'000u);
}

TEST(OwnProcess, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  in_own_process(
      [](std::FILE*) {
        std::puts("to be read by nobody");
        std::fflush(stdout);
        std::fputs("nor this", stderr);
      },
      plenty);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(OwnProcess, SaysHowItEnded) {
  EXPECT_EQ(failure_of([](std::FILE*) { std::abort(); }), "crashed (Aborted)");
  EXPECT_EQ(failure_of([](std::FILE*) { std::raise(SIGKILL); }), "crashed (Killed)");
  EXPECT_EQ(failure_of([](std::FILE*) { std::_Exit(7); }), "ended with status 7");
  EXPECT_EQ(failure_of([](std::FILE*) { throw std::bad_alloc(); }), "needed more than 2.0 GB");
}

TEST(OwnProcess, IsEndedAfterItsTime) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(failure_of(
                [](std::FILE*) {
                  for (;;) std::this_thread::sleep_for(1s);
                },
                {plenty.bytes, 200ms}),
            "took more than 0.2 s");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 20s);
}

TEST(OwnProcess, HasSoMuchMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take address space of their own";
#endif
  const auto take = [](std::size_t bytes) {
    return [bytes](std::FILE* to) { std::fputc(std::vector<char>(bytes)[bytes / 2], to); };
  };
  const ProcessLimits limits{200'000'000, 30s};
  EXPECT_EQ(failure_of(take(100'000'000), limits), "none");
  EXPECT_EQ(failure_of(take(300'000'000), limits), "needed more than 0.2 GB");
}

TEST(OwnProcess, EndsWithAnInterrupt) {
  watch_for_interrupts();
  std::thread soon([] {
    std::this_thread::sleep_for(200ms);
    std::raise(SIGINT);
  });
  EXPECT_THROW(in_own_process([](std::FILE*) { std::this_thread::sleep_for(60s); }, plenty), Interrupted);
  soon.join();
  watch_for_interrupts();
}

}  // namespace
}  // namespace touchmark::bench::support

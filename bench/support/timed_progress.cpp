#include "bench/support/timed_progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace touchmark::bench::support {

using std::chrono::seconds;

TimedProgress::TimedProgress(std::string command, Clock::time_point start, Clock::time_point deadline,
                             std::chrono::milliseconds interval)
    : command_(std::move(command)),
      start_(start),
      deadline_(deadline),
      terminal_(isatty(STDERR_FILENO) != 0),
      interval_(terminal_ ? std::chrono::milliseconds(500) : interval),
      thread_([this](const std::stop_token& stop) { print_lines(stop); }) {}

TimedProgress::~TimedProgress() {
  thread_.request_stop();
  thread_.join();
  if (terminal_) std::fputs("\r\x1b[K", stderr);
}

void TimedProgress::show(std::string text) {
  const std::lock_guard lock(mutex_);
  text_ = std::move(text);
}

void TimedProgress::print_lines(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    stopped_.wait_for(lock, stop, interval_, [] { return false; });
    if (!stop.stop_requested()) std::fputs(line().c_str(), stderr);
  }
}

std::string TimedProgress::line() const {
  const Clock::time_point now = Clock::now();
  const auto in_seconds = [](Clock::duration time) {
    return std::chrono::duration_cast<std::chrono::seconds>(time).count();
  };
  if (terminal_) {
    const auto left = std::max<long>(in_seconds(deadline_ - now), 0);
    // Carriage return, text, erase what an earlier longer one left.
    return fmt::format("\r{:.78}\x1b[K",
                       fmt::format("at most {}:{:02} to go: {}", left / 60, left % 60, text_));
  }
  return fmt::format("touchmark: {}: {}; {} s of at most {} s\n", command_, text_, in_seconds(now - start_),
                     in_seconds(deadline_ - start_));
}

}  // namespace touchmark::bench::support

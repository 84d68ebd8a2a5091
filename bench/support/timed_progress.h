/// What a command with a time limit says on stderr while it works.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace touchmark::bench::support {

/// On a terminal one line with the time to go, renewed twice a second; elsewhere a line each ten seconds. A
/// thread of its own prints, so that a long step does not look like a hang.
class TimedProgress {
 public:
  using Clock = std::chrono::steady_clock;

  /// `interval` is between lines where stderr is no terminal.
  TimedProgress(std::string command, Clock::time_point start, Clock::time_point deadline,
                std::chrono::milliseconds interval = std::chrono::seconds(10));
  /// Ends the thread and erases a terminal's line.
  ~TimedProgress();
  TimedProgress(const TimedProgress&) = delete;
  TimedProgress& operator=(const TimedProgress&) = delete;

  /// What is being done from now on.
  void show(std::string text);

 private:
  void print_lines(const std::stop_token& stop);
  std::string line() const;

  std::string command_;
  Clock::time_point start_, deadline_;
  bool terminal_;
  std::chrono::milliseconds interval_;
  std::mutex mutex_;
  std::condition_variable_any stopped_;
  std::string text_ = "getting ready";
  std::jthread thread_;
};

}  // namespace touchmark::bench::support

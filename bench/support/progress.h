/// A line on stderr that says what is being done, when stderr is a terminal.
#pragma once

#include <chrono>
#include <string>

namespace touchmark::bench::support {

class ProgressLine {
 public:
  ProgressLine();
  /// Leaves no trace.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shown at most ten times a second.
  void show(const std::string& text);
  /// Before something else is printed.
  void clear();

 private:
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_{};
};

/// A line on stderr that stays, the first time it comes up: the same may come up for each mesh of many.
void note_once(const std::string& text);

}  // namespace touchmark::bench::support

/// Lines of text over a socket, with a deadline for reading.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace touchmark::bench::workers {

class LineChannel {
 public:
  explicit LineChannel(int descriptor) : descriptor_(descriptor) {}

  /// False when the other side is gone. `line` has no line end in it.
  bool send(std::string line) const;

  enum class Outcome { line, closed, late };
  /// Waits until `deadline`, or for ever. Calls `while_waiting` several times a second; it may throw.
  template <class WhileWaiting>
  Outcome receive(std::string& line, std::optional<std::chrono::steady_clock::time_point> deadline,
                  WhileWaiting while_waiting) {
    for (;;) {
      if (take_line(line)) return Outcome::line;
      if (deadline && std::chrono::steady_clock::now() >= *deadline) return Outcome::late;
      if (wait_for_bytes() && !read_some()) return Outcome::closed;
      while_waiting();
    }
  }

 private:
  bool take_line(std::string& line);
  bool wait_for_bytes() const;  // at most a tenth of a second
  bool read_some();             // false when the other side is gone

  int descriptor_;
  std::string received_;
};

}  // namespace touchmark::bench::workers

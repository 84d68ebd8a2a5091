#include "bench/support/progress.h"

#include <cstdio>
#include <set>

#include <fmt/format.h>
#include <unistd.h>

namespace touchmark::bench::support {

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  // Carriage return, text, erase what an earlier longer one left.
  std::fputs(fmt::format("\r{:.78}\x1b[K", text).c_str(), stderr);
  shown_ = true;
}

void note_once(const std::string& text) {
  static std::set<std::string> said;
  if (!said.insert(text).second) return;
  if (isatty(STDERR_FILENO) != 0) std::fputs("\r\x1b[K", stderr);  // a progress line may be there
  fmt::print(stderr, "touchmark: {}\n", text);
}

void ProgressLine::clear() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
  shown_ = false;
}

}  // namespace touchmark::bench::support

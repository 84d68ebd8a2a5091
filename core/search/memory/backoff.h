/// Puts off, each time for longer, what did not pay the last time.
#pragma once

#include <algorithm>

namespace touchmark {

/// `Max` is the largest number of times that it is put off.
template <class Count, Count Max>
struct Backoff {
  Count left = 0;  ///< times until the next try
  Count last = 0;  ///< times that it was put off for last

  /// Counts one time down. Returns false where it may be tried.
  bool waits() noexcept {
    if (left == 0) return false;
    --left;
    return true;
  }
  void failed() noexcept {
    last = static_cast<Count>(std::min<unsigned>(2U * last + 1, Max));
    left = last;
  }
  void paid() noexcept { last = 0; }
};

}  // namespace touchmark

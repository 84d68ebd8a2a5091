/// Tells what is remembered of one structure from what is remembered of all others.
#pragma once

#include <atomic>
#include <cstdint>

namespace touchmark {

/// A number that a structure draws when it is built and whenever it changes, and that its copies share.
/// Memory of another epoch is about something else, also where one structure took another's address.
class Epoch {
 public:
  /// Belongs to no structure.
  Epoch() = default;
  /// Returns an epoch that nothing else has.
  static Epoch next() noexcept {
    static std::atomic<std::uint64_t> last = 0;
    Epoch epoch;
    epoch.number_ = ++last;
    return epoch;
  }

  friend bool operator==(const Epoch&, const Epoch&) = default;

 private:
  std::uint64_t number_ = 0;
};

}  // namespace touchmark

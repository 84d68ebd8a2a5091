/// What timed passes may answer: what was verified, in a session's first pass and in those that follow it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "bench/workers/contestant_process.h"
#include "bench/workers/worker_protocol.h"
#include "core/detector.h"

namespace touchmark::bench::measurement {

/// The checksums of verified answers to a task.
struct VerifiedPasses {
  std::uint64_t first = 0;
  std::optional<std::uint64_t> second = {};  ///< the second pass's, where it differs and keeps its word

  bool hold(const workers::Timed& timed) const noexcept {
    return timed.steady && (timed.checksum == first || (second && timed.checksum == *second));
  }
};

/// The first pass was answered and judged just before. Whoever names any of several nearest triangles may
/// name another one after other steps, and a session that goes on begins where the pass before ended: so its
/// second pass is answered, too, and, where that comes to something else, judged. `keeps_word` judges what
/// lies in the output buffers.
inline VerifiedPasses verified_passes(workers::ContestantProcess& process, const workers::Task& task,
                                      std::uint64_t first, const Accuracy& accuracy,
                                      const std::function<bool()>& keeps_word) {
  VerifiedPasses verified{first};
  if (accuracy.names_exactly) return verified;
  const workers::Answered second = process.ask(workers::request::Answer{task, false});
  if (second.checksum != first && keeps_word()) verified.second = second.checksum;
  return verified;
}

}  // namespace touchmark::bench::measurement

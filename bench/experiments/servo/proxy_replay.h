/// What the ticks of a paced proxy came to: the same goals once more, every way judged by the exact oracle.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "bench/contestants/contestant.h"
#include "bench/contestants/guided_proxy.h"
#include "bench/proxies/tally.h"
#include "bench/proxies/way_oracle.h"
#include "bench/workers/timing/paced_replay.h"
#include "bench/workload/workload.h"
#include "core/haptics/coupling.h"

namespace touchmark::bench::experiments::servo {

/// A proxy's step depends on all goals before it, and ticks that were lost leave theirs out. So the goals of
/// the loop are gone through once it has run, by a proxy of the same detector in this process: its ways are
/// those of the loop where the checksums are the same.
class ProxyReplay {
 public:
  /// Over the first trace. `workload` must outlive it, and the contestant must guide proxies. The oracle is
  /// its own where bodies move.
  ProxyReplay(const workload::Workload& workload, std::shared_ptr<proxies::WayOracle> oracle,
              std::unique_ptr<contestants::Contestant> contestant, const Coupling& coupling,
              const Vec3& start);

  /// The loop's proxy was put at its start.
  void place();
  /// Returns false if a tick of the loop came to something else.
  bool follow(std::span<const workers::TickRecord> ticks);

  const proxies::Tally& tally() const noexcept { return tally_; }
  double work_mean() const noexcept;  ///< a tick's
  /// Returns what bounds a step; nothing where the contestant keeps to no bound.
  std::optional<std::uint64_t> max_work() const noexcept { return max_work_; }
  std::uint64_t work_max() const noexcept { return work_max_; }

 private:
  scenes::ScheduleView schedule_;
  workload::QueryTrace trace_;
  std::shared_ptr<proxies::WayOracle> oracle_;
  Coupling coupling_;
  contestants::GuidedProxy proxy_;
  proxies::Course course_;  ///< its goals are those of the last tick and of the one before
  proxies::Tally tally_;
  std::unique_ptr<proxies::Judge> judge_;
  proxies::Step step_;
  std::uint64_t work_max_ = 0;
  std::optional<std::uint64_t> max_work_;
};

}  // namespace touchmark::bench::experiments::servo

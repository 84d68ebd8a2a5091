/// Asks contestants in scenes of ever more bodies: what does a tick cost, what does placing bodies, and how
/// many bytes does a body take?
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/contestants/tick_clock.h"
#include "bench/experiments/scaling/body_question.h"
#include "bench/experiments/scaling/body_row.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::scaling {

class BodyRun {
 public:
  /// All in this process, one after the other: one that crashes ends the program.
  BodyRun(const contestants::Roster& roster, std::vector<contestants::ContestantSpec> contestants,
          std::size_t rounds);

  /// Rows of all contestants in a scene of so many bodies, in free space and beside a body, each timed in
  /// turns with the same contestant in a scene of one body. A contestant that took longer than the limit on a
  /// smaller scene is left out. Throws Interrupted, ResourceError.
  std::vector<BodyRow> run(std::size_t bodies, const std::string& motion, double limit_s,
                           const std::function<void(const std::string& contestant)>& progress);
  /// What was asked of the last scene, for run.json.
  const workload::Workload& workload() const { return workload_.value(); }

 private:
  struct World;
  struct Asked;
  struct Times;
  struct Rounds;

  BodyRow row_of(const contestants::ContestantSpec& spec, std::size_t bodies, const std::string& motion,
                 const BodyQuestion& question) const;
  void fill(BodyRow& row, const Asked& asked, const Asked& one, std::vector<workload::Answer>& right);
  /// Times rounds in turns with rounds of one body. Prepared: the contestants prepare after each frame,
  /// before the ticks.
  Rounds time_rounds(const Asked& asked, const Asked& one, bool prepared);
  Times time_round(contestants::Contestant& contestant, const BodyQuestion& question, bool prepared);

  const contestants::Roster& roster_;
  std::vector<contestants::ContestantSpec> contestants_;
  std::size_t rounds_;
  contestants::ClockCalibration clock_ = contestants::calibrate_clock();
  std::map<std::string, std::string> left_out_;  ///< why, by contestant and motion
  std::optional<workload::Workload> workload_;
};

}  // namespace touchmark::bench::experiments::scaling

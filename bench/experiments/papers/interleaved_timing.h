/// Times several detectors fairly against each other: the same steps, turn by turn in random order, in one
/// process, the median of the rounds, in processor time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/contestants/tick_clock.h"

namespace touchmark::bench::experiments::papers {

struct TimingEffort {
  std::size_t rounds = 5;
  double min_turn_ns = 10e6;  ///< a turn replays the trace until it has lasted so long
};

/// What a detector did on the trace, turn by turn.
struct TimedTurns {
  double ns = 0;  ///< per query, median over the rounds; 0 before the first
  /// What 99 of 100 queries are done in, each step's median over the rounds; nothing before the first. At
  /// least the clock's own cost: it cannot tell shorter queries apart.
  std::optional<double> ns_p99 = {};
  double work = 0;            ///< groups, spheres, boxes and triangles looked at per query
  std::size_t contacts = 0;   ///< steps that found one
  std::uint64_t answers = 0;  ///< a checksum: detectors that answer alike have the same
};

class InterleavedTiming {
 public:
  /// The steps must outlive it and be at least one.
  InterleavedTiming(std::span<const workload::Step> steps, workload::Query query, std::uint64_t seed);

  /// Takes the detector in and answers the trace once, untimed. The number by which timed() knows it.
  std::size_t add(std::unique_ptr<contestants::Contestant> contestant);
  /// Does the same with steps of the detector's own, which must outlive this and be at least one.
  std::size_t add(std::unique_ptr<contestants::Contestant> contestant, std::span<const workload::Step> steps);

  /// May throw Interrupted; the finished turns count nevertheless. `progress` is called before each turn with
  /// the round, from 0, and the detector's number.
  void run(const TimingEffort& effort,
           const std::function<void(std::size_t round, std::size_t detector)>& progress);

  TimedTurns timed(std::size_t detector) const;

 private:
  struct Entry {
    std::unique_ptr<contestants::Contestant> contestant;
    workload::QueryTrace trace;
    TimedTurns timed;
    std::int64_t passes = 0;                   ///< in a turn; 0: not known yet
    std::vector<double> turn_ns;               ///< per query, one a round
    std::vector<std::vector<double>> step_ns;  ///< by round and step
  };
  void answer_once(Entry& entry) const;
  void turn(Entry& entry, double min_turn_ns) const;
  void clock_steps(Entry& entry) const;

  workload::QueryTrace trace_;
  contestants::ClockCalibration clock_ = contestants::calibrate_clock();
  std::uint64_t seed_;
  std::vector<Entry> entries_;
};

}  // namespace touchmark::bench::experiments::papers

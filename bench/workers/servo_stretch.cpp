#include "bench/workers/servo_stretch.h"

#include <algorithm>

#include <sys/resource.h>

#include "bench/workers/real_time.h"

namespace touchmark::bench::workers {
namespace {

/// The kernel ends a query that takes so long of the core without a sleep.
constexpr double watchdog_s = 3;

rusage used_by_this_thread() {
  rusage used{};
  getrusage(RUSAGE_THREAD, &used);
  return used;
}

std::uint64_t more(long before, long after) { return static_cast<std::uint64_t>(after - before); }

}  // namespace

ServoStretch run_servo(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                       const request::Servo& request, const OutputBuffers& buffers) {
  static const std::string memory = lock_memory();
  const std::span<TickRecord> records = buffers.tick_records(std::max(request.warm_up, request.ticks));
  std::fill(records.begin(), records.end(), TickRecord{});  // no page fault inside the loop
  MonotonicClock clock;
  const auto run = [&](PacedReplay& replay) {
    if (request.idle) return run_idle(replay);
    contestant.replay_paced(trace, replay);
  };
  ServoStretch stretch;
  stretch.memory = memory;
  const RealTimeScope scope(watchdog_s);
  stretch.scheduler = scope.scheduler();
  Pace pace = request.pace;
  PacedReplay warm_up(pace, trace.steps.size(), clock, records.first(request.warm_up));
  run(warm_up);
  pace.first_tick += request.warm_up;
  const rusage before = used_by_this_thread();
  PacedReplay replay(pace, trace.steps.size(), clock, records.first(request.ticks));
  run(replay);
  const rusage after = used_by_this_thread();
  stretch.recorded = replay.recorded();
  stretch.overrun = replay.overrun();
  stretch.minor_faults = more(before.ru_minflt, after.ru_minflt);
  stretch.major_faults = more(before.ru_majflt, after.ru_majflt);
  stretch.involuntary_switches = more(before.ru_nivcsw, after.ru_nivcsw);
  return stretch;
}

}  // namespace touchmark::bench::workers

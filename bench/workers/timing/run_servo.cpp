#include "bench/workers/timing/run_servo.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>

#include <sys/resource.h>

#include "bench/contestants/tick_clock.h"
#include "bench/workers/timing/real_time.h"

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

void step_paced(contestants::GuidedProxy& proxy, const workload::QueryTrace& trace,
                PacedReplay& pacer) noexcept {
  Work seen = proxy.work();
  while (const std::optional<std::size_t> step = pacer.next()) {
    proxy.get_ready(trace, *step);
    if (proxy.prepares()) seen = proxy.work();
    const Vec3 goal = trace.steps[*step].probe.center;    // which has just been read from the device
    std::atomic_signal_fence(std::memory_order_seq_cst);  // read, and not later
    const std::uint64_t before = contestants::TickClock::now();
    const ProxyState& state = proxy.step(goal);
    const std::uint64_t after = contestants::TickClock::now();
    const Work now = proxy.work();
    pacer.took_step(
        after - before, [&] { return contestants::checksum_of(state); },
        contestants::work_between(seen, now));
    seen = now;
  }
}

ServoStretch run_servo(contestants::Contestant& contestant, std::optional<contestants::GuidedProxy>& proxy,
                       const std::function<std::optional<TriangleMesh>()>& mesh,
                       const workload::QueryTrace& trace, const request::Servo& request,
                       const OutputBuffers& buffers, std::span<const std::byte> memory) {
  ServoStretch stretch;
  if (request.proxy.wanted && !request.idle && !proxy) {
    proxy.emplace(contestant.share(), mesh(), request.proxy.coupling);
    proxy->place(Vec3(request.proxy.start.data()));
    stretch.placed = true;
  }
  static const std::string locked = lock_memory();
  const std::span<TickRecord> records = buffers.tick_records(request.warm_up + request.ticks);
  std::ranges::fill(records, TickRecord{});  // no page fault inside the loop
  EvictionBuffer buffer(memory.first(request.evicted_bytes));
  EvictionBuffer* const eviction = request.evicted_bytes > 0 ? &buffer : nullptr;
  MonotonicClock clock;
  const Accuracy accuracy = contestant.accuracy();
  const auto run = [&](PacedReplay& replay) {
    if (request.idle) return run_idle(replay);
    if (request.proxy.wanted) return step_paced(*proxy, trace, replay);
    contestant.replay_paced(trace, replay);
  };
  stretch.memory = locked;
  const RealTimeScope scope(watchdog_s);
  stretch.scheduler = scope.scheduler();
  Pace pace = request.pace;
  PacedReplay warm_up(pace, trace.steps.size(), clock, records.first(request.warm_up), accuracy, eviction);
  run(warm_up);
  stretch.warmed = warm_up.recorded();
  pace.first_tick += request.warm_up;
  const rusage before = used_by_this_thread();
  PacedReplay replay(pace, trace.steps.size(), clock, records.subspan(request.warm_up), accuracy, eviction);
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

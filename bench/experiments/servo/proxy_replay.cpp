#include "bench/experiments/servo/proxy_replay.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/proxies/certified.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::experiments::servo {
namespace {

const std::vector<Vec3> unknown_optima;

}  // namespace

ProxyReplay::ProxyReplay(const workload::Workload& workload, std::shared_ptr<proxies::WayOracle> oracle,
                         std::unique_ptr<contestants::Contestant> contestant, const Coupling& coupling,
                         const Vec3& start)
    : schedule_(workload.scene ? workload.schedules.front().view() : scenes::ScheduleView()),
      trace_{workload::Query::nearest, workload.traces.front(), workload.scene ? &schedule_ : nullptr},
      oracle_(std::move(oracle)),
      coupling_(coupling),
      proxy_(std::move(contestant), workload.scene ? std::nullopt : std::optional(workload.mesh), coupling),
      course_{"", workload.mesh, coupling.radius, 0, start, {}} {
  if (coupling.max_work > 0 && proxy_.limit_work(coupling.max_work)) max_work_ = coupling.max_work;
}

void ProxyReplay::place() {
  proxy_.place(course_.start);
  course_.goals.clear();
  judge_ = std::make_unique<proxies::Judge>(course_, unknown_optima, coupling_, tally_);
  judge_->see(*oracle_);
}

bool ProxyReplay::follow(std::span<const workers::TickRecord> ticks) {
  bool same = true;
  for (const workers::TickRecord& tick : ticks) {
    if (tick.asked == 0) continue;
    support::check_for_interrupt();
    const Vec3& goal = trace_.steps[tick.step].probe.center;
    proxy_.get_ready(trace_, tick.step);
    if (trace_.schedule != nullptr) judge_->see(*oracle_, [&] { oracle_->stand_at(tick.step); });
    const std::uint64_t before = proxy_.work().total();
    const ProxyState& state = proxy_.step(goal);
    const std::uint64_t work = proxy_.work().total() - before;
    tally_.work += work;
    work_max_ = std::max(work_max_, work);
    same = same && contestants::checksum_of(state) == tick.checksum;
    proxies::take(state, step_);
    if (course_.goals.size() == 2) course_.goals.erase(course_.goals.begin());
    course_.goals.push_back(goal);
    judge_->tick(course_.goals.size() - 1, step_);
  }
  return same;
}

double ProxyReplay::work_mean() const noexcept {
  return tally_.ticks > 0 ? static_cast<double>(tally_.work) / static_cast<double>(tally_.ticks) : 0;
}

}  // namespace touchmark::bench::experiments::servo

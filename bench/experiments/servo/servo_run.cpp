#include "bench/experiments/servo/servo_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/ground_truth/workload_truths.h"
#include "bench/measurement/result_row.h"
#include "bench/support/random.h"
#include "bench/workers/timing/eviction.h"

namespace touchmark::bench::experiments::servo {
namespace {

/// After others had the core: as many as a short stretch has, but no more than 16 ms.
constexpr std::size_t min_stretch = 16;
constexpr double warm_up_s = 0.016;

std::vector<Vec3> goals_of(const workload::Workload& workload) {
  std::vector<Vec3> goals;
  for (const workload::Step& step : workload.traces.front()) goals.push_back(step.probe.center);
  return goals;
}

}  // namespace

std::uint64_t ticks_a_stretch(const ServoSettings& settings) {
  const auto tenth = static_cast<std::uint64_t>(std::ceil(settings.rate_hz / 10));
  return std::min(std::max<std::uint64_t>(tenth, min_stretch), settings.ticks);
}

namespace {

/// Returns how many ticks' room a stretch takes, and the memory that is walked over to empty the caches.
std::size_t room_for(const ServoSettings& settings) {
  const std::size_t ticks = ticks_a_stretch(settings) + min_stretch;
  if (!settings.evicts) return ticks;
  return std::max(ticks, workers::steps_to_evict_all());
}

}  // namespace

ServoRun::ServoRun(const contestants::Roster& roster, const workload::Workload& workload,
                   workload::Query query, const std::vector<contestants::ContestantSpec>& contestants,
                   const ServoSettings& settings, const workers::WorkerOptions& workers)
    : workload_(workload),
      roster_(roster),
      query_(query),
      settings_(settings),
      arena_(workload, workers, room_for(settings)),
      checksums_(contestants.size()),
      next_tick_(contestants.size()),
      replays_(contestants.size()) {
  for (const contestants::ContestantSpec& spec : contestants) {
    processes_.emplace_back(arena_, spec, roster.find(spec.name).worker_program(spec.values));
    ServoRow& row = rows_.emplace_back();
    row.detector = spec.name;
    row.options = spec.options;
    row.mesh = workload.mesh_name;
    row.triangles = workload.triangles();
    row.trajectory = workload.trajectories.front();
    row.query = query;
    row.steps = workload.traces.front().size();
    row.radius = workload.radius;
    row.reach = workload.reach.value_or(workload.radius);
  }
}

template <class Action>
void ServoRun::attempt(std::size_t contestant, Action action) {
  if (rows_[contestant].status != "ok") return;
  try {
    action();
  } catch (const workers::WorkerFailure& failure) {
    const std::string_view what = failure.what();
    // The kernel's watchdog: see RealTimeScope.
    rows_[contestant].status = what == "crashed:SIGXCPU" ? overrun : what;
  }
}

void ServoRun::verify(std::size_t contestant, ground_truth::TraceTruths& truths) {
  ServoRow& row = rows_[contestant];
  workers::ContestantProcess& process = processes_[contestant];
  const workers::Built& built = process.build();
  row.accuracy = built.accuracy;
  if (std::find(built.queries.begin(), built.queries.end(), query_) == built.queries.end()) {
    row.status = "unsupported";
    return;
  }
  const workers::Answered answered = process.ask(workers::request::Answer{task()});
  const std::span<const workload::Answer> answers = arena_.buffers().answers(row.steps);
  const measurement::WorkResult work =
      measurement::summarize_work(arena_.buffers().work(row.steps), answered.work);
  row.work_mean = work.mean;
  row.work_max = work.max;
  for (const workload::Answer& answer : answers)
    checksums_[contestant].push_back(workers::tick_checksum(answer, *row.accuracy));
  row.counts = truths.judge(query_, {{0, row.steps}}, answers, *row.accuracy);
}

void ServoRun::begin_proxies(const std::function<void(const std::string&)>& progress) {
  std::optional<scenes::PlacedScene> scene;
  if (workload_.scene) scene = scenes::placed(*workload_.scene);
  const auto new_oracle = [&] {
    return scene ? std::make_shared<proxies::WayOracle>(*scene, workload_.schedules.front().view())
                 : std::make_shared<proxies::WayOracle>(workload_.mesh);
  };
  const std::shared_ptr<proxies::WayOracle> oracle = new_oracle();
  start_ = proxies::free_start(*oracle, goals_of(workload_), settings_.proxy->radius);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    progress(rows_[i].contestant());
    attempt(i, [&] {
      rows_[i].accuracy = processes_[i].build().accuracy;
      std::unique_ptr<contestants::Contestant> contestant;
      if (processes_[i].spec().plugin.empty())
        contestant = scene ? roster_.build(processes_[i].spec(), *scene)
                           : roster_.build(processes_[i].spec(), workload_.mesh);
      if (contestant == nullptr || !contestant->guides_proxy())
        rows_[i].status = "unsupported";
      else
        replays_[i] = std::make_unique<ProxyReplay>(workload_, scene ? new_oracle() : oracle,
                                                    std::move(contestant), *settings_.proxy, start_);
    });
  }
}

void ServoRun::verify(const std::function<void(const std::string&)>& progress) {
  if (settings_.proxy) return begin_proxies(progress);
  ground_truth::WorkloadTruths workload_truths(workload_);
  const std::unique_ptr<ground_truth::TraceTruths> truths = workload_truths.of(0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    progress(rows_[i].contestant());
    attempt(i, [&] { verify(i, *truths); });
  }
}

void ServoRun::run_stretch(std::size_t contestant, bool idle, std::uint64_t ticks) {
  ServoRow& row = rows_[contestant];
  workers::request::Servo request;
  request.task = task();
  request.pace = {settings_.rate_hz, settings_.slowdown(), settings_.work_us, next_tick_[contestant]};
  if (settings_.evicts) request.evicted_bytes = workers::eviction_sizes().all;
  request.warm_up = std::min(min_stretch, static_cast<std::size_t>(std::ceil(warm_up_s * settings_.rate_hz)));
  request.ticks = ticks;
  request.idle = idle;
  if (settings_.proxy) request.proxy = {true, *settings_.proxy, {start_.x(), start_.y(), start_.z()}};
  const workers::ServoStretch stretch = processes_[contestant].ask(request);
  std::optional<LoopResult>& result = idle ? row.idle : row.loop;
  if (!result) result = LoopResult{TickTally(settings_.rate_hz, processes_[contestant].opened().ns_per_tick)};
  const std::span<const workers::TickRecord> records =
      arena_.buffers().tick_records(request.warm_up + stretch.recorded).subspan(request.warm_up);
  result->tally.add(records);
  result->minor_faults += stretch.minor_faults;
  result->major_faults += stretch.major_faults;
  result->involuntary_switches += stretch.involuntary_switches;
  row.scheduler = stretch.scheduler;
  row.memory = stretch.memory;
  result->overrun = stretch.overrun;
  if (stretch.overrun) row.status = overrun;
  if (idle) return;
  next_tick_[contestant] += request.warm_up + ticks;
  if (settings_.proxy)
    judge_proxy(contestant, stretch, request.warm_up);
  else
    compare_answers(contestant, records);
}

void ServoRun::compare_answers(std::size_t contestant, std::span<const workers::TickRecord> records) {
  const std::vector<std::uint64_t>& verified = checksums_[contestant];
  if (std::any_of(records.begin(), records.end(), [&](const workers::TickRecord& record) {
        return record.asked != 0 && record.checksum != verified[record.step];
      }))
    rows_[contestant].status = "checksum mismatch";
}

void ServoRun::judge_proxy(std::size_t contestant, const workers::ServoStretch& stretch,
                           std::size_t warm_up) {
  ServoRow& row = rows_[contestant];
  ProxyReplay& replay = *replays_[contestant];
  if (stretch.placed) replay.place();
  const auto records = arena_.buffers().tick_records(warm_up + stretch.recorded);
  const bool same = replay.follow(records.first(stretch.warmed)) && replay.follow(records.subspan(warm_up));
  const proxies::Tally& tally = replay.tally();
  row.proxy = {tally.ticks,       tally.crossings,   tally.violations, tally.contact_ticks,
               tally.stuck_ticks, replay.max_work(), tally.unfinished};
  row.work_mean = replay.work_mean();
  row.work_max = replay.work_max();
  if (!same) row.status = "checksum mismatch";
}

void ServoRun::take_turns(const std::vector<std::pair<std::size_t, bool>>& turns, std::uint64_t ticks) {
  std::vector<Misses> before;
  for (const ServoRow& row : rows_) before.push_back(row.misses());
  for (const auto& [contestant, idle] : turns)
    attempt(contestant, [&, who = contestant, nothing = idle] { run_stretch(who, nothing, ticks); });
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Misses now = rows_[i].misses();
    if (now.ticks == before[i].ticks || now.idle_ticks == before[i].idle_ticks) continue;
    const std::uint64_t missed = now.missed - before[i].missed;
    const std::uint64_t idle_missed = now.idle_missed - before[i].idle_missed;
    rows_[i].worse += missed > idle_missed ? 1 : 0;
    rows_[i].idle_worse += idle_missed > missed ? 1 : 0;
  }
}

/// Gives the other loop further turns where one was ended: these tell whose fault it is.
void ServoRun::find_cause_of_overrun(std::size_t contestant, std::uint64_t ticks) {
  constexpr int further_turns = 3;
  ServoRow& row = rows_[contestant];
  const auto ended = [](const std::optional<LoopResult>& loop) { return loop && loop->overrun; };
  const bool idle_ended = ended(row.idle);
  for (int turn = 0; turn < further_turns && !ended(idle_ended ? row.loop : row.idle); ++turn) {
    row.status = "ok";
    attempt(contestant, [&] { run_stretch(contestant, !idle_ended, ticks); });
    if (row.status == "ok") row.status = overrun;
  }
}

void ServoRun::run(const std::function<void(std::uint64_t)>& progress) {
  support::Random random(settings_.seed);
  const std::vector<int> others = other_cores(arena_.options().core.value_or(0));
  const LoadGenerators load(settings_.load, others, bytes_to_walk_over(others.size()));
  const std::uint64_t stretch = ticks_a_stretch(settings_);
  std::vector<std::pair<std::size_t, bool>> turns;  // contestant, and whether nothing is asked
  for (std::size_t i = 0; i < rows_.size(); ++i) turns.insert(turns.end(), {{i, false}, {i, true}});
  for (std::uint64_t done = 0; done < settings_.ticks; done += stretch) {
    progress(done);
    random.shuffle(turns);
    take_turns(turns, std::min(stretch, settings_.ticks - done));
  }
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].status == overrun) find_cause_of_overrun(i, stretch);
}

}  // namespace touchmark::bench::experiments::servo

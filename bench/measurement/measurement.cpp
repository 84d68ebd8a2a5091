#include "bench/measurement/measurement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "bench/support/median.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::measurement {

namespace request = workers::request;

namespace {

constexpr std::uint64_t bootstrap_seed = 1;

double median_absolute_deviation(std::vector<double> values) {
  const double center = support::median(values);
  for (double& value : values) value = std::abs(value - center);
  return support::median(values);
}

template <class Length>
double largest(const std::vector<workload::Step>& trace, const Length& length_of) {
  double most = 0;
  for (const workload::Step& step : trace) most = std::max(most, length_of(step));
  return most;
}

}  // namespace

Measurement::Measurement(const workload::Workload& workload, const workers::SharedArena& arena,
                         const Effort& effort, workers::ContestantProcess& process, std::size_t trace,
                         workload::Query query, const workload::SamplePlan& plan)
    : arena_(arena),
      effort_(effort),
      process_(process),
      busy_before_s_(process.busy_s()),
      task_{trace, query, 1},
      plan_(plan) {
  row_.detector = process.spec().name;
  row_.options = process.spec().options;
  row_.plugin = process.spec().plugin;
  row_.claimed = process.spec().claimed;
  row_.mesh = workload.mesh_name;
  row_.triangles = workload.triangles();
  row_.trajectory = workload.trajectories[trace];
  row_.query = query;
  row_.radius = largest(workload.traces[trace], [](const workload::Step& step) { return step.probe.radius; });
  row_.reach = largest(workload.traces[trace], [](const workload::Step& step) { return step.reach; });
}

void Measurement::begin() {
  const workers::Built& built = process_.build();
  row_.accuracy = built.accuracy;
  row_.build_ms = built.build_ms;
  row_.bytes = built.bytes;
  row_.heap_bytes = built.heap_bytes;
  if (std::ranges::find(built.queries, task_.query) == built.queries.end()) {
    row_.status = "unsupported";
    return;
  }
  process_.rebuild_if_lazy();
  row_.first_answer_ms = built.build_ms + process_.ask(request::First{task_}).ns_per_query / 1e6;
}

void Measurement::calibrate() {
  attempt([&] {
    begin();
    if (!alive()) return;
    choose_steps();
    choose_pieces();
  });
}

void Measurement::calibrate_like(const Measurement& other) {
  attempt([&] {
    begin();
    task_ = other.task_;
    ranges_ = other.ranges_;
    row_.steps = other.row_.steps;
    passes_ = other.passes_;
    replays_ = other.replays_;
  });
}

/// On larger and larger beginnings of the sample, until a quarter of the budget is spent.
void Measurement::choose_steps() {
  for (std::size_t wanted = 16;; wanted *= 4) {
    workers::Task task = task_;
    task.ranges = plan_.ranges(wanted);
    calibrated_ns_ = std::max(process_.ask(request::Calibrate{task, 0}).ns_per_query, 1.0);
    const double elapsed = calibrated_ns_ * static_cast<double>(workload::steps_in(task.ranges));
    if (elapsed * 4 >= effort_.pass_budget_ns || wanted >= plan_.total()) return;
  }
}

/// All steps in pieces that other processes interrupt seldom, or blocks of the sample, which are short as
/// well. The sample's size is rounded down to a power of two, so that two runs mostly have the same.
void Measurement::choose_pieces() {
  constexpr double piece_ns = 0.5e6;  // far below what a scheduler gives to a process at a time
  constexpr double max_pieces = 128;
  const double affordable = effort_.pass_budget_ns / calibrated_ns_;
  const bool all = affordable >= static_cast<double>(plan_.total());
  const auto wanted = all ? plan_.total() : std::bit_floor(static_cast<std::size_t>(affordable));
  task_.ranges = plan_.ranges(wanted);
  ranges_ = workload::joined(task_.ranges);
  row_.steps = task_.steps = workload::steps_in(ranges_);
  const double pass_ns = calibrated_ns_ * static_cast<double>(row_.steps);
  if (all) {
    const double parts = std::clamp(pass_ns / piece_ns, 1.0, max_pieces);
    task_.ranges = workload::split({0, plan_.total()}, static_cast<std::size_t>(parts));
    const double sample_ns = std::min(piece_ns, effort_.repetition_ns);
    if (task_.ranges.size() == 1) replays_ = static_cast<std::int64_t>(std::max(sample_ns / pass_ns, 1.0));
  }
  const double passes = effort_.repetition_ns / (pass_ns * static_cast<double>(replays_));
  passes_ = static_cast<std::int64_t>(std::max(passes, 1.0));
}

PieceTimes Measurement::piece_times() const {
  std::vector<Piece> pieces;
  std::array<std::size_t, workload::phase_count> timed{};
  const bool all = row_.steps == plan_.total();
  for (const workload::StepRange& range : task_.ranges) {
    const std::size_t stratum = all ? 0 : static_cast<std::size_t>(plan_.phase_of(range));
    pieces.push_back({range.size(), stratum});
    timed[stratum] += range.size();
  }
  std::vector<Stratum> strata{{1, 0}};
  if (!all) strata.clear();
  for (std::size_t i = 0; i < workload::phase_count && !all; ++i) {
    const auto steps = static_cast<double>(plan_.steps_of(static_cast<workload::Phase>(i)));
    const double untimed = steps > 0 ? 1 - static_cast<double>(timed[i]) / steps : 0;
    strata.push_back({steps / static_cast<double>(plan_.total()), untimed});
  }
  PieceTimes times(std::move(pieces), std::move(strata));
  for (const std::vector<double>& ns : samples_) times.add_round(ns);
  return times;
}

void Measurement::verify(ground_truth::TraceTruths& truths, ground_truth::TraceTruths* rounded) {
  attempt([&] {
    process_.rebuild_if_lazy();
    const workers::Answered answered = process_.ask(request::Answer{task_});
    row_.checksum = answered.checksum;
    row_.work = summarize_work(arena_.buffers().work(row_.steps), answered.work);
  });
  if (alive()) judge(truths, rounded);
  if (alive()) verified_.first = *row_.checksum;
  if (alive() && effort_.repetitions > 0) judge_second_pass(truths);
}

BracketSummary summarize_brackets(std::span<const workload::Answer> answers, double diagonal) {
  BracketSummary summary;
  std::vector<double> widths;
  for (const workload::Answer& answer : answers) {
    const bool unfinished = answer.unfinished != 0;
    summary.unfinished += unfinished ? 1 : 0;
    widths.push_back(unfinished ? (answer.distance - answer.fraction) / diagonal : 0);
  }
  if (summary.unfinished == 0) return summary;
  summary.p50 = support::median(widths);
  summary.max = *std::ranges::max_element(widths);
  return summary;
}

void Measurement::judge_second_pass(ground_truth::TraceTruths& truths) {
  attempt([&] {
    verified_ = verified_passes(process_, task_, *row_.checksum, *row_.accuracy, [&] {
      const std::span<const workload::Answer> answers = arena_.buffers().answers(row_.steps);
      return oracle::meets_guarantee(truths.judge(task_.query, ranges_, answers, *row_.accuracy),
                                     *row_.accuracy);
    });
  });
}

void Measurement::judge(ground_truth::TraceTruths& truths, ground_truth::TraceTruths* rounded) {
  const std::span<const workload::Answer> answers = arena_.buffers().answers(row_.steps);
  workload::Checksum checksum;
  for (const workload::Answer& answer : answers) checksum.add(answer);
  if (effort_.cold_passes > 0) {
    for (const workload::Answer& answer : answers) {
      workload::Checksum& one = answer_checksums_.emplace_back();
      one.add(answer);
    }
  }
  if (checksum.value() != row_.checksum) {
    row_.status = "checksum mismatch";
    return;
  }
  row_.work->brackets = summarize_brackets(answers, truths.diagonal());
  row_.decisions_checksum = decisions_checksum_of(task_.query, answers, *row_.accuracy);
  const bool logged = row_.steps <= effort_.max_logged_steps;
  std::vector<oracle::Charge> charges;
  row_.counts = truths.judge(task_.query, ranges_, answers, *row_.accuracy, {}, &row_.wrong,
                             logged ? &charges : nullptr);
  if (logged)
    log_ = std::make_shared<StepLog>(log_of(ranges_, answers, arena_.buffers().work(row_.steps), charges));
  if (rounded != nullptr)
    row_.rounded_mesh_counts = rounded->judge(task_.query, ranges_, answers, *row_.accuracy);
}

void Measurement::shut_down() { process_.end(); }

ResultRow Measurement::row() {
  row_.busy_s = process_.busy_s() - busy_before_s_;
  // What was timed before things went wrong is not a result.
  if (!alive() || repetitions_ns_.empty()) return row_;
  std::size_t samples = 0;
  for (const std::vector<double>& some : samples_) samples += some.size();
  row_.throughput = ThroughputResult{support::median(repetitions_ns_),
                                     *std::ranges::min_element(repetitions_ns_),
                                     median_absolute_deviation(repetitions_ns_),
                                     first_pass_ns_,
                                     support::median(repetitions_cpu_ns_),
                                     repetitions_ns_.size(),
                                     piece_times().estimate(bootstrap_seed),
                                     static_cast<double>(interrupted_) / static_cast<double>(samples),
                                     row_.steps * static_cast<std::uint64_t>(passes_ * replays_),
                                     repetitions_ns_,
                                     repetitions_cpu_ns_};
  if (!latencies_ns_.empty()) {
    std::vector<double> steps_ns = median_per_step(latencies_ns_);
    row_.latency = summarize_latency(steps_ns, ranges_);
    if (log_ != nullptr) log_->ns = std::move(steps_ns);
  }
  row_.log = log_;
  if (!prepared_ns_.empty()) row_.prepare = summarize_latency(median_per_step(prepared_ns_), ranges_);
  if (!cold_l2_ns_.empty()) {
    row_.cold_l2 = summarize_cold(cold_l2_ns_);
    row_.cold_floor_l2_ns = support::median(floor_l2_ns_);
  }
  if (!cold_ns_.empty()) {
    row_.cold = summarize_cold(cold_ns_);
    row_.cold_floor_ns = support::median(floor_ns_);
  }
  row_.clock_cost_ns = process_.opened().clock_cost_ns;
  return row_;
}

}  // namespace touchmark::bench::measurement

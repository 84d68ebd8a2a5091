#include "bench/experiments/scaling/body_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/scenes/scene_source.h"
#include "bench/support/system/interrupt.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::scaling {
namespace {

constexpr std::size_t ticks_a_frame = BodyQuestion::ticks_a_frame;

using Steady = std::chrono::steady_clock;

double seconds_since(Steady::time_point start) {
  return std::chrono::duration<double>(Steady::now() - start).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<double> median_of_any(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(median(values));
}

std::vector<workload::Answer> answers_of(contestants::Contestant& contestant,
                                         const workload::QueryTrace& trace, bool prepared) {
  std::vector<workload::Answer> answers(trace.steps.size());
  std::vector<std::uint64_t> work(ticks_a_frame);
  contestant.forget();
  for (std::size_t begin = 0; begin < answers.size(); begin += ticks_a_frame) {
    contestant.stand_at(trace, begin);
    if (prepared) contestant.prepare_next();
    contestant.answer(trace, {begin, begin + ticks_a_frame}, std::span(answers).subspan(begin, ticks_a_frame),
                      work);
  }
  return answers;
}

bool differ(const workload::Answer& a, const workload::Answer& b) {
  constexpr double tolerance = 1e-9;
  return a.found != b.found || !(std::abs(a.distance - b.distance) <= tolerance);
}

/// Reads a frame's poses, as a program has just worked them out.
void read_poses(const workload::QueryTrace& trace, std::size_t step) {
  if (trace.schedule == nullptr) return;
  double sum = 0;
  for (const scenes::BodyMove& move : trace.schedule->at(step))
    sum += static_cast<double>(move.body) + move.rotation[0] + move.rotation[8] + move.translation[2];
  [[maybe_unused]] const volatile double read = sum;
}

/// Reads what the ticks of a frame are told, as a program has just read its device.
void read_ahead(const workload::QueryTrace& trace, workload::StepRange range) {
  double sum = 0;
  for (const workload::Step& step : trace.steps.subspan(range.begin, range.size()))
    sum += step.probe.center.sum() + step.probe.radius + step.reach;
  if (trace.schedule != nullptr)
    for (std::size_t i = range.begin; i <= range.end; ++i)
      sum += static_cast<double>(trace.schedule->first[i]);
  [[maybe_unused]] const volatile double read = sum;
}

}  // namespace

BodyRun::BodyRun(const contestants::Roster& roster, std::vector<contestants::ContestantSpec> contestants,
                 std::size_t rounds)
    : roster_(roster), contestants_(std::move(contestants)), rounds_(rounds) {}

BodyRow BodyRun::row_of(const contestants::ContestantSpec& spec, std::size_t bodies,
                        const std::string& motion, const BodyQuestion& question) const {
  BodyRow row;
  row.detector = spec.name;
  row.options = spec.options;
  row.bodies = bodies;
  row.motion = motion;
  row.place = question.place;
  row.moved = question.moved;
  row.frames = question.frames;
  row.ticks_a_frame = ticks_a_frame;
  return row;
}

struct BodyRun::Times {
  std::vector<double> publishing, preparing, first, others;  ///< a frame's each
};

/// Rounds, and the ratios of their medians to those of the rounds with one body right before and after.
struct BodyRun::Rounds {
  Times all;
  std::vector<double> tick_over_one, first_tick_over_one;

  void add(const Times& round, const Times& of_one) {
    for (const auto member : {&Times::publishing, &Times::preparing, &Times::first, &Times::others})
      (all.*member).insert((all.*member).end(), (round.*member).begin(), (round.*member).end());
    compare(round, of_one);
  }
  void compare(const Times& round, const Times& of_one) {
    const auto compare = [](std::vector<double>& ratios, const auto& times, const auto& times_of_one) {
      const double many = median(times), one = median(times_of_one);
      if (many > 0 && one > 0) ratios.push_back(many / one);
    };
    compare(tick_over_one, round.others, of_one.others);
    compare(first_tick_over_one, round.first, of_one.first);
  }
};

struct BodyRun::Asked {
  contestants::Contestant& contestant;
  const BodyQuestion& question;
};

BodyRun::Times BodyRun::time_round(contestants::Contestant& contestant, const BodyQuestion& question,
                                   bool prepared) {
  Times times;
  const workload::QueryTrace trace = question.trace();
  workload::Checksum checksum;
  for (std::size_t frame = 0; frame < question.frames; ++frame) {
    support::check_for_interrupt();
    const std::size_t begin = frame * ticks_a_frame;
    contestants::measure_cost_anew(clock_);
    read_poses(trace, begin);
    const auto start = Steady::now();
    contestant.stand_at(trace, begin);
    if (question.moved > 0)
      times.publishing.push_back(1e9 * seconds_since(start) / static_cast<double>(question.moved));
    read_ahead(trace, {begin, begin + ticks_a_frame});
    if (prepared) {
      const auto published = Steady::now();
      contestant.prepare_next();
      times.preparing.push_back(1e9 * seconds_since(published));
    }
    // All by one loop: another one for later ticks would be out of the caches after a frame, and in their
    // times.
    std::array<std::uint64_t, ticks_a_frame> ticks{}, none{};
    contestant.replay_clocked(trace, {begin, begin + ticks_a_frame}, checksum, ticks, none);
    times.first.push_back(clock_.ns_of(ticks.front()));
    double others = 0;
    for (const std::uint64_t reading : std::span(ticks).subspan(1)) others += clock_.ns_of(reading);
    times.others.push_back(others / (ticks_a_frame - 1));
  }
  return times;
}

BodyRun::Rounds BodyRun::time_rounds(const Asked& asked, const Asked& one, bool prepared) {
  Rounds rounds;
  Times of_one = time_round(one.contestant, one.question, prepared);
  for (std::size_t round = 0; round < rounds_; ++round) {
    const Times times = time_round(asked.contestant, asked.question, prepared);
    rounds.add(times, of_one);
    of_one = time_round(one.contestant, one.question, prepared);
    rounds.compare(times, of_one);
  }
  return rounds;
}

/// Answers first, which are compared with those of the contestant before; then the rounds are timed.
void BodyRun::fill(BodyRow& row, const Asked& asked, const Asked& one, std::vector<workload::Answer>& right) {
  contestants::Contestant& contestant = asked.contestant;
  const BodyQuestion& question = asked.question;
  const bool prepares = contestant.prepares_after_moves();
  const std::vector<workload::Answer> answers = answers_of(contestant, question.trace(), false);
  const std::vector<workload::Answer> prepared =
      prepares ? answers_of(contestant, question.trace(), true) : answers;
  if (right.empty()) right = answers;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    row.found += answers[i].found;
    if (differ(answers[i], right[i]) || differ(prepared[i], right[i])) ++row.differing;
  }
  if (row.differing > 0) row.status = "differs";
  row.bytes = contestant.bytes();
  if (row.bodies > 1)
    row.bytes_per_body = (static_cast<double>(row.bytes) - static_cast<double>(one.contestant.bytes())) /
                         static_cast<double>(row.bodies - 1);
  const Rounds plain = time_rounds(asked, one, false);
  row.first_tick_ns = median(plain.all.first);
  row.tick_ns = median(plain.all.others);
  row.tick_over_one = median_of_any(plain.tick_over_one);
  row.first_tick_over_one = median_of_any(plain.first_tick_over_one);
  if (!plain.all.publishing.empty()) row.publish_ns_per_body = median(plain.all.publishing);
  if (!prepares) return;
  const Rounds after_prepare = time_rounds(asked, one, true);
  row.prepare_ns = median(after_prepare.all.preparing);
  row.first_tick_prepared_ns = median(after_prepare.all.first);
  row.tick_prepared_ns = median(after_prepare.all.others);
  row.tick_prepared_over_one = median_of_any(after_prepare.tick_over_one);
  row.first_tick_prepared_over_one = median_of_any(after_prepare.first_tick_over_one);
}

struct BodyRun::World {
  World(std::size_t bodies, const std::string& motion)
      : name(fmt::format("field:{}:motion={}", bodies, motion)),
        scene(scenes::load_body_scene(name, "")),
        placed(scenes::placed(scene.scene)),
        questions{BodyQuestion(scene, Place::free), BodyQuestion(scene, Place::beside)} {
    placed.moves = !scene.motion.moving.empty();
  }

  std::string name;
  scenes::GeneratedScene scene;
  scenes::PlacedScene placed;
  std::array<BodyQuestion, 2> questions;
};

std::vector<BodyRow> BodyRun::run(std::size_t bodies, const std::string& motion, double limit_s,
                                  const std::function<void(const std::string& contestant)>& progress) {
  World world(bodies, motion);
  const World one(1, motion);
  workload_ =
      workload::Workload{world.name, scenes::merged(world.scene.scene, 1), BodyQuestion::reach, {}, {}, {}};
  for (const BodyQuestion& question : world.questions) {
    workload_->trajectories.emplace_back(name_of(question.place));
    workload_->traces.push_back(question.steps);
  }
  workload_->scene = std::make_shared<const scenes::BodyScene>(std::move(world.scene.scene));
  std::vector<BodyRow> rows;
  std::vector<std::vector<workload::Answer>> right(world.questions.size());
  for (const contestants::ContestantSpec& spec : contestants_) {
    progress(spec.text());
    std::string& left_out = left_out_[spec.text() + " " + motion];
    const auto start = Steady::now();
    std::unique_ptr<contestants::Contestant> contestant, with_one;
    double build_ms = 0;
    if (left_out.empty()) {
      try {
        contestant = roster_.build(spec, world.placed);
        build_ms = 1e3 * seconds_since(start);
        with_one = roster_.build(spec, one.placed);
      } catch (const std::invalid_argument& error) {
        left_out = fmt::format("refused: {}", error.what());
      } catch (const MeshError& error) {
        left_out = fmt::format("refused: {}", error.what());
      }
    }
    for (std::size_t i = 0; i < world.questions.size(); ++i) {
      BodyRow row = row_of(spec, bodies, motion, world.questions[i]);
      if (contestant && with_one) {
        row.build_ms = build_ms;
        fill(row, {*contestant, world.questions[i]}, {*with_one, one.questions[i]}, right[i]);
      } else {
        row.status = left_out;
      }
      rows.push_back(std::move(row));
    }
    if (left_out.empty() && seconds_since(start) > limit_s)
      left_out = fmt::format("skipped: took {:.3g} s with {} bodies", seconds_since(start), bodies);
  }
  return rows;
}

}  // namespace touchmark::bench::experiments::scaling

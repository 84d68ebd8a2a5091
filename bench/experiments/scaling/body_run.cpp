#include "bench/experiments/scaling/body_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/bodies/scene_source.h"
#include "bench/scenes/portable_sincos.h"
#include "bench/support/available_memory.h"
#include "bench/support/interrupt.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::scaling {
namespace {

using Steady = std::chrono::steady_clock;

constexpr std::size_t ticks_a_frame = 16, frames_of_few = 32, frames_of_many = 8, many = 20'000;
constexpr double frame_s = ticks_a_frame / 1000.0;  // a servo tick is a millisecond
constexpr double reach = 0.05;                      // of a body's size

double seconds_since(Steady::time_point start) {
  return std::chrono::duration<double>(Steady::now() - start).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A few thousandths of a body's size about the place, along a curve that never stands still.
Vec3 wobble(std::size_t tick) {
  const double t = static_cast<double>(tick);
  return 0.003 * Vec3(scenes::portable_sincos(t / 97).cos, scenes::portable_sincos(t / 61).sin,
                      scenes::portable_sincos(t / 43).sin);
}

/// Outside all bodies of a field and more than one body's size from each; or just outside the first body,
/// that it moves with.
Vec3 place_of(Place place, const bodies::GeneratedScene& scene, double time_s) {
  const bodies::Body& first = scene.scene.bodies.front();
  if (place == Place::free) return first.start.position + Vec3::Constant(1.5);
  const bool moves = !scene.motion.moving.empty() && scene.motion.moving.front() == 0;
  const Pose pose = bodies::pose_of(moves ? scene.motion.at(0, time_s) : first.start);
  return image(pose, 1.02 * scene.scene.shapes[first.shape]->vertices().front());
}

}  // namespace

/// The steps of a trace: a frame's first one places the bodies, the others nothing.
struct BodyRun::Question {
  Question(const Question&) = delete;
  Question(const bodies::GeneratedScene& scene, Place where) : place(where) {
    frames = scene.scene.bodies.size() > many ? frames_of_many : frames_of_few;
    const std::vector<std::uint32_t>& moving = scene.motion.moving;
    if (!moving.empty()) {
      support::require_memory("the poses of bodies",
                              2 * sizeof(bodies::BodyMove) * static_cast<double>(frames * moving.size()));
      schedule.first.push_back(0);
    }
    for (std::size_t frame = 0; frame < frames; ++frame) {
      // There and back again, so that the way from the last to the first is no jump.
      const double time_s = frame_s * static_cast<double>(std::min(frame, frames - frame));
      for (const std::uint32_t body : moving)
        schedule.moves.push_back(bodies::BodyMove::of(body, bodies::pose_of(scene.motion.at(body, time_s))));
      for (std::size_t tick = 0; tick < ticks_a_frame; ++tick) {
        if (!moving.empty()) schedule.first.push_back(schedule.moves.size());
        const Vec3 center = place_of(place, scene, time_s) + wobble(frame * ticks_a_frame + tick);
        workload::Step step;
        step.probe = {center, reach};
        step.reach = reach;
        steps.push_back(step);
      }
    }
    view = schedule.view();
    moved = moving.size();
  }

  workload::QueryTrace trace() const {
    return {workload::Query::nearest, steps, schedule.first.empty() ? nullptr : &view};
  }

  Place place;
  std::size_t frames = 0, moved = 0;
  bodies::Schedule schedule;
  bodies::ScheduleView view;
  std::vector<workload::Step> steps;
};

BodyRun::BodyRun(const contestants::Roster& roster, std::vector<contestants::ContestantSpec> contestants,
                 std::size_t rounds)
    : roster_(roster),
      contestants_(std::move(contestants)),
      rounds_(rounds),
      clock_(contestants::calibrate_clock()) {}

BodyRow BodyRun::row_of(const contestants::ContestantSpec& spec, std::size_t bodies,
                        const std::string& motion, const Question& question) const {
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

/// Answers first, which are compared with those of the contestant before; then the rounds are timed.
void BodyRun::fill(BodyRow& row, contestants::Contestant& contestant, const Question& question,
                   std::vector<workload::Answer>& right) const {
  const workload::QueryTrace trace = question.trace();
  std::vector<workload::Answer> answers(question.steps.size());
  std::vector<std::uint64_t> work(answers.size());
  contestant.forget();
  contestant.answer(trace, {0, answers.size()}, answers, work);
  if (right.empty()) right = answers;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    row.found += answers[i].found;
    constexpr double tolerance = 1e-9;
    if (answers[i].found != right[i].found ||
        !(std::abs(answers[i].distance - right[i].distance) <= tolerance))
      ++row.differing;
  }
  if (row.differing > 0) row.status = "differs";
  std::vector<double> publishing, first, others;
  workload::Checksum checksum;
  for (std::size_t round = 0; round < rounds_; ++round) {
    for (std::size_t frame = 0; frame < question.frames; ++frame) {
      support::check_for_interrupt();
      const std::size_t begin = frame * ticks_a_frame;
      const auto start = Steady::now();
      contestant.stand_at(trace, begin);
      if (question.moved > 0)
        publishing.push_back(1e9 * seconds_since(start) / static_cast<double>(question.moved));
      std::uint64_t ticks = 0, none = 0;
      contestant.replay_clocked(trace, {begin, begin + 1}, checksum, {&ticks, 1}, {&none, 1});
      first.push_back(std::max(0.0, static_cast<double>(ticks) * clock_.ns_per_tick - clock_.cost_ns));
      const auto rest = Steady::now();
      contestant.replay(trace, {begin + 1, begin + ticks_a_frame}, checksum);
      others.push_back(1e9 * seconds_since(rest) / (ticks_a_frame - 1));
    }
  }
  row.bytes = contestant.bytes();
  row.first_tick_ns = median(std::move(first));
  row.tick_ns = median(std::move(others));
  if (!publishing.empty()) row.publish_ns_per_body = median(std::move(publishing));
}

void BodyRun::compare_with_one(BodyRow& row) {
  const std::string key = fmt::format("{} {} {}", row.contestant(), row.motion, name_of(row.place));
  if (row.bodies == 1) of_one_.insert_or_assign(key, row);
  const auto one = of_one_.find(key);
  if (one == of_one_.end() || !(one->second.tick_ns > 0)) return;
  row.tick_over_one = row.tick_ns / one->second.tick_ns;
  if (row.bodies > 1)
    row.bytes_per_body = (static_cast<double>(row.bytes) - static_cast<double>(one->second.bytes)) /
                         static_cast<double>(row.bodies - 1);
}

std::vector<BodyRow> BodyRun::run(std::size_t bodies, const std::string& motion, double limit_s,
                                  const std::function<void(const std::string& contestant)>& progress) {
  const std::string name = fmt::format("field:{}:motion={}", bodies, motion);
  bodies::GeneratedScene scene = bodies::load_body_scene(name, "");
  bodies::PlacedScene placed = bodies::placed(scene.scene);
  placed.moves = !scene.motion.moving.empty();
  const std::array<Question, 2> questions{Question(scene, Place::free), Question(scene, Place::beside)};
  workload_ = workload::Workload{name, bodies::merged(scene.scene, 1), reach, {}, {}, {}};
  for (const Question& question : questions) {
    workload_->trajectories.emplace_back(name_of(question.place));
    workload_->traces.push_back(question.steps);
  }
  workload_->scene = std::make_shared<const bodies::BodyScene>(std::move(scene.scene));
  std::vector<BodyRow> rows;
  std::vector<std::vector<workload::Answer>> right(questions.size());
  for (const contestants::ContestantSpec& spec : contestants_) {
    progress(spec.text());
    std::string& left_out = left_out_[spec.text() + " " + motion];
    const auto start = Steady::now();
    std::unique_ptr<contestants::Contestant> contestant;
    if (left_out.empty()) {
      try {
        contestant = roster_.build(spec, placed);
      } catch (const std::invalid_argument& error) {
        left_out = fmt::format("refused: {}", error.what());
      } catch (const MeshError& error) {
        left_out = fmt::format("refused: {}", error.what());
      }
    }
    const double build_ms = 1e3 * seconds_since(start);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      BodyRow row = row_of(spec, bodies, motion, questions[i]);
      if (contestant) {
        row.build_ms = build_ms;
        fill(row, *contestant, questions[i], right[i]);
        compare_with_one(row);
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

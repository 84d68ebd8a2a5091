/// Any detector as a contestant: the loops that ask it.
#pragma once

#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/contestants/tick_clock.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"
#include "core/detector.h"
#include "core/mesh_motion.h"
#include "core/mesh_update.h"
#include "core/search/many/nearest_many.h"

namespace touchmark::bench::contestants {

/// A detector over a scene that answers among bodies that move: `move_to` moves them to where they are at a
/// step, and remembers from where.
template <class D>
concept AnswersMoving = requires(D& detector, const Sweep& sweep, typename D::Session& session) {
  { detector.first_hit_moving(sweep, session) } -> std::same_as<std::optional<Impact>>;
};

/// What a type of detector declares.
template <Detector D>
std::vector<workload::Query> queries_of() {
  std::vector<workload::Query> queries;
  if constexpr (AnswersTouches<D>) queries.push_back(workload::Query::touches);
  if constexpr (AnswersNearest<D>) queries.push_back(workload::Query::nearest);
  if constexpr (AnswersSweep<D>) queries.push_back(workload::Query::sweep);
  if constexpr (AnswersMoving<D>) queries.push_back(workload::Query::moving);
  return queries;
}

/// A detector whose type declares more than it does, as one that is known only once it is loaded: it says
/// what it answers and whether it updates, and makes the sessions that belong to it.
template <class D>
concept KnownOnceBuilt = Detector<D> && requires(const D& detector, workload::Query query) {
  { detector.answers(query) } -> std::same_as<bool>;
  { detector.updates() } -> std::same_as<bool>;
  { detector.session() } -> std::same_as<typename D::Session>;
};

/// A detector over a scene: `stand_at` moves the bodies to where they are at a step of a schedule, and the
/// session says which body the last answer is about.
template <class D>
concept StandsInSchedules = requires(D& detector, const scenes::ScheduleView* schedule,
                                     const typename D::Session& session) {
  { detector.stand_at(schedule, std::size_t{}) } -> std::same_as<bool>;
  { session.body } -> std::same_as<const std::uint32_t&>;
};

/// Many points are asked of a mesh, and never of a scene.
template <class D>
concept AnswersMany = AnswersNearest<D> && !StandsInSchedules<D>;

template <Detector D>
struct SessionsOfMany {
  struct Type {};
};
template <AnswersMany D>
struct SessionsOfMany<D> {
  using Type = ManySessions<D>;
};

/// Whether a detector's `prepare` is called after each answer.
enum class Prefetch { off, on };

/// On, what does not prepare is clocked as what does.
template <Detector D, Prefetch prefetch = Prefetch::off>
class ContestantOf final : public Contestant {
 public:
  explicit ContestantOf(D detector) : ContestantOf(std::make_shared<D>(std::move(detector))) {}
  explicit ContestantOf(std::shared_ptr<D> detector) : detector_(std::move(detector)) { begin_session(); }

  std::unique_ptr<Contestant> share() const override { return std::make_unique<ContestantOf>(detector_); }
  bool stand_at([[maybe_unused]] const workload::QueryTrace& trace,
                [[maybe_unused]] std::size_t step) noexcept override {
    if constexpr (AnswersMoving<D>)
      if (trace.query == workload::Query::moving) return detector_->move_to(trace.schedule, step);
    if constexpr (StandsInSchedules<D>) return detector_->stand_at(trace.schedule, step);
    return false;
  }
  bool prepares_after_moves() const noexcept override { return StandsInSchedules<D> && Prepares<D>; }
  void prepare_next() noexcept override {
    if constexpr ((StandsInSchedules<D> || prefetch == Prefetch::on) && Prepares<D>)
      detector_->prepare(*session_);
  }

  bool answers(workload::Query query) const noexcept override {
    if constexpr (KnownOnceBuilt<D>) return detector_->answers(query);
    switch (query) {
      case workload::Query::touches:
        return AnswersTouches<D>;
      case workload::Query::nearest:
        return AnswersNearest<D>;
      case workload::Query::sweep:
        return AnswersSweep<D>;
      case workload::Query::moving:
        return AnswersMoving<D>;
    }
    return false;
  }
  Accuracy accuracy() const noexcept override { return detector_->accuracy(); }
  std::size_t bytes() const noexcept override { return detector_->bytes(); }
  bool builds_lazily() const noexcept override {
    if constexpr (BuildsLazily<D>) return detector_->builds_lazily();
    return false;
  }
  void forget() override {
    begin_session();
    if constexpr (AnswersMany<D>) {
      if (many_) many_->forget();
    }
  }
  bool guides_proxy() const noexcept override {
    return AnswersTouches<D> && AnswersSweep<D> && AnswersContacts<D>;
  }
  bool touches([[maybe_unused]] const Probe& probe) noexcept override {
    if constexpr (requires { detector_->touches_some(probe, *session_); })
      return detector_->touches_some(probe, *session_);
    else if constexpr (AnswersTouches<D>)
      return detector_->touches(probe, *session_);
    return false;
  }
  std::optional<Impact> first_hit([[maybe_unused]] const Sweep& sweep,
                                  const MeshMotion* motion) noexcept override {
    if (motion != nullptr) {
      if constexpr (AnswersMovingSweep<D>) return detector_->first_hit_moving(sweep, *motion, *session_);
      return Impact{0, {sweep.from, Vec3::UnitZ()}};
    }
    if constexpr (AnswersSweep<D>) return detector_->first_hit(sweep, *session_);
    return std::nullopt;
  }
  std::size_t contacts([[maybe_unused]] const Probe& probe, [[maybe_unused]] double reach,
                       [[maybe_unused]] std::span<Contact> into) noexcept override {
    if constexpr (AnswersContacts<D>) return detector_->contacts(probe, reach, *session_, into);
    return 0;
  }
  bool updates() const noexcept override {
    if constexpr (KnownOnceBuilt<D>) return detector_->updates();
    return Updates<D>;
  }
  void update([[maybe_unused]] const TriangleMesh& mesh) override {
    if constexpr (Updates<D>) detector_->update(mesh);
  }
  Work work() const noexcept override { return session_->work; }
  LimitedWork* limited_work() noexcept override {
    if constexpr (KeepsToLimit<D>) return &session_->work;
    return nullptr;
  }

  void answer(const workload::QueryTrace& trace, workload::StepRange range,
              std::span<workload::Answer> answers, std::span<std::uint64_t> work) noexcept override {
    assert(answers.size() == range.size() && work.size() == range.size());
    begin_pass();
    for (std::size_t i = 0; i < range.size(); ++i) {
      stand_at(trace, range.begin + i);
      const std::uint64_t before = session_->work.total();
      with_query(trace.query, [&](auto ask) { answers[i] = ask(trace.steps, range.begin + i); });
      prepare();
      work[i] = session_->work.total() - before;
    }
  }

  void replay(const workload::QueryTrace& trace, workload::StepRange range,
              workload::Checksum& checksum) noexcept override {
    begin_pass();
    with_query(trace.query, [&](auto ask) {
      workload::Checksum sum = checksum;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        stand_at(trace, i);
        sum.add(ask(trace.steps, i));
        prepare();
      }
      checksum = sum;
    });
  }

  void replay_clocked(const workload::QueryTrace& trace, workload::StepRange range,
                      workload::Checksum& checksum, std::span<std::uint64_t> ticks,
                      std::span<std::uint64_t> prepare_ticks) noexcept override {
    assert(ticks.size() == range.size());
    assert(prefetch == Prefetch::off || prepare_ticks.size() == range.size());
    begin_pass();
    with_query(trace.query, [&](auto ask) {
      workload::Checksum sum = checksum;
      std::uint64_t before = TickClock::now();
      for (std::size_t i = 0; i < range.size(); ++i) {
        if constexpr (StandsInSchedules<D>) {
          stand_at(trace, range.begin + i);  // poses are published outside the tick
          before = TickClock::now();
        }
        sum.add(ask(trace.steps, range.begin + i));
        const std::uint64_t after = TickClock::now();
        ticks[i] = after - before;
        before = after;
        if constexpr (prefetch == Prefetch::on) {
          prepare();
          before = TickClock::now();
          prepare_ticks[i] = before - after;
        }
      }
      checksum = sum;
    });
  }

  void replay_paced(const workload::QueryTrace& trace, StepPacer& pacer) noexcept override {
    // Kept here: to look at the session's counters before a query would fetch them for it.
    Work seen = session_->work;
    while (const std::optional<std::size_t> step = pacer.next()) {
      prepare();
      if constexpr (prefetch == Prefetch::on) seen = session_->work;
      stand_at(trace, *step);
      // A device's position has just been read: no query waits for it.
      const std::array<workload::Step, 2> from_to{trace.steps[*step > 0 ? *step - 1 : 0], trace.steps[*step]};
      with_query(trace.query, [&](auto ask) {
        std::atomic_signal_fence(std::memory_order_seq_cst);  // read, and not later
        const std::uint64_t before = TickClock::now();
        const workload::Answer answer = ask(from_to, 1);
        const std::uint64_t after = TickClock::now();
        pacer.took(after - before, answer, work_between(seen, session_->work));
      });
      seen = session_->work;
    }
  }

  void nearest_many([[maybe_unused]] std::span<const Vec3> points, [[maybe_unused]] double reach,
                    [[maybe_unused]] std::span<std::optional<Contact>> answers,
                    [[maybe_unused]] const ManyOptions& options) override {
    if constexpr (AnswersMany<D>) {
      if (!many_) many_ = std::make_unique<ManySessions<D>>();
      touchmark::nearest_many(*detector_, points, reach, answers, *many_, options);
    } else {
      assert(!"the detector must answer nearest, and stand on a mesh");
    }
  }

  bool prepares() const noexcept override { return prefetch == Prefetch::on; }

 private:
  void begin_session() {
    if constexpr (KnownOnceBuilt<D>) {
      session_.emplace(detector_->session());
    } else {
      session_.emplace();
    }
  }
  /// What a budget leaves open depends on what the session remembers: all passes begin with nothing.
  void begin_pass() noexcept {
    if constexpr (tells_brackets) begin_session();
  }
  static workload::Answer about_body(workload::Answer answer,
                                     [[maybe_unused]] const typename D::Session& session) noexcept {
    if constexpr (StandsInSchedules<D>) answer.body = answer.found != 0 ? session.body : 0;
    return answer;
  }
  static workload::Answer answer_of(const std::optional<Impact>& impact,
                                    const typename D::Session& session) noexcept {
    return impact ? about_body(workload::Answer::of(impact->contact, impact->fraction), session)
                  : workload::Answer{};
  }
  static Sweep sweep_at(std::span<const workload::Step> steps, std::size_t i) noexcept {
    const Probe& now = steps[i].probe;
    return {steps[i > 0 ? i - 1 : 0].probe.center, now.center, now.radius};
  }
  void prepare() noexcept {
    if constexpr (prefetch == Prefetch::on && Prepares<D>) detector_->prepare(*session_);
  }
  /// Calls visit(ask) with the ask(steps, i) -> Answer of this query.
  template <class Visitor>
  void with_query(workload::Query query, Visitor&& visit) noexcept {
    using Steps = std::span<const workload::Step>;
    if constexpr (AnswersTouches<D>) {
      if (query == workload::Query::touches)
        return visit([&detector = *detector_, &session = *session_](Steps steps, std::size_t i) noexcept {
          workload::Answer answer;
          answer.found = detector.touches(steps[i].probe, session) ? 1 : 0;
          return about_body(answer, session);
        });
    }
    if constexpr (AnswersNearest<D>) {
      if (query == workload::Query::nearest) {
        return visit([&detector = *detector_, &session = *session_](Steps steps, std::size_t i) noexcept {
          if constexpr (tells_brackets) {
            const Bracket bracket = detector.bracket(steps[i].probe, steps[i].reach, session);
            if (!bracket.contact) return workload::Answer{};
            workload::Answer answer =
                workload::Answer::of(*bracket.contact, bracket.is_nearest ? 0 : bracket.lower);
            answer.unfinished = bracket.is_nearest ? 0 : 1;
            return answer;
          }
          const std::optional<Contact> contact = detector.nearest(steps[i].probe, steps[i].reach, session);
          return contact ? about_body(workload::Answer::of(*contact), session) : workload::Answer{};
        });
      }
    }
    if constexpr (AnswersSweep<D>) {
      if (query == workload::Query::sweep)
        return visit([&detector = *detector_, &session = *session_](Steps steps, std::size_t i) noexcept {
          return answer_of(detector.first_hit(sweep_at(steps, i), session), session);
        });
    }
    if constexpr (AnswersMoving<D>) {
      if (query == workload::Query::moving)
        return visit([&detector = *detector_, &session = *session_](Steps steps, std::size_t i) noexcept {
          return answer_of(detector.first_hit_moving(sweep_at(steps, i), session), session);
        });
    }
    assert(!"the query must be one that answers(query) affirms");
  }

  std::shared_ptr<D> detector_;
  /// Those of nearest_many, if it was asked and the detector answers that.
  std::unique_ptr<typename SessionsOfMany<D>::Type> many_;
  static constexpr bool tells_brackets = requires(const D& detector, typename D::Session& session) {
    detector.bracket(Probe(), 0.0, session);
  };
  std::optional<typename D::Session> session_;  // engaged always; optional so that any session can be renewed
};

}  // namespace touchmark::bench::contestants

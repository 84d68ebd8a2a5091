/// A detector as the program sees it. The type is erased once for a range of steps, never for a probe: the
/// loops below are templates, so the compiler sees the detector's query inside them.
#pragma once

#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/contestants/tick_clock.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"
#include "core/detector.h"
#include "core/mesh_update.h"

namespace touchmark::bench::contestants {

/// Returns what was looked at between two readings of a session's counters.
inline Work work_between(const Work& before, const Work& after) noexcept {
  return {after.cells - before.cells, after.spheres - before.spheres, after.boxes - before.boxes,
          after.triangles - before.triangles, after.exact_decisions - before.exact_decisions};
}

/// Says which step is asked next and when, and takes what came of it: a loop that waits for the time of a
/// tick, or one that does something to the machine between queries.
class StepPacer {
 public:
  StepPacer() = default;
  StepPacer(const StepPacer&) = delete;
  StepPacer& operator=(const StepPacer&) = delete;
  virtual ~StepPacer() = default;

  /// Returns the next step when it is to be asked, nothing at the end.
  virtual std::optional<std::size_t> next() noexcept = 0;
  /// `ticks` is the query's time by TickClock, one reading of it included, `work` what it looked at.
  virtual void took(std::uint64_t ticks, const workload::Answer& answer, const Work& work) noexcept = 0;
};

/// One built detector with one session. answer and the replays need answers(trace.query).
class Contestant {
 public:
  Contestant() = default;
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;
  virtual ~Contestant() = default;

  /// Returns another contestant over the same detector, with a fresh session: for another thread.
  virtual std::unique_ptr<Contestant> share() const = 0;
  virtual bool answers(workload::Query query) const noexcept = 0;
  virtual Accuracy accuracy() const noexcept = 0;
  virtual std::size_t bytes() const noexcept = 0;
  /// Returns true if the detector leaves parts of itself to the first queries: see the concept BuildsLazily.
  virtual bool builds_lazily() const noexcept = 0;
  /// A fresh session, its work counters at zero.
  virtual void forget() = 0;
  virtual Work work() const noexcept = 0;

  /// The answer to each step of the range and the total work it took; both spans have the range's size.
  virtual void answer(const workload::QueryTrace& trace, workload::StepRange range,
                      std::span<workload::Answer> answers, std::span<std::uint64_t> work) noexcept = 0;
  /// Returns true if it can follow a mesh whose vertices move. Only then may it be asked to; the session
  /// stays.
  virtual bool updates() const noexcept { return false; }
  /// See the concept Updates. Throws what the detector's update throws.
  virtual void update(const TriangleMesh& mesh) { static_cast<void>(mesh); }

  /// Answers the steps of the range into the checksum and does nothing else: this loop is timed from outside.
  virtual void replay(const workload::QueryTrace& trace, workload::StepRange range,
                      workload::Checksum& checksum) noexcept = 0;
  /// Replays with the clock read once a step: the ticks each step took, one clock reading included.
  /// What the detector prepares between steps is clocked apart, into `prepare_ticks` of the same size; empty
  /// will do for one that does not.
  virtual void replay_clocked(const workload::QueryTrace& trace, workload::StepRange range,
                              workload::Checksum& checksum, std::span<std::uint64_t> ticks,
                              std::span<std::uint64_t> prepare_ticks) noexcept = 0;
  /// Asks the steps that the pacer names, each clocked. Prepares once the pacer has let it go, before the
  /// clock is read: where a loop prepares just before it reads its device.
  virtual void replay_paced(const workload::QueryTrace& trace, StepPacer& pacer) noexcept = 0;
  /// Returns true if the detector prepares after each step. That is in all other times, and in the work.
  virtual bool prepares() const noexcept = 0;
  /// Moves the bodies of a scene to where they are at a step. The loops above do so before each query, which
  /// is quick where the step before was the last one; elsewhere it may take its time, so do it before a clock
  /// is read.
  virtual void stand_at(const workload::QueryTrace& trace, std::size_t step) noexcept {
    static_cast<void>(trace), static_cast<void>(step);
  }
};

/// What a type of detector declares.
template <Detector D>
std::vector<workload::Query> queries_of() {
  std::vector<workload::Query> queries;
  if constexpr (AnswersTouches<D>) queries.push_back(workload::Query::touches);
  if constexpr (AnswersNearest<D>) queries.push_back(workload::Query::nearest);
  if constexpr (AnswersSweep<D>) queries.push_back(workload::Query::sweep);
  return queries;
}

/// A detector over a scene: `stand_at` moves the bodies to where they are at a step of a schedule, and the
/// session says which body the last answer is about.
template <class D>
concept StandsInSchedules = requires(D& detector, const bodies::ScheduleView* schedule,
                                     const typename D::Session& session) {
  detector.stand_at(schedule, std::size_t{});
  { session.body } -> std::same_as<const std::uint32_t&>;
};

/// Whether a detector's `prepare` is called after each answer.
enum class Prefetch { off, on };

template <Detector D, Prefetch prefetch = Prefetch::off>
requires(prefetch == Prefetch::off || Prepares<D>) class ContestantOf final : public Contestant {
 public:
  explicit ContestantOf(D detector) : ContestantOf(std::make_shared<D>(std::move(detector))) {}
  explicit ContestantOf(std::shared_ptr<D> detector) : detector_(std::move(detector)) { session_.emplace(); }

  std::unique_ptr<Contestant> share() const override { return std::make_unique<ContestantOf>(detector_); }
  void stand_at(const workload::QueryTrace& trace, std::size_t step) noexcept override {
    if constexpr (StandsInSchedules<D>) detector_->stand_at(trace.schedule, step);
  }

  bool answers(workload::Query query) const noexcept override {
    switch (query) {
      case workload::Query::touches:
        return AnswersTouches<D>;
      case workload::Query::nearest:
        return AnswersNearest<D>;
      case workload::Query::sweep:
        return AnswersSweep<D>;
    }
    return false;
  }
  Accuracy accuracy() const noexcept override { return detector_->accuracy(); }
  std::size_t bytes() const noexcept override { return detector_->bytes(); }
  bool builds_lazily() const noexcept override {
    if constexpr (BuildsLazily<D>) return detector_->builds_lazily();
    return false;
  }
  void forget() override { session_.emplace(); }
  bool updates() const noexcept override { return Updates<D>; }
  void update([[maybe_unused]] const TriangleMesh& mesh) override {
    if constexpr (Updates<D>) detector_->update(mesh);
  }
  Work work() const noexcept override { return session_->work; }

  void answer(const workload::QueryTrace& trace, workload::StepRange range,
              std::span<workload::Answer> answers, std::span<std::uint64_t> work) noexcept override {
    assert(answers.size() == range.size() && work.size() == range.size());
    with_query(trace.query, [&](auto ask) {
      for (std::size_t i = 0; i < range.size(); ++i) {
        stand(trace, range.begin + i);
        const std::uint64_t before = session_->work.total();
        answers[i] = ask(trace.steps, range.begin + i);
        prepare();
        work[i] = session_->work.total() - before;
      }
    });
  }

  void replay(const workload::QueryTrace& trace, workload::StepRange range,
              workload::Checksum& checksum) noexcept override {
    with_query(trace.query, [&](auto ask) {
      workload::Checksum sum = checksum;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        stand(trace, i);
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
    with_query(trace.query, [&](auto ask) {
      workload::Checksum sum = checksum;
      std::uint64_t before = TickClock::now();
      for (std::size_t i = 0; i < range.size(); ++i) {
        if constexpr (StandsInSchedules<D>) {
          stand(trace, range.begin + i);  // poses are published outside the tick
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
    with_query(trace.query, [&](auto ask) {
      // Kept here: to look at the session's counters before a query would fetch them for it.
      Work seen = session_->work;
      while (const std::optional<std::size_t> step = pacer.next()) {
        prepare();
        if constexpr (prefetch == Prefetch::on) seen = session_->work;
        // A device's position has just been read: no query waits for it.
        stand(trace, *step);
        const std::array<workload::Step, 2> from_to{trace.steps[*step > 0 ? *step - 1 : 0],
                                                    trace.steps[*step]};
        std::atomic_signal_fence(std::memory_order_seq_cst);  // read, and not later
        const std::uint64_t before = TickClock::now();
        const workload::Answer answer = ask(from_to, 1);
        const std::uint64_t after = TickClock::now();
        pacer.took(after - before, answer, work_between(seen, session_->work));
        seen = session_->work;
      }
    });
  }

  bool prepares() const noexcept override { return prefetch == Prefetch::on; }

 private:
  void stand([[maybe_unused]] const workload::QueryTrace& trace, [[maybe_unused]] std::size_t step) noexcept {
    if constexpr (StandsInSchedules<D>) detector_->stand_at(trace.schedule, step);
  }
  static workload::Answer about_body(workload::Answer answer,
                                     [[maybe_unused]] const typename D::Session& session) noexcept {
    if constexpr (StandsInSchedules<D>) answer.body = answer.found != 0 ? session.body : 0;
    return answer;
  }
  void prepare() noexcept {
    if constexpr (prefetch == Prefetch::on) detector_->prepare(*session_);
  }
  /// Calls visit(ask) with the ask(steps, i) -> Answer of this query.
  template <class Visitor>
  void with_query(workload::Query query, Visitor&& visit) noexcept {
    using Steps = std::span<const workload::Step>;
    if constexpr (AnswersTouches<D>) {
      if (query == workload::Query::touches) {
        return visit([&detector = *detector_, &session = *session_](Steps steps, std::size_t i) noexcept {
          workload::Answer answer;
          answer.found = detector.touches(steps[i].probe, session) ? 1 : 0;
          return about_body(answer, session);
        });
      }
    }
    if constexpr (AnswersNearest<D>) {
      if (query == workload::Query::nearest) {
        return visit([&detector = *detector_, &session = *session_](Steps steps, std::size_t i) noexcept {
          const std::optional<Contact> contact = detector.nearest(steps[i].probe, steps[i].reach, session);
          return contact ? about_body(workload::Answer::of(*contact), session) : workload::Answer{};
        });
      }
    }
    if constexpr (AnswersSweep<D>) {
      if (query == workload::Query::sweep) {
        return visit([&detector = *detector_, &session = *session_](Steps steps, std::size_t i) noexcept {
          const Probe& now = steps[i].probe;
          const Sweep sweep{steps[i > 0 ? i - 1 : 0].probe.center, now.center, now.radius};
          const std::optional<Impact> impact = detector.first_hit(sweep, session);
          return impact ? about_body(workload::Answer::of(impact->contact, impact->fraction), session)
                        : workload::Answer{};
        });
      }
    }
    assert(!"the query must be one that answers(query) affirms");
  }

  std::shared_ptr<D> detector_;
  std::optional<typename D::Session> session_;  // engaged always; optional so that any session can be renewed
};

}  // namespace touchmark::bench::contestants

/// A detector as the program sees it. The type is erased once for a window of steps, never for a probe: the
/// loops below are templates, so the compiler sees the detector's query inside them.
#pragma once

#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/contestants/tick_clock.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"
#include "core/detector.h"
#include "core/mesh_update.h"

namespace touchmark::bench {

/// One built detector with one session. answer, replay and replay_clocked need answers(course.query).
class Contestant {
 public:
  Contestant() = default;
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;
  virtual ~Contestant() = default;

  virtual bool answers(Query query) const noexcept = 0;
  virtual Accuracy accuracy() const noexcept = 0;
  virtual std::size_t bytes() const noexcept = 0;
  /// See the concept BuildsLazily.
  virtual bool builds_lazily() const noexcept = 0;
  /// A fresh session, its work counters at zero.
  virtual void forget() = 0;
  virtual Work work() const noexcept = 0;

  /// The answer to each step of the window and the total work it took; both spans have the window's size.
  virtual void answer(const Course& course, Window window, std::span<Answer> answers,
                      std::span<std::uint64_t> work) noexcept = 0;
  /// Can it follow a mesh whose vertices move? Only then may it be asked to; the session stays.
  virtual bool updates() const noexcept { return false; }
  /// See the concept Updates. Throws what the detector's update throws.
  virtual void update(const TriangleMesh& mesh) { static_cast<void>(mesh); }

  /// The same answers folded into the checksum, and nothing else: the loop that is timed from outside.
  virtual void replay(const Course& course, Window window, Checksum& checksum) noexcept = 0;
  /// The same, with the clock read once a step: the ticks each step took, one clock reading included.
  /// What the detector prepares between steps is clocked apart, into `prepare_ticks` of the same size; empty
  /// will do for one that does not.
  virtual void replay_clocked(const Course& course, Window window, Checksum& checksum,
                              std::span<std::uint64_t> ticks,
                              std::span<std::uint64_t> prepare_ticks) noexcept = 0;
  /// Is the detector told to prepare after each step? That is in all other times, and in the work.
  virtual bool prepares() const noexcept = 0;
};

/// What a type of detector declares.
template <Detector D>
std::vector<Query> queries_of() {
  std::vector<Query> queries;
  if constexpr (AnswersTouches<D>) queries.push_back(Query::touches);
  if constexpr (AnswersNearest<D>) queries.push_back(Query::nearest);
  if constexpr (AnswersSweep<D>) queries.push_back(Query::sweep);
  return queries;
}

/// Whether a detector's `prepare` is called after each answer.
enum class Idle { wasted, used };

template <Detector D, Idle idle = Idle::wasted>
requires(idle == Idle::wasted || Prepares<D>) class ContestantOf final : public Contestant {
 public:
  explicit ContestantOf(D detector) : detector_(std::move(detector)) { session_.emplace(); }

  bool answers(Query query) const noexcept override {
    switch (query) {
      case Query::touches:
        return AnswersTouches<D>;
      case Query::nearest:
        return AnswersNearest<D>;
      case Query::sweep:
        return AnswersSweep<D>;
    }
    return false;
  }
  Accuracy accuracy() const noexcept override { return detector_.accuracy(); }
  std::size_t bytes() const noexcept override { return detector_.bytes(); }
  bool builds_lazily() const noexcept override {
    if constexpr (BuildsLazily<D>) return detector_.builds_lazily();
    return false;
  }
  void forget() override { session_.emplace(); }
  bool updates() const noexcept override { return Updates<D>; }
  void update([[maybe_unused]] const TriangleMesh& mesh) override {
    if constexpr (Updates<D>) detector_.update(mesh);
  }
  Work work() const noexcept override { return session_->work; }

  void answer(const Course& course, Window window, std::span<Answer> answers,
              std::span<std::uint64_t> work) noexcept override {
    assert(answers.size() == window.size() && work.size() == window.size());
    with_query(course.query, [&](auto ask) {
      for (std::size_t i = 0; i < window.size(); ++i) {
        const std::uint64_t before = session_->work.total();
        answers[i] = ask(course.steps, window.begin + i);
        prepare();
        work[i] = session_->work.total() - before;
      }
    });
  }

  void replay(const Course& course, Window window, Checksum& checksum) noexcept override {
    with_query(course.query, [&](auto ask) {
      Checksum sum = checksum;
      for (std::size_t i = window.begin; i < window.end; ++i) {
        sum.add(ask(course.steps, i));
        prepare();
      }
      checksum = sum;
    });
  }

  void replay_clocked(const Course& course, Window window, Checksum& checksum, std::span<std::uint64_t> ticks,
                      std::span<std::uint64_t> prepare_ticks) noexcept override {
    assert(ticks.size() == window.size());
    assert(idle == Idle::wasted || prepare_ticks.size() == window.size());
    with_query(course.query, [&](auto ask) {
      Checksum sum = checksum;
      std::uint64_t before = TickClock::now();
      for (std::size_t i = 0; i < window.size(); ++i) {
        sum.add(ask(course.steps, window.begin + i));
        const std::uint64_t after = TickClock::now();
        ticks[i] = after - before;
        before = after;
        if constexpr (idle == Idle::used) {
          prepare();
          before = TickClock::now();
          prepare_ticks[i] = before - after;
        }
      }
      checksum = sum;
    });
  }

  bool prepares() const noexcept override { return idle == Idle::used; }

 private:
  void prepare() noexcept {
    if constexpr (idle == Idle::used) detector_.prepare(*session_);
  }
  /// Calls visit(ask) with the ask(steps, i) -> Answer of this query.
  template <class Visitor>
  void with_query(Query query, Visitor&& visit) noexcept {
    using Steps = std::span<const Step>;
    if constexpr (AnswersTouches<D>) {
      if (query == Query::touches) {
        return visit([this](Steps steps, std::size_t i) noexcept {
          Answer answer;
          answer.found = detector_.touches(steps[i].probe, *session_) ? 1 : 0;
          return answer;
        });
      }
    }
    if constexpr (AnswersNearest<D>) {
      if (query == Query::nearest) {
        return visit([this](Steps steps, std::size_t i) noexcept {
          const std::optional<Contact> contact = detector_.nearest(steps[i].probe, steps[i].reach, *session_);
          return contact ? Answer::of(*contact) : Answer{};
        });
      }
    }
    if constexpr (AnswersSweep<D>) {
      if (query == Query::sweep) {
        return visit([this](Steps steps, std::size_t i) noexcept {
          const Probe& now = steps[i].probe;
          const Sweep sweep{steps[i > 0 ? i - 1 : 0].probe.center, now.center, now.radius};
          const std::optional<Impact> impact = detector_.first_hit(sweep, *session_);
          return impact ? Answer::of(impact->contact, impact->fraction) : Answer{};
        });
      }
    }
    assert(!"the query must be one that answers(query) affirms");
  }

  D detector_;
  std::optional<typename D::Session> session_;  // engaged always; optional so that any session can be renewed
};

}  // namespace touchmark::bench

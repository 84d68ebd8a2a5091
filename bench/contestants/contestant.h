/// A detector as the program sees it. The type is erased once for a range of steps, never for a probe: what
/// contestant_of.h makes of it are templates, so the compiler sees the detector's query inside the loops.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/contestants/tick_clock.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"
#include "core/detector.h"
#include "core/mesh_motion.h"
#include "core/mesh_update.h"
#include "core/search/many/many_options.h"

namespace touchmark::bench::contestants {

/// Returns what was looked at between two readings of a session's counters.
inline Work work_between(const Work& before, const Work& after) noexcept {
  return {after.cells - before.cells,
          after.spheres - before.spheres,
          after.boxes - before.boxes,
          after.triangles - before.triangles,
          after.exact_decisions - before.exact_decisions,
          after.bodies - before.bodies};
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
  /// Returns the session's, which may be limited; null for one that does not keep to it.
  virtual LimitedWork* limited_work() noexcept { return nullptr; }

  /// The answer to each step of the range and the total work it took; both spans have the range's size.
  virtual void answer(const workload::QueryTrace& trace, workload::StepRange range,
                      std::span<workload::Answer> answers, std::span<std::uint64_t> work) noexcept = 0;
  /// Returns true if it answers one question at a time, as below: for a loop that goes on from the answer,
  /// such as a proxy's.
  virtual bool guides_proxy() const noexcept { return false; }
  virtual bool touches(const Probe& probe) noexcept { return static_cast<void>(probe), false; }
  /// `motion` is the mesh's meanwhile, null where it stands. One that does not see it takes all for touched
  /// at the start.
  virtual std::optional<Impact> first_hit(const Sweep& sweep, const MeshMotion* motion) noexcept {
    return static_cast<void>(sweep), static_cast<void>(motion), std::nullopt;
  }
  virtual std::size_t contacts(const Probe& probe, double reach, std::span<Contact> into) noexcept {
    return static_cast<void>(probe), static_cast<void>(reach), static_cast<void>(into), 0;
  }
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
  /// Asks nearest_many, with what it keeps from call to call until forget(). Needs answers(Query::nearest)
  /// and a mesh, not a scene. Throws what that throws.
  virtual void nearest_many(std::span<const Vec3> points, double reach,
                            std::span<std::optional<Contact>> answers, const ManyOptions& options) = 0;
  /// Returns true if the detector prepares after each step. That is in all other times, and in the work.
  virtual bool prepares() const noexcept = 0;
  /// Moves the bodies of a scene to where they are at a step. The loops above do so before each query, which
  /// is quick where the step before was the last one; elsewhere it may take its time, so do it before a clock
  /// is read. Returns true if bodies were moved.
  virtual bool stand_at(const workload::QueryTrace& trace, std::size_t step) noexcept {
    return static_cast<void>(trace), static_cast<void>(step), false;
  }
  /// Returns true if it can do some of the next query's work after bodies were moved and before that query.
  virtual bool prepares_after_moves() const noexcept { return false; }
  /// Does so, where it can, and where the detector prepares. The loops above never call it, and no answer
  /// changes.
  virtual void prepare_next() noexcept {}
};

}  // namespace touchmark::bench::contestants

/// Many points asked at once: a scan against a mesh, or a pointshell, the points of a body's surface, each
/// tick.
///
/// Points are asked along a space-filling curve (core/search/curve_order.h), which is cut into stretches of
/// neighbours. A stretch has a session of its own; its first point pays for what the others then know. Points
/// that have hardly moved since the last call have one each.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/detector.h"
#include "core/probe.h"
#include "core/search/ask_plan.h"
#include "core/search/thread_crew.h"
#include "core/simd/prefetch.h"

namespace touchmark {

/// How `nearest_many` is to go about it. Answers do not depend on it.
struct ManyOptions {
  std::size_t threads = 1;  ///< the caller's one of them; 0: as many as the machine runs at once
  AskOrder order = AskOrder::automatic;
};

/// What `nearest_many` keeps from call to call: sessions, the order, and its threads, which wait. One for
/// each set of points, asked by one thread at a time. Other sets of points, also of another size, may follow.
template <AnswersNearest D>
class ManySessions {
 public:
  /// Points are followed from call to call, with a session each, where there are no more of them than this.
  static constexpr std::size_t max_followed =
      std::min<std::size_t>((std::size_t{1} << 24) / sizeof(typename D::Session), 16384);

  /// Forgets all points, and keeps memory and threads. Necessary only before another detector is asked that
  /// does not tell its own sessions from others: ours do, also after they were built anew or updated.
  void forget() noexcept {
    plan_.forget();
    work_before_ = Work();
    for (Session& session : sessions()) {
      std::destroy_at(&session);
      std::construct_at(&session);
    }
  }
  /// What was looked at since the last `forget`: the same for any number of threads.
  Work work() const noexcept {
    Work sum = work_before_;
    for (const Session& session : sessions()) sum += session.work;
    return sum;
  }

 private:
  using Session = typename D::Session;

  template <AnswersNearest Asked>
  friend void nearest_many(const Asked& detector, std::span<const Vec3> points, double reach,
                           std::span<std::optional<Contact>> answers, ManySessions<Asked>& sessions,
                           const ManyOptions& options);

  std::span<Session> sessions() const noexcept { return {sessions_.get(), count_}; }
  /// Has so many sessions, new ones where it had fewer: some detectors' cannot be moved.
  void reserve(std::size_t count) {
    if (count <= count_) return;
    auto more = std::make_unique<Session[]>(count);
    work_before_ = work();
    sessions_ = std::move(more);
    count_ = count;
  }

  AskPlan plan_;
  std::unique_ptr<Session[]> sessions_;
  std::size_t count_ = 0;
  Work work_before_;  ///< of sessions that are no more
  ThreadCrew crew_;
};

/// Asks `detector.nearest` of n points, answers[i] of points[i]: the bits of asking one by one, if the
/// detector's answers do not depend on its session. None for a point with a coordinate that is not a number.
/// Throws std::invalid_argument where there are not as many answers as points, or over 2^32 - 1;
/// std::bad_alloc and std::system_error where sessions or threads cannot be had, with no answer given.
/// Allocates nothing, and starts no thread, where an earlier call was for as many points and threads.
template <AnswersNearest D>
void nearest_many(const D& detector, std::span<const Vec3> points, double reach,
                  std::span<std::optional<Contact>> answers, ManySessions<D>& sessions,
                  const ManyOptions& options = {}) {
  if (answers.size() != points.size())
    throw std::invalid_argument("nearest_many: " + std::to_string(answers.size()) + " answers for " +
                                std::to_string(points.size()) + " points");
  const std::size_t stretch = AskPlan::stretch_length(points.size());
  const std::size_t stretches = (points.size() + stretch - 1) / stretch;
  const std::size_t threads =
      std::min(options.threads > 0 ? options.threads : ThreadCrew::of_the_machine(), stretches);
  sessions.plan_.make(points, options.order, ManySessions<D>::max_followed);
  const std::size_t wanted = points.size() <= ManySessions<D>::max_followed ? points.size() : stretches;
  sessions.reserve(wanted);
  sessions.crew_.reserve(threads);

  const std::span<const std::uint32_t> indices = sessions.plan_.indices();
  const bool followed = sessions.plan_.is_followed();
  sessions.crew_.run(threads, stretches, [&](std::size_t part) noexcept {
    constexpr std::size_t ahead = 8;
    const std::size_t end = std::min((part + 1) * stretch, points.size());
    for (std::size_t k = part * stretch; k < end; ++k) {
      if (!indices.empty() && k + ahead < end) {
        prefetch_lines(&points[indices[k + ahead]], sizeof(Vec3));
        prefetch_lines(&answers[indices[k + ahead]], sizeof(std::optional<Contact>));
      }
      const std::size_t i = indices.empty() ? k : indices[k];
      answers[i] = detector.nearest(Probe{points[i], 0}, reach, sessions.sessions_[followed ? i : part]);
    }
  });
}

/// Does the same once, without anything kept.
template <AnswersNearest D>
void nearest_many(const D& detector, std::span<const Vec3> points, double reach,
                  std::span<std::optional<Contact>> answers, const ManyOptions& options = {}) {
  ManySessions<D> sessions;
  nearest_many(detector, points, reach, answers, sessions, options);
}

}  // namespace touchmark

/// Many points asked at once: a scan against a mesh, or a pointshell, the points of a body's surface, each
/// tick.
///
/// Points are asked along a space-filling curve (core/search/many/curve_order.h), which is cut into stretches
/// of neighbours. A stretch has a session of its own; its first point pays for what the others then know.
/// Points that have hardly moved since the last call have a memory each: a session, or less where the
/// detector can do with less.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/detector.h"
#include "core/probe.h"
#include "core/search/many/ask_plan.h"
#include "core/search/many/many_options.h"
#include "core/search/threads/parallel.h"
#include "core/search/threads/thread_crew.h"
#include "core/simd/prefetch.h"

namespace touchmark {

// clang-format off
/// A detector that can remember less of a point than a session does, so that many are followed from call to
/// call: `nearest(probe, reach, followed, work)` gives the same answers.
template <class D>
concept FollowsPoints = AnswersNearest<D> &&
    requires(const D& detector, const Probe& probe, double reach, typename D::FollowedPoint& followed, Work& work) {
  requires std::default_initializable<typename D::FollowedPoint>;
  { detector.nearest(probe, reach, followed, work) } noexcept -> std::same_as<std::optional<Contact>>;
};
// clang-format on

/// What `nearest_many` keeps from call to call: sessions, the order, and its threads, which wait. One for
/// each set of points, asked by one thread at a time. Other sets of points, also of another size, may follow.
template <AnswersNearest D>
class ManySessions {
  using Session = typename D::Session;
  struct Nothing {};
  template <class Any>
  struct Followed {
    using Type = Nothing;
  };
  template <FollowsPoints Any>
  struct Followed<Any> {
    using Type = typename Any::FollowedPoint;
  };
  using FollowedPoint = typename Followed<D>::Type;

 public:
  /// Points are followed from call to call, each with a memory of its own, where there are no more than this.
  static constexpr std::size_t max_followed = std::min<std::size_t>(
      (std::size_t{1} << 24) / (FollowsPoints<D> ? sizeof(FollowedPoint) : sizeof(Session)), 16384);

  /// Forgets all points, and keeps memory and threads. Necessary only before another detector is asked that
  /// does not tell its own sessions from others: ours do, also after they were built anew or updated.
  void forget() noexcept {
    plan_.forget();
    work_before_ = Work();
    for (Session& session : sessions()) {
      std::destroy_at(&session);
      std::construct_at(&session);
    }
    if constexpr (FollowsPoints<D>) std::ranges::fill(followed_, typename D::FollowedPoint());
  }
  /// What was looked at since the last `forget`: the same for any number of threads.
  Work work() const noexcept {
    Work sum = work_before_;
    for (const Session& session : sessions()) sum += session.work;
    return sum;
  }

 private:
  template <AnswersNearest Asked>
  friend void nearest_many(const Asked& detector, std::span<const Vec3> points, double reach,
                           std::span<std::optional<Contact>> answers, ManySessions<Asked>& sessions,
                           const ManyOptions& options);

  std::span<Session> sessions() const noexcept { return {sessions_.get(), count_}; }
  /// Has memory for so many points in so many stretches.
  void reserve(std::size_t points, std::size_t stretches) {
    const bool can_follow = points <= max_followed;
    if constexpr (FollowsPoints<D>) {
      if (can_follow && points > followed_.size()) followed_.resize(points);
      reserve_sessions(stretches);
    } else {
      reserve_sessions(can_follow ? points : stretches);
    }
  }
  /// Has so many sessions, new ones where it had fewer: some detectors' cannot be moved.
  void reserve_sessions(std::size_t count) {
    if (count <= count_) return;
    auto more = std::make_unique<Session[]>(count);
    work_before_ = work();
    sessions_ = std::move(more);
    count_ = count;
  }
  /// Asks for the point at this place of the order, in this stretch.
  std::optional<Contact> ask(const D& detector, const Vec3& point, double reach, std::size_t place,
                             std::size_t stretch) noexcept {
    const Probe probe{point, 0};
    if (!plan_.is_followed()) return detector.nearest(probe, reach, sessions_[stretch]);
    if constexpr (FollowsPoints<D>) {
      return detector.nearest(probe, reach, followed_[place], sessions_[stretch].work);
    } else {
      return detector.nearest(probe, reach, sessions_[place]);
    }
  }

  AskPlan plan_;
  std::unique_ptr<Session[]> sessions_;
  std::size_t count_ = 0;
  std::vector<FollowedPoint> followed_;  ///< by the place in the order, as a point's session is
  Work work_before_;                     ///< what sessions that are no more had looked at
  ThreadCrew crew_;
};

/// Asks `detector.nearest` of n points, answers[i] of points[i]: the bits of asking one by one, if the
/// detector's answers do not depend on its session. None for a point with a coordinate that is not a number.
/// Throws std::invalid_argument where there are not as many answers as points, or more than 2^32 - 1, or too
/// many threads; std::bad_alloc and std::system_error where sessions or threads cannot be had, with no answer
/// given. Allocates nothing, and starts no thread, where an earlier call was for as many points and threads.
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
      std::min<std::size_t>(threads_to_use(options.threads, "nearest_many"), stretches);
  sessions.plan_.make(points, options.order, ManySessions<D>::max_followed);
  sessions.reserve(points.size(), stretches);
  sessions.crew_.reserve(threads);

  const std::span<const std::uint32_t> indices = sessions.plan_.indices();
  sessions.crew_.run(threads, stretches, [&](std::size_t part) noexcept {
    constexpr std::size_t ahead = 8;
    const std::size_t end = std::min((part + 1) * stretch, points.size());
    for (std::size_t place = part * stretch; place < end; ++place) {
      if (!indices.empty() && place + ahead < end) {
        prefetch_lines(&points[indices[place + ahead]], sizeof(Vec3));
        prefetch_lines(&answers[indices[place + ahead]], sizeof(std::optional<Contact>));
      }
      const std::size_t i = indices.empty() ? place : indices[place];
      answers[i] = sessions.ask(detector, points[i], reach, place, part);
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

/// What a detector is: a value, immutable once built, that answers some of four queries. A detector that
/// cannot answer a query does not declare it.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// exact: within the bound below. conservative: never misses a contact, may report one that is not there.
/// approximate: may err either way.
enum class Guarantee { exact, conservative, approximate };

/// How far a reported distance may be from the true one of the stored doubles:
/// relative * M + absolute, with M the largest coordinate difference between the probe's centre and the
/// nearest triangle's vertices. Approximate detectors state what they know: infinity where they know nothing.
/// Whether there is a contact may be off by as much, unless `decides_exactly`: then `touches` and `nearest`
/// compare the true distance with the radius and the reach, and `first_hit` the least one along the path; its
/// fraction is 0 where and only where the probe touches at the start, never late, and early by no more than
/// core/geometry/sphere_triangle_sweep.h says. `names_exactly`: the triangle that `nearest` names is an
/// exactly nearest one, and of several the one of the lowest id; else it is one within the bound.
struct Accuracy {
  Guarantee guarantee = Guarantee::exact;
  double relative = 0;
  double absolute = 0;
  bool decides_exactly = false;
  bool names_exactly = false;
};

/// Forty-eight roundings of the largest coordinate difference: what the kernel of
/// core/geometry/point_triangle.h keeps, by its analysis there.
inline constexpr double kernel_relative_error = 48 * (std::numeric_limits<double>::epsilon() / 2);

/// What core/search/ties/certified_nearest.h makes of it.
inline constexpr Accuracy certified = {Guarantee::exact, 16 * (std::numeric_limits<double>::epsilon() / 2), 0,
                                       true, true};

/// What the kernel alone makes of it: contact within rounding of the threshold is told either way.
inline constexpr Accuracy uncertified = {Guarantee::exact, kernel_relative_error, 0, false};

/// What a query looked at, counted up over the life of a session. The same probes in the same order give the
/// same counts on every machine.
struct Work {
  std::uint64_t cells = 0;            ///< grid cells or groups tested
  std::uint64_t spheres = 0;          ///< bounding spheres tested
  std::uint64_t boxes = 0;            ///< bounding boxes tested
  std::uint64_t triangles = 0;        ///< triangles tested, by the full kernel or by a filter before it
  std::uint64_t exact_decisions = 0;  ///< how often doubles did not decide; not in the total
  std::uint64_t bodies = 0;           ///< bodies of a scene whose bounds were looked at

  std::uint64_t total() const noexcept { return cells + spheres + boxes + triangles + bodies; }
  Work& operator+=(const Work& other) noexcept {
    cells += other.cells;
    spheres += other.spheres;
    boxes += other.boxes;
    triangles += other.triangles;
    exact_decisions += other.exact_decisions;
    bodies += other.bodies;
    return *this;
  }
};

/// Work, and how much it may come to: see the concept KeepsToLimit.
struct LimitedWork : Work {
  static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
  /// One exact decision takes about as long as this many looks.
  static constexpr std::uint64_t exact_weight = 64;

  std::uint64_t limit = unlimited;  ///< what `spent` may come to
  bool undecided = false;           ///< a query ended at the limit; who sets that clears this

  std::uint64_t spent() const noexcept { return total() + exact_weight * exact_decisions; }
  std::uint64_t left() const noexcept { return limit == unlimited ? unlimited : left_of_limit(); }
  /// Returns true, and makes the query undecided, if this is more than is left.
  bool exceeds_limit(std::uint64_t needed = 1) noexcept {
    return limit != unlimited && exceeds_given_limit(needed);
  }
  /// Returns one that has what is left.
  LimitedWork rest() const noexcept {
    LimitedWork result;
    result.limit = left();
    return result;
  }
  /// Adds what `rest` has come to.
  void take(const LimitedWork& part) noexcept {
    *this += part;
    undecided = undecided || part.undecided;
  }

 private:
  [[gnu::cold, gnu::noinline]] std::uint64_t left_of_limit() const noexcept {
    const std::uint64_t so_far = spent();
    return so_far < limit ? limit - so_far : 0;
  }
  [[gnu::cold, gnu::noinline]] bool exceeds_given_limit(std::uint64_t needed) noexcept {
    if (left() >= needed) return false;
    undecided = true;
    return true;
  }
};

/// What is known of the nearest triangle after a search within a budget of work.
struct Bracket {
  std::optional<Contact> contact;  ///< the nearest triangle found; nothing: none is within the reach
  double lower = 0;        ///< no triangle is nearer; the contact's distance, or the reach, if is_nearest
  bool is_nearest = true;  ///< true: the contact is what `nearest` answers
};

// Version 14 takes `noexcept ->` apart.
// clang-format off
/// `D::build(mesh, options)` throws std::invalid_argument on options that make no sense, naming the offender.
/// `D::Session` is what one haptic point remembers between ticks; it is default-constructed and carries the
/// `work` counters. Forgetting a session changes the cost of the next answer, never the answer. Queries are
/// const and noexcept, allocate nothing, and may run from many threads with a session each.
template <class D>
concept Detector = std::movable<D> && requires(const TriangleMesh& mesh, const typename D::Options& options,
                                               const D& detector, typename D::Session& session) {
  requires std::default_initializable<typename D::Session>;
  { D::build(mesh, options) } -> std::same_as<D>;
  { session.work } -> std::convertible_to<Work&>;
  { detector.bytes() } noexcept -> std::same_as<std::size_t>;  // of the built structure, mesh copy included
  { detector.accuracy() } noexcept -> std::same_as<Accuracy>;
};

/// Is the distance at most probe.radius?
template <class D>
concept AnswersTouches = Detector<D> &&
    requires(const D& detector, const Probe& probe, typename D::Session& session) {
  { detector.touches(probe, session) } noexcept -> std::same_as<bool>;
};

/// The contact of the nearest triangle, or nothing when the distance exceeds `reach` (which may be infinite).
/// probe.radius plays no part: it is `touches` that compares with it.
template <class D>
concept AnswersNearest = Detector<D> &&
    requires(const D& detector, const Probe& probe, double reach, typename D::Session& session) {
  { detector.nearest(probe, reach, session) } noexcept -> std::same_as<std::optional<Contact>>;
};

/// As `nearest`, but ends once about `budget` was looked at. Where that leaves the answer open, the true
/// distance is from `lower` to the contact's distance, and a later search starts from that contact. Of a
/// structure that is built lazily a search may go on until it has found a triangle; one for a probe so far off
/// that floats do not tell its distance looks at all triangles.
template <class D>
concept AnswersWithinBudget = AnswersNearest<D> &&
    requires(const D& detector, const Probe& probe, double reach, typename D::Session& session,
             std::uint64_t budget) {
  { detector.nearest(probe, reach, session, budget) } noexcept -> std::same_as<Bracket>;
};

/// The first touch of a probe that moves along a straight line, or nothing: where no point of the path from
/// `from` to `to`, both ends included, is within the radius of the mesh.
template <class D>
concept AnswersSweep = Detector<D> &&
    requires(const D& detector, const Sweep& sweep, typename D::Session& session) {
  { detector.first_hit(sweep, session) } noexcept -> std::same_as<std::optional<Impact>>;
};

/// One contact for each triangle whose distance to the centre is at most `reach` (which may be infinite),
/// nearest first; of those at the same distance the one that comes first in the mesh. Writes as many as fit
/// into `into`, and returns how many there are. probe.radius plays no part. Triangles are told apart by their
/// place in the mesh: those that a file cut from one polygon have a contact each, and its id in common. Where
/// `decides_exactly`, exact distances decide what is within the reach and which comes first, also where their
/// doubles are equal; the first contact is that of `nearest`.
template <class D>
concept AnswersContacts = Detector<D> && requires(const D& detector, const Probe& probe, double reach,
                                                  typename D::Session& session, std::span<Contact> into) {
  { detector.contacts(probe, reach, session, into) } noexcept -> std::same_as<std::size_t>;
};

/// As `contacts`, but does not count what does not fit: returns how many were written. That looks at less
/// where many triangles are within reach.
template <class D>
concept AnswersNearestContacts = AnswersContacts<D> &&
    requires(const D& detector, const Probe& probe, double reach, typename D::Session& session,
             std::span<Contact> into) {
  { detector.nearest_contacts(probe, reach, session, into) } noexcept -> std::same_as<std::size_t>;
};

/// `prepare` does ahead what the next query would else have to do first, and brings what that needs into the
/// caches: best right after waking, before the device is read. It never changes an answer, does a bounded
/// amount of work, and may be called or not after any query.
template <class D>
concept Prepares = Detector<D> && requires(const D& detector, typename D::Session& session) {
  { detector.prepare(session) } noexcept -> std::same_as<void>;
};

/// A query ends soon after session.work.spent() comes to session.work.limit, and sets `undecided` where that
/// leaves it open. Then `touches` says true, `first_hit` a touch at the start whose contact tells nothing, and
/// `contacts` what was found by then. What is remembered stays true. `nearest` keeps to no limit.
template <class D>
concept KeepsToLimit = Detector<D> && D::keeps_to_limit && requires(typename D::Session& session) {
  { session.work } -> std::same_as<LimitedWork&>;
};

/// Supports lazy construction: the first queries build what they need. Those cost more; answers do not
/// change.
template <class D>
concept BuildsLazily = Detector<D> && requires(const D& detector) {
  { detector.builds_lazily() } noexcept -> std::same_as<bool>;
};
// clang-format on

}  // namespace touchmark

/// Any detector, with the side of the surface in its contacts. The detector itself is asked as before; what
/// the side costs comes on top, once for each contact.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/detector.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/mesh_motion.h"
#include "core/mesh_update.h"
#include "core/sign/side_finder.h"

namespace touchmark {

/// A detector D that fills in Contact::side; it answers what D answers.
template <Detector D>
class Signed {
 public:
  using Options = typename D::Options;
  static constexpr bool keeps_to_limit = KeepsToLimit<D>;
  /// The detector's own session, with one counter more.
  struct Session : D::Session {
    std::uint64_t counted = 0;  ///< sides that pseudonormals did not decide
  };

  static Signed build(const TriangleMesh& mesh, const Options& options) {
    return Signed(D::build(mesh, options), SideFinder::build(mesh));
  }
  static Signed build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// The sides are found anew.
  void update(const TriangleMesh& mesh) requires Updates<D> {
    detector_.update(mesh);
    sides_ = SideFinder::build(mesh);
  }

  bool touches(const Probe& probe, Session& session) const noexcept requires AnswersTouches<D> {
    return detector_.touches(probe, session);
  }

  std::optional<Contact> nearest(const Probe& probe, double reach,
                                 Session& session) const noexcept requires AnswersNearest<D> {
    std::optional<Contact> contact = detector_.nearest(probe, reach, session);
    if (contact) contact->side = sides_.side(probe.center, *contact, detector_.accuracy(), session.counted);
    return contact;
  }

  /// The side is that of the centre where the probe touches. The touch is only told to within a rounding, so
  /// the contact's distance is not relied on.
  std::optional<Impact> first_hit(const Sweep& sweep,
                                  Session& session) const noexcept requires AnswersSweep<D> {
    std::optional<Impact> impact = detector_.first_hit(sweep, session);
    if (impact && !is_undecided(session)) {
      constexpr Accuracy approximate{Guarantee::approximate, 0, 0, false};
      impact->contact.side =
          sides_.side(position_at(sweep, impact->fraction), impact->contact, approximate, session.counted);
    }
    return impact;
  }

  /// The side is not told.
  std::optional<Impact> first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                         Session& session) const noexcept requires AnswersMovingSweep<D> {
    return detector_.first_hit_moving(sweep, motion, session);
  }

  /// The side is that of the centre, the same for all.
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept requires AnswersContacts<D> {
    const std::size_t count = detector_.contacts(probe, reach, session, into);
    const std::span<Contact> written = into.first(std::min(count, into.size()));
    if (written.empty()) return count;
    const Side side = sides_.side(probe.center, written.front(), detector_.accuracy(), session.counted);
    for (Contact& contact : written) contact.side = side;
    return count;
  }

  void prepare(Session& session) const noexcept requires Prepares<D> { detector_.prepare(session); }

  std::size_t bytes() const noexcept { return detector_.bytes() + sides_.bytes(); }
  Accuracy accuracy() const noexcept { return detector_.accuracy(); }
  bool builds_lazily() const noexcept requires BuildsLazily<D> { return detector_.builds_lazily(); }
  const D& detector() const noexcept { return detector_; }
  const SideFinder& sides() const noexcept { return sides_; }

 private:
  /// Then a hit says nothing of a place.
  static bool is_undecided([[maybe_unused]] const Session& session) noexcept {
    if constexpr (keeps_to_limit) return session.work.undecided;
    return false;
  }
  Signed(D detector, SideFinder sides) : detector_(std::move(detector)), sides_(std::move(sides)) {}

  D detector_;
  SideFinder sides_;
};

}  // namespace touchmark

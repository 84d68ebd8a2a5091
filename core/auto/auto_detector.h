/// Whichever of our detectors suits a mesh, behind one type.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "core/aabb_tree/aabb_tree.h"
#include "core/auto/best_for.h"
#include "core/auto/built_form.h"
#include "core/detector.h"
#include "core/grid_group/grid_group.h"
#include "core/mesh_update.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {

/// The detector that best_for chooses; satisfies Detector, Updates, Prepares and every query. Answers are the
/// same bits whichever it is.
class AutoDetector {
 public:
  using Options = Wish;
  /// What one haptic point remembers between ticks: what the chosen one remembers. The sphere-cluster's work
  /// is counted where it is read; the others' is added.
  struct Session : SphereCluster::Session {
    GridGroup::Session grid;
    AabbTree::Session boxes;
  };

  /// Chooses and builds. Throws what best_for and the chosen one's `build` throw, and std::invalid_argument
  /// where even the smallest takes more than wish.max_bytes.
  static AutoDetector build(const TriangleMesh& mesh, const Wish& wish);
  static AutoDetector build(const TriangleMesh& mesh) { return build(mesh, Wish()); }

  /// See the concept Updates. What was chosen stays.
  void update(const TriangleMesh& mesh);

  // What the sphere-cluster's memory knows to be clear, or to touch, is asked before which form was chosen:
  // another one leaves that memory empty, and then nothing is known. So this costs what it costs there.
  [[gnu::always_inline]] bool touches(const Probe& probe, Session& session) const noexcept {
    if (spheres_.is_clear(probe.center, probe.radius, session)) return false;
    return spheres_.is_touching(probe, session) || look_for_touch(probe, session);
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    if (spheres_.is_clear(probe.center, reach, session)) return std::nullopt;
    return look_for_nearest(probe, reach, session);
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    if (spheres_.is_clear(sweep, session)) return std::nullopt;
    return look_for_impact(sweep, session);
  }
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    if (spheres_.is_clear(probe.center, reach, session)) return 0;
    return look_for_contacts(probe, reach, session, into);
  }
  /// See the concept Prepares; the plain tree of boxes has nothing to prepare.
  void prepare(Session& session) const noexcept {
    other_ ? prepare_other(session) : spheres_.prepare(session);
  }

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;
  const Choice& choice() const noexcept { return choice_; }

 private:
  AutoDetector(const Choice& choice, BuiltForm form);

  /// Asks the one of the others that was chosen.
  template <class Ask>
  auto ask_other(Session& session, const Ask& of) const noexcept;
  // These ask whichever was chosen. They are calls: next to a choice in line, what is clear cost up to a
  // third more.
  [[gnu::noinline]] bool look_for_touch(const Probe& probe, Session& session) const noexcept;
  [[gnu::noinline]] std::optional<Contact> look_for_nearest(const Probe& probe, double reach,
                                                            Session& session) const noexcept;
  [[gnu::noinline]] std::optional<Impact> look_for_impact(const Sweep& sweep,
                                                          Session& session) const noexcept;
  [[gnu::noinline]] std::size_t look_for_contacts(const Probe& probe, double reach, Session& session,
                                                  std::span<Contact> into) const noexcept;
  [[gnu::noinline]] void prepare_other(Session& session) const noexcept;

  Choice choice_;
  SphereCluster spheres_;  ///< empty where another was chosen
  std::optional<std::variant<GridGroup, AabbTree>> other_;
};

}  // namespace touchmark

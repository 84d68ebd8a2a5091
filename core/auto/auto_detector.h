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

  bool touches(const Probe& probe, Session& session) const noexcept {
    return ask<bool>(session, [&](const auto& form, auto& own) { return form.touches(probe, own); });
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    return ask<std::optional<Contact>>(
        session, [&](const auto& form, auto& own) { return form.nearest(probe, reach, own); });
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    return ask<std::optional<Impact>>(
        session, [&](const auto& form, auto& own) { return form.first_hit(sweep, own); });
  }
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    return ask<std::size_t>(
        session, [&](const auto& form, auto& own) { return form.contacts(probe, reach, own, into); });
  }
  /// See the concept Prepares; the plain tree of boxes has nothing to prepare.
  void prepare(Session& session) const noexcept {
    ask<bool>(session, [&]<class F>(const F& form, auto& own) {
      if constexpr (Prepares<F>) form.prepare(own);
      return true;
    });
  }

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;
  const Choice& choice() const noexcept { return choice_; }

 private:
  AutoDetector(const Choice& choice, BuiltForm form) : choice_(choice), form_(std::move(form)) {}

  /// Asks the one that is held, the likeliest first. A branch that always goes the same way costs less than a
  /// call through a table, and leaves the query in line.
  template <class Answer, class Ask>
  Answer ask(Session& session, const Ask& of) const noexcept {
    if (const auto* spheres = std::get_if<SphereCluster>(&form_))
      return of(*spheres, static_cast<SphereCluster::Session&>(session));
    if (const auto* grid = std::get_if<GridGroup>(&form_)) {
      Answer answer = of(*grid, session.grid);
      move_work(session.grid.work, session.work);
      return answer;
    }
    Answer answer = of(*std::get_if<AabbTree>(&form_), session.boxes);
    move_work(session.boxes.work, session.work);
    return answer;
  }
  static void move_work(Work& from, Work& to) noexcept {
    if (from.total() + from.exact_decisions == 0) return;
    to += from;
    from = {};
  }

  Choice choice_;
  BuiltForm form_;
};

}  // namespace touchmark

/// The rival CGAL 5.5: closest point and intersection over its AABB tree. GPL, so whatever it is linked into
/// is. README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/rival.h"

namespace touchmark::baselines {

class CgalDetector {
 public:
  /// simple: doubles throughout. epick: exact predicates, inexact constructions. epeck: both exact.
  enum class Kernel { epick, simple, epeck };
  /// The start of the search for the closest point. none: CGAL's own hint, from a k-d tree. last: the point
  /// of the session's last triangle that is closest now. bounded: that, or a point just beyond the reach when
  /// that is nearer.
  enum class Hint { none, last, bounded };

  struct Options {
    Kernel kernel = Kernel::epick;
    Hint hint = Hint::bounded;
    Asking query = Asking::checked;
  };
  /// CGAL tells no work. `last` is a place in its tree.
  using Session = RivalSession;

  /// Throws MeshError where CGAL has nothing to work with: with epeck any triangle of no area, with the
  /// others (which leave those out) nothing but such triangles.
  static CgalDetector build(const TriangleMesh& mesh, const Options& options);
  static CgalDetector build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// Counted by what is known of CGAL's structures: it does not count itself.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

  struct Model;

 private:
  explicit CgalDetector(Hidden<const Model> model) noexcept : model_(std::move(model)) {}

  Hidden<const Model> model_;
};

}  // namespace touchmark::baselines

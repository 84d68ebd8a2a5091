/// The rival VTK (9.1): the closest point by its static cell locator, or by its signed distance of a mesh.
/// README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "baselines/hidden.h"
#include "baselines/reach.h"
#include "core/detector.h"

namespace touchmark::baselines {

class VtkDetector {
 public:
  /// fixed: vtkStaticCellLocator, the closest point within a radius. implicit: vtkImplicitPolyDataDistance,
  /// which looks at any distance and names no triangle.
  enum class Locator { fixed, implicit };

  struct Options {
    Locator locator = Locator::fixed;
    std::uint32_t cells = 0;  ///< triangles a bin on average, of `fixed`; 0: VTK's own choice, 10
    Asking query = Asking::checked;
  };

  class Session {
   public:
    Work work;  ///< triangles: those that are asked before VTK. It does not tell what it looks at.

   private:
    friend class VtkDetector;
    struct State;
    Hidden<State> state_;
  };

  /// Throws MeshError for a mesh without triangles.
  static VtkDetector build(const TriangleMesh& mesh, const Options& options);
  static VtkDetector build(const TriangleMesh& mesh) { return build(mesh, Options{}); }

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// What VTK counts of the mesh, and the triangles that are asked before it. VTK does not tell what its
  /// locators take; heap_bytes of the results does.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct Model;
  explicit VtkDetector(Hidden<Model> model) noexcept : model_(std::move(model)) {}
  static Session::State& state(Session& session);
  /// The reach that is asked for, or nothing where nothing is to be found.
  std::optional<double> reach_from(const Vec3& center, double reach) const noexcept;
  std::optional<Contact> nearest_in_ball(const Vec3& center, double radius,
                                         Session::State& state) const noexcept;
  std::optional<Contact> nearest_of_all(const Vec3& center, double reach) const noexcept;

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines

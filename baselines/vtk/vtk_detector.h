/// The rival VTK (9.1): the closest point by its static cell locator, or by its signed distance of a mesh.
/// README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "baselines/rival.h"

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

  struct State;
  /// work.triangles: those that are asked before VTK. It does not tell what it looks at.
  using Session = StatefulSession<State>;

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
  std::optional<Contact> nearest_in_ball(const Vec3& center, double radius, Session& session) const noexcept;
  std::optional<Contact> nearest_of_all(const Vec3& center, double reach) const noexcept;

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines

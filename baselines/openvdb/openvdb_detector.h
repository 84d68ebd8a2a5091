/// The rival OpenVDB (10): distances sampled on a sparse lattice about the mesh, read by trilinear
/// interpolation. README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/rival.h"

namespace touchmark::baselines {

class OpenVdbDetector {
 public:
  /// with_sign: a level set, negative inside of a closed mesh. without: distances alone.
  enum class Distances { with_sign, without };
  /// gradient: the place that the interpolated distance and its gradient lead to; no triangle is named.
  /// polygon: the closest point of the polygon that the nearest voxel keeps.
  enum class Found { gradient, polygon };

  struct Options {
    double voxel = 0;  ///< mesh units: the edge of a voxel; 0: 1 % of the box's diagonal
    double band = 0;   ///< mesh units: the field knows distances up to this; 0: 1 % of the box's diagonal
    Distances distances = Distances::with_sign;
    Found contact = Found::gradient;
    Asking query = Asking::checked;
  };

  struct State;
  /// work.cells: the cells of the lattice that were read. work.triangles: the polygons measured.
  using Session = StatefulSession<State>;

  /// Throws std::invalid_argument for a voxel or a band that is not a finite number above 0, or so many
  /// voxels that they take more than 4 GiB or leave the range of the library's coordinates; MeshError for
  /// more than 2^31 - 1 triangles.
  static OpenVdbDetector build(const TriangleMesh& mesh, const Options& options);
  static OpenVdbDetector build(const TriangleMesh& mesh) { return build(mesh, Options{}); }

  bool touches(const Probe& probe, Session& session) const noexcept;
  /// Finds nothing farther than the band, whatever the reach.
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// What the library counts of the grid that is asked, and the triangles where polygons are measured.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct Model;
  explicit OpenVdbDetector(Hidden<Model> model) noexcept : model_(std::move(model)) {}
  State& state(Session& session) const;
  std::optional<Vec3> place_within(const Vec3& center, double reach) const noexcept;
  std::optional<float> distance_at(const Vec3& place, Session& session) const noexcept;
  const PreparedTriangle* polygon_at(const Vec3& place, Session& session) const noexcept;

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines

/// How often a mesh winds round a point: exactly where it is closed, within a known error where it is not.
///
/// A ray goes down from the point. Through a closed surface it passes as often outwards as the surface winds
/// round the point, less the times it passes inwards. Which triangles it meets and which of them are below
/// the point are signs of determinants, and a ray that meets an edge is moved aside by an amount too small
/// for any number (Edelsbrunner & Muecke, "Simulation of simplicity", 1990), so the count is exact for any
/// point off the surface, for slivers, doubled and intersecting triangles.
///
/// What is open is closed first by curtains that hang upwards from its open edges to infinity. The ray meets
/// none of them, so the count is that of the mesh and its curtains together; the winding number of the mesh
/// alone (Jacobson, Kavan & Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding
/// numbers", 2013: the share of all directions that its triangles cover, with sign) is the count less what
/// the curtains cover (van Oosterom & Strackee, "The solid angle of a plane triangle", 1983). One ray and a
/// term for each open edge instead of a term for each triangle. Barill et al. (2018) approximate the latter;
/// here nothing is approximated, and only a soup of triangles pays for it: three terms a triangle.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/sign/triangle_tree.h"

namespace touchmark::sign {

class Winding {
 public:
  /// A number with what it may be off by.
  struct Share {
    double value = 0;
    double error = 0;
  };

  Winding() = default;
  /// The open edges in the direction in which their triangles run.
  Winding(const TriangleMesh& mesh, std::vector<std::array<Vec3, 2>> open_edges);

  /// The winding number of the mesh and its curtains; nothing on the surface itself. Exact, for finite
  /// points.
  std::optional<int> count(const Vec3& point) const noexcept;
  /// What the curtains contribute to that.
  Share of_curtains(const Vec3& point) const noexcept;

  const TriangleTree& tree() const noexcept { return tree_; }
  std::size_t bytes() const noexcept {
    return tree_.bytes() + open_edges_.capacity() * sizeof(open_edges_[0]);
  }

 private:
  TriangleTree tree_;
  std::vector<std::array<Vec3, 2>> open_edges_;
};

}  // namespace touchmark::sign
